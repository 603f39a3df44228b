// Single passes against what the host computes from the same buffers: the rows of the neighbour list and the sensor
// records. Sizes are odd on purpose: the last workgroup is never full.

#include <algorithm>
#include <random>
#include <tuple>

#include "host/backend/vulkan/pack.h"
#include "host/backend/vulkan/passes.h"
#include "tests/support/gpu.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

Particles cloud(std::size_t n, double box, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-0.5, 0.5), radius(0.6e-3, 1.8e-3), speed(-1, 1);
    Particles p;
    for (std::size_t i = 0; i < n; ++i)
        p.add(box * Vec3(unit(random), unit(random), unit(random)), double(float(radius(random))),
              {speed(random), speed(random), speed(random)}, 100.0 * Vec3(speed(random), speed(random), speed(random)));
    return p;
}

struct Rig {
    vk::Device device{testDevice()};
    TableSizes sizes;
    std::unique_ptr<Passes> passes;

    /// For a batch of so many steps.
    Rig(const RuledWorld& world, const Particles& p, std::uint32_t steps = 1) {
        gpu::Member member = packMember(world, world.law, p);
        member.roster.z = steps;
        sizes = tableSizes(world, Crowd(p), member, {64, 65535, device.limits().maxStorageBufferRange});
        sizes.cells = 32;  // far fewer than cells in use: many share a slot of the table
        passes = std::make_unique<Passes>(device, sizes);
        passes->members.write(0, &member, sizeof member);
        std::vector<gpu::vec4> half(std::size_t(gpu::kFields) * sizes.particles());
        packState(p, sizes.share, 0, half);
        passes->state.writeAll(half);
        passes->reset();
    }

    template <class Record>
    void run(Record&& record) {
        vk::Commands commands(device);
        commands.begin();
        record(commands);
        commands.hostBarrier();
        commands.submit();
        for (const std::string& message : device.validationMessages()) FAIL_CHECK(message);
    }
};

}  // namespace

TEST_CASE("tables take as much of the device as is told beforehand") {
    for (const bool book : {false, true}) {
        RuledWorld world = canisterWorld();
        world.energyBook = book;
        const Rig rig(world, cloud(301, 0.02, 5));
        CHECK(rig.passes->bytes() == rig.sizes.allBytes());
        CHECK(rig.passes->history.size() <= rig.sizes.longestBytes());
    }
}

TEST_CASE("the rows hold every neighbour within reach and the skin, ascending, and no other") {
    RuledWorld world = emptyWorld();
    world.timeStep = 1e-9;  // the one step that follows the rebuild moves nothing
    world.skin = 0.4e-3;
    world.maxOverlapRatio = 1e9;  // the cloud is of overlapping spheres
    world.domain = {Vec3(-4), Vec3(4)};
    struct Cloud {
        std::size_t n;
        double apart;  // [m]
        double x;      // of its middle [m]
        bool dense;    // rows are found sixteen at a time; some have more
    };
    for (const auto& [n, apart, x, dense] : {Cloud{1, 0.003, 0, false},
                                             {63, 0.003, 0, false},
                                             {65, 0.003, 0, false},
                                             {257, 0.003, 0, false},
                                             {257, 0.0016, 0, true},
                                             {257, 0.003, -3, false}}) {
        DYNAMIC_SECTION(n << " particles, " << apart << " m apart, at " << x << " m") {
            Particles p = cloud(n, apart * std::cbrt(double(n)), unsigned(n));
            for (Vec3& at : p.position) at = Vec3(glm::vec3(at + Vec3(x)));  // as exact as the device knows them here
            if (n > 60) p.status[5] = Status::Dosed;                         // takes no part
            Rig rig(world, p);
            rig.run([&](vk::Commands& c) { rig.passes->recordSteps(c, 1, true); });
            const auto control = rig.passes->controlOf(0);
            CHECK(control.list.y == 1);
            CHECK(control.wanted.x == 0);
            CHECK(control.error.x == gpu::kEmpty);
            const auto ranges = rig.passes->ranges.readAll<gpu::uvec4>(rig.sizes.particles());
            const auto rows = rig.passes->rows.readAll<std::uint32_t>(rig.sizes.rowEntries);
            std::size_t wrong = 0, listed = 0, longest = 0;
            for (std::size_t i = 0; i < n; ++i) {
                std::vector<std::uint32_t> expected, row;
                for (std::size_t j = 0; j < n; ++j)
                    if (j != i && p.status[i] == Status::Active && p.status[j] == Status::Active &&
                        glm::length(p.position[i] - p.position[j]) < p.radius[i] + p.radius[j] + world.skin)
                        expected.push_back(std::uint32_t(j));
                for (std::uint32_t s = 0; s < ranges[i].y; ++s) row.push_back(rows[ranges[i].x + s]);
                wrong += row != expected;
                listed += row.size();
                longest = std::max(longest, row.size());
            }
            CHECK(wrong == 0);
            CHECK((n < 60 || listed > n));
            CHECK(longest == control.list.z);
            if (dense) CHECK(longest > 32);
        }
    }
}

TEST_CASE("a particle that has gone too far ends the stride, and the steps that are missing are made with new lists") {
    RuledWorld world = emptyWorld();
    world.timeStep = 1e-6;
    world.skin = 0.4e-3;
    world.gravity = {0, 0, 0};
    Particles p = cloud(1, 0.01, 3);
    p.velocity[0] = {12.5, 0, 0};  // lists hold for 0.04 mm: it is beyond after four steps of 0.0125 mm
    const double start = p.position[0].x;
    Rig rig(world, p, gpu::kStride);
    const auto x = [&](std::uint32_t half) {
        const std::uint64_t at = std::uint64_t(half) * gpu::kFields * rig.sizes.particles();
        const auto v = rig.passes->state.readAll<gpu::vec4>(2, at * sizeof(gpu::vec4));
        return double(v[0].x) + double(v[1].x);
    };
    rig.run([&](vk::Commands& c) { rig.passes->recordSteps(c, gpu::kStride, true); });
    CHECK(rig.passes->controlOf(0).steps.x == 4);
    CHECK(rig.passes->controlOf(0).list.w == 1);
    CHECK(near(x(0), start + 4 * 12.5e-6, 1e-3, 1e-6));

    rig.run([&](vk::Commands& c) { rig.passes->recordSteps(c, 4, false); });
    const gpu::Control control = rig.passes->controlOf(0);
    CHECK(control.steps.x == gpu::kStride);
    CHECK(control.list.y == 1);
    CHECK(control.list.w == 2);
    CHECK(near(x(0), start + 8 * 12.5e-6, 1e-3, 1e-6));
    // The batch is over, so that nothing is made any more, and what the last step called for is not forgotten.
    CHECK(control.wanted == gpu::uvec4(0, 0, 0, 1));
    rig.run([&](vk::Commands& c) { rig.passes->recordSteps(c, 5, false); });
    CHECK(rig.passes->controlOf(0).steps.x == gpu::kStride);
    CHECK(rig.passes->controlOf(0).wanted == gpu::uvec4(0, 0, 0, 1));
}

TEST_CASE("the lists hold every contact within the slack once, and the links name them in order") {
    RuledWorld world = emptyWorld();
    world.timeStep = 1e-9;
    world.skin = 0.4e-3;
    world.walls = {geometry::Plane{{0, -0.004, 0}, {0, 1, 0}}, geometry::Plane{{-0.003, 0, 0}, {1, 0, 0}}};
    world.maxOverlapRatio = 1e9;
    const std::size_t n = 257;
    Particles p = cloud(n, 0.015, 5);
    p.status[5] = Status::Dosed;  // takes no part
    std::vector<double> slack(n);
    for (std::size_t i = 0; i < n; ++i) {  // from least to most
        p.velocity[i] = {0, 0, double(i % 7) * 20};
        const double steps = double(gpu::kSlackSteps) * world.timeStep * p.velocity[i].z;
        slack[i] =
            std::min(double(gpu::kLeastSlack) * world.skin / 2 + steps, double(gpu::kMostSlack) * world.skin / 2);
    }
    using Link = std::tuple<std::uint32_t, std::uint32_t, bool>;  // first body, other, whether a pair
    std::vector<std::vector<Link>> expected(n);
    std::size_t pairs = 0, surfaces = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
        if (p.status[i] != Status::Active) continue;
        for (std::uint32_t j = 0; j < n; ++j) {
            const double gap = glm::length(p.position[i] - p.position[j]) - p.radius[i] - p.radius[j];
            if (i == j || p.status[j] != Status::Active || gap >= slack[i] + slack[j]) continue;
            expected[i].push_back({std::min(i, j), std::max(i, j), true});
            pairs += i < j;
        }
        const double gaps[] = {p.position[i].y + 0.004 - p.radius[i], p.position[i].x + 0.003 - p.radius[i]};
        for (std::uint32_t s = 0; s < 2; ++s)
            if (gaps[s] < slack[i]) {
                expected[i].push_back({i, s, false});
                ++surfaces;
            }
    }
    REQUIRE(pairs > 100);
    REQUIRE(surfaces > 20);

    Rig rig(world, p);
    rig.run([&](vk::Commands& c) { rig.passes->recordSteps(c, 1, true); });
    const TableSizes& t = rig.sizes;
    const auto control = rig.passes->controlOf(0);
    CHECK(control.listed.x == pairs);
    CHECK(control.listed.y == surfaces);
    CHECK(control.listed.z == 0);
    CHECK(control.list.w == 1);
    const auto ranges = rig.passes->ranges.readAll<gpu::uvec4>(t.particles());
    const auto rows = rig.passes->rows.readAll<std::uint32_t>(t.rowEntries + t.linkEntries);
    const auto entries = rig.passes->entries.readAll<glm::uvec2>(t.slots());
    std::size_t wrong = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
        std::vector<Link> found;
        std::uint32_t walls = 0, works = 0;
        for (std::uint32_t k = 0; k < ranges[i].w; ++k) {
            const std::uint32_t link = rows[t.rowEntries + ranges[i].z + k], slot = link >> 1;
            const bool pair = slot < t.pairSlots, second = (link & 1U) != 0;
            const bool wall = !pair && slot < t.springSlots();
            const std::uint32_t other = wall ? entries[slot].y & ((1U << gpu::kSurfaceBits) - 1) : entries[slot].y;
            found.push_back({entries[slot].x, other, pair});
            wrong += (second ? entries[slot].y : entries[slot].x) != i;
            if (wall) walls += 1, works += entries[slot].y >> gpu::kSurfaceBits;
        }
        wrong += works != walls;  // each of its contacts with surfaces is the work of one invocation
        wrong += found != expected[i];
    }
    CHECK(wrong == 0);
}

TEST_CASE("the sensor records add up to the host's sums") {
    RuledWorld world = emptyWorld();
    world.throatZ = 0.004;
    const std::size_t n = 203;
    Particles p = cloud(n, 0.02, 3);
    for (std::size_t i = 0; i < n; i += 7) p.status[i] = Status::Dosed;
    p.status[1] = Status::Lost;
    Rig rig(world, p);
    rig.run([&](vk::Commands& c) { rig.passes->recordSensing(c, 0); });
    gpu::uvec4 count(0);
    double mass[4] = {}, kinetic = 0, rotational = 0, throat = 0;
    for (const auto& group : rig.passes->records.readAll<gpu::GroupRecord>(rig.sizes.groups())) {
        const gpu::SensorRecord& r = group.sensors;
        count += r.count;
        for (int k = 0; k < 4; ++k) mass[k] += double(r.mass[k]);
        kinetic += double(r.motion.x);
        rotational += double(r.motion.y);
        throat += double(r.motion.z);
    }
    gpu::uvec4 counted(0);
    double weighed[4] = {}, k = 0, rot = 0, pz = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double m = world.density() * 4 / 3 * kPi * std::pow(p.radius[i], 3);
        const bool past = p.position[i].z > world.throatZ;
        const std::uint32_t region = p.status[i] == Status::Dosed  ? gpu::kRegionDosed
                                     : p.status[i] == Status::Lost ? gpu::kRegionLost
                                     : past                        ? gpu::kRegionThroat
                                                                   : gpu::kRegionCanister;
        ++counted[int(region)];
        weighed[region] += m;
        if (p.status[i] != Status::Active) continue;
        k += 0.5 * m * glm::dot(p.velocity[i], p.velocity[i]);
        rot += 0.2 * m * p.radius[i] * p.radius[i] * glm::dot(p.spin[i], p.spin[i]);
        if (region == gpu::kRegionThroat) pz += m * p.velocity[i].z;
    }
    CHECK(count == counted);
    CHECK(counted[gpu::kRegionThroat] > 5);
    // A record sums 64 numbers in single precision: six additions deep, 6e-8 each.
    for (int region = 0; region < 4; ++region) CHECK(nearRelative(mass[region], weighed[region], 1e-6));
    CHECK(nearRelative(kinetic, k, 1e-6));
    CHECK(nearRelative(rotational, rot, 1e-6));
    CHECK(near(throat, pz, k, 1e-5));
}

TEST_CASE("positions and speeds survive packing to single precision twice over") {
    Particles p = cloud(31, 0.3, 9);
    for (std::size_t i = 0; i < p.size(); ++i) {
        p.velocity[i] = 10.0 * Vec3(p.position[i].y, p.position[i].z, p.position[i].x);
        p.spin[i] = 1e4 * Vec3(p.position[i].z, p.position[i].x, p.position[i].y);
    }
    std::vector<gpu::vec4> half(std::size_t(gpu::kFields) * 64);
    packState(p, 64, 0, half);
    const Particles q = unpackState(half, packSpeedLows(p), 64, p);
    // Two floats hold 48 bits: 0.15 m to 1e-15 m.
    for (std::size_t i = 0; i < p.size(); ++i) {
        CHECK(near(q.position[i], p.position[i], 0.15, 2e-14));
        CHECK(near(q.velocity[i], p.velocity[i], 1.5, 2e-14));
        CHECK(near(q.spin[i], p.spin[i], 1500, 2e-14));
    }
}

TEST_CASE("indices of 32 bits reach for a hundred million spheres") {
    RuledWorld world = emptyWorld();
    world.skin = 0.75e-3;
    world.coil = geometry::Coil{};
    world.walls = {geometry::Plane{{0, 0, 0}, {0, 1, 0}}, geometry::Trough{0.0115},
                   geometry::Plane{{0, 0, 0}, {0, 0, 1}}};
    gpu::Member member{};
    for (int i = 0; i < 3; ++i) member.surface[i].pointHigh.w = float(gpu::kPlane);
    for (const bool book : {false, true}) {
        world.energyBook = book;
        const TableSizes t = tableSizes(world, Crowd(100'000'000, 1.25e-3), member, {64, 65535, 1ULL << 40});
        CHECK(t.particles() >= 100'000'000);
        CHECK(t.layers(t.groups()) * t.inRow(t.groups()) == t.groups());
        CHECK(t.inRow(t.groups()) <= 65535);
        CHECK(t.largestIndex() < (1ULL << 32));
        CHECK(t.pairSlots >= 350'000'000);
        CHECK(t.rowEntries >= 2'000'000'000);
    }
    CHECK_THROWS_WITH(tableSizes(world, Crowd(200'000'000, 1.25e-3), member, {64, 65535, 1ULL << 40}),
                      Catch::Contains("134217728"));
}

TEST_CASE("in a bed that hardly fits the device the bodies get the room that pairs and surfaces leave") {
    RuledWorld world = emptyWorld();
    world.coil = geometry::Coil{};
    const std::uint64_t n = 500'000, range = 1ULL << 27;
    const TableSizes t = tableSizes(world, Crowd(n, 1.25e-3), {}, {64, 65535, range});
    CHECK(t.bodySlots < n);
    CHECK(t.bodySlots >= n / 8);
    CHECK(t.longestBytes() <= range);
    CHECK(tableSizes(world, Crowd(n, 1.25e-3), {}, {64, 65535, 16 * range}).bodySlots >= n);
    // Beyond what fits, an eighth of the particles still finds room in the lists.
    CHECK(tableSizes(world, Crowd(4 * n, 1.25e-3), {}, {64, 65535, range}).bodySlots >= n / 2);
}

TEST_CASE("where dispatches go in layers, every layer is full") {
    const RuledWorld world = emptyWorld();
    for (const std::uint64_t n : {1u, 64u, 128u, 129u, 300u, 577u}) {
        INFO(n << " particles");
        const TableSizes t = tableSizes(world, Crowd(n, 1e-3), {}, {64, 2, 1ULL << 27});
        CHECK(t.share >= n);
        CHECK(t.inRow(t.groups()) <= 2);
        CHECK(t.layers(t.groups()) * t.inRow(t.groups()) == t.groups());
    }
}
