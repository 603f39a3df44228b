// Directions that repeat: where an end of the domain lies changes nothing, on the device as in the reference.

#include <random>
#include <thread>

#include "host/sim/energy_ledger.h"
#include "tests/scene/body_beds.h"
#include "tests/support/catch.h"
#include "tests/support/records.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr double kLength = 10e-3;  // of a period along z [m]

void repeatAlong(RuledWorld& w, int d) {
    w.period[d] = w.domain.high[d] - w.domain.low[d];
}

/// A surface of triangles that goes on along z, cut there every 2.5 mm: through these corners of its cross-section.
geometry::Shape stripThrough(const std::vector<glm::dvec2>& corners) {
    std::vector<geometry::Triangle> triangles;
    const double cut = kLength / 4;
    for (std::size_t k = 0; k + 1 < corners.size(); ++k)
        for (int n = -4; n < 8; ++n) {
            const Vec3 a(corners[k], n * cut), b(corners[k + 1], n * cut), up(0, 0, cut);
            triangles.push_back({a, b, b + up});
            triangles.push_back({a, b + up, a + up});
        }
    return std::make_shared<const geometry::MeshSurface>(geometry::makeMesh(geometry::soupOf(triangles, "strip")).mesh,
                                                         2e-3);
}

/// A slice of a chute: a floor, two side walls and a mesh that the powder goes over, the same along z; gravity points
/// down and along z.
RuledWorld slice() {
    RuledWorld w = emptyWorld();
    w.domain = {Vec3(-0.02, -0.01, 0), Vec3(0.02, 0.1, kLength)};
    repeatAlong(w, 2);
    w.walls = {geometry::Plane{{0, 0, 0}, {0, 1, 0}}, geometry::Plane{{-8e-3, 0, 0}, {1, 0, 0}}};
    w.bodies.push_back(bodyOf("wall", {geometry::Plane{{8e-3, 0, 0}, {-1, 0, 0}}}));
    w.bodies.push_back(bodyOf("rib", {stripThrough({{-1.5e-3, 0.2e-3}, {0, 1.5e-3}, {1.5e-3, 0.2e-3}})}));
    w.gravity = Vec3(0, -9.81, 4);
    return w;
}

/// Spheres in layers over the floor, moved along z by `shift`.
Particles heaped(int count, double shift = 0) {
    Particles p;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < count; ++i) {
        Vec3 at((i % 5 - 2) * 2.75e-3, 2.6e-3 + (i / 20) * 2.75e-3, 1.3e-3 + (i / 5 % 4) * 2.5e-3);
        at += 1e-5 * Vec3(unit(random), unit(random), unit(random));
        at.z = std::fmod(at.z + shift, kLength);
        p.add(at, single(1.25e-3 + 1e-5 * unit(random)),
              Vec3(-20 * at.x, -15 * at.y, 0.6) + 0.05 * Vec3(unit(random), unit(random), unit(random)),
              50.0 * Vec3(unit(random), unit(random), unit(random)));
    }
    return p;
}

/// The largest distance of two beds of one world, of the radius; the second is `shift` farther along z.
double apart(const Backend& a, const Backend& b, const World& w, double shift = 0) {
    const Particles p = a.particles(), q = b.particles();
    double most = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
        most = std::max(
            most, glm::length(w.shortest(unfolded(w, q, i) - unfolded(w, p, i) - Vec3(0, 0, shift))) / p.radius[i]);
    return most;
}

std::size_t acrossTheEnd(const Backend& backend) {
    const Particles p = backend.particles();
    std::size_t count = 0;
    for (const Contact& c : backend.contacts())
        if (c.kind == ContactClass::ParticleParticle)
            count += glm::length(p.position[c.particle] - p.position[c.other]) > 2 * 1.4e-3 ? 1 : 0;
    return count;
}

}  // namespace

TEST_CASE("period: a contact that goes through the end keeps its history", "[every-driver]") {
    const bool reference = GENERATE(false, true);
    RuledWorld w = emptyWorld();
    w.gravity = Vec3(0);
    for (ContactParameters& c : w.law.pairs) c.plasticityDepth = 1e-3;  // so that they stick
    w.domain = {Vec3(-0.02, -0.02, -kLength / 2), Vec3(0.02, 0.02, kLength / 2)};
    RuledWorld open = w;
    open.domain = {Vec3(-1), Vec3(1)};
    repeatAlong(w, 2);
    // They stick together and turn against each other, and both go along z through the end and on.
    Particles p;
    p.add({0, 0, 4.85e-3}, single(1.3e-3), {0, 0, 1.2}, {0, 0, 30});
    p.add({2.494e-3, 0.1e-3, 4.95e-3}, single(1.2e-3), {0, 0, 1.2}, {0, 20, 25});
    const auto through = made(reference), free = made(reference);
    through->load(w, p);
    free->load(open, p);
    double most = 0;
    for (int call = 0; call < 12; ++call) {  // the second goes through after 20 steps, the first after 60
        through->advance(41, 0);
        free->advance(41, 0);
        const Particles a = through->particles(), b = free->particles();
        for (std::size_t i = 0; i < 2; ++i) {
            CHECK(near(unfolded(w, a, i), b.position[i], a.radius[i], reference ? 1e-9 : 1e-5));
            CHECK(near(a.velocity[i], b.velocity[i], 1.2, reference ? 1e-9 : 1e-5));
            CHECK(near(a.spin[i] * a.radius[i], b.spin[i] * a.radius[i], 1.2, reference ? 1e-9 : 1e-5));
            CHECK(std::abs(a.position[i].z) <= kLength / 2 * (1 + 1e-5));
        }
        const std::vector<Contact> ours = through->contacts(), theirs = free->contacts();
        CAPTURE(reference, call);
        REQUIRE(theirs.size() == 1);
        REQUIRE(ours.size() == 1);
        CHECK(theirs[0].maxOverlap > 1e-6);
        const double springs = glm::length(theirs[0].sliding) + glm::length(theirs[0].rolling);
        most = std::max(most, springs);
        CHECK(near(ours[0].maxOverlap, theirs[0].maxOverlap, theirs[0].maxOverlap, reference ? 1e-9 : 1e-4));
        CHECK(near(ours[0].sliding, theirs[0].sliding, springs + 1e-9, reference ? 1e-7 : 1e-2));
        CHECK(near(ours[0].rolling, theirs[0].rolling, springs + 1e-9, reference ? 1e-7 : 1e-2));
    }
    CHECK(most > 1e-7);
    const Particles end = through->particles();
    CHECK(end.gone[0] == glm::ivec3(0, 0, 1));
    CHECK(end.gone[1] == glm::ivec3(0, 0, 1));
    if (!reference) requireClean(*through);
}

TEST_CASE("period: where the end lies changes nothing") {
    const bool reference = GENERATE(false, true);
    const RuledWorld w = slice();
    const double shift = GENERATE(1.3e-3, 7.777e-3);
    const auto one = made(reference), other = made(reference);
    one->load(w, heaped(120));
    other->load(w, heaped(120, shift));
    std::size_t touching = 0, across = 0, acrossThere = 0;
    for (int call = 0; call < 5; ++call) {
        one->advance(400, 0);
        other->advance(400, 0);
        touching = std::max(touching, one->contacts().size());
        across = std::max(across, acrossTheEnd(*one));
        acrossThere = std::max(acrossThere, acrossTheEnd(*other));
        CHECK(apart(*one, *other, w, shift) < (reference ? 1e-8 : 2e-3));
    }
    CHECK(touching > 80);
    CHECK(across > 8);
    CHECK(acrossThere > 8);
    CHECK(one->contacts().size() == other->contacts().size());
    if (!reference) requireClean(*other);
}

TEST_CASE("period: a bed that flows through the end is that of the reference", "[every-driver]") {
    RuledWorld w = slice();
    w.energyBook = true;
    const Particles p = heaped(80);
    const auto device = gpu(), reference = makeReferenceBackend();
    device->load(w, p);
    reference->load(w, p);
    EnergyLedger ours, theirs;
    std::size_t across = 0;
    for (int call = 0; call < 6; ++call) {
        const Sensors a = device->advance(1001, 0), b = reference->advance(1001, 0);
        ours.add(*a.energy);
        theirs.add(*b.energy);
        CHECK(near(theirs.residual(), 0, theirs.sum.loaded, 1e-10));
        CHECK(near(ours.residual(), 0, theirs.sum.loaded, 1e-4));
        CHECK(near(ours.sum.potential, theirs.sum.potential, std::abs(theirs.sum.loaded), 1e-2));
        CHECK(a.through[0] == 0);
        CHECK(near(a.through[2], b.through[2], massOf(w, p, 0), call < 3 ? 1e-4 : 3));
        across = std::max(across, acrossTheEnd(*device));
        if (call == 1) {
            const Differences d = differences(*device, *reference, 0.5);
            CHECK(d.unmatched == 0);
            CHECK(d.spring < 1e-3);
            CHECK(apart(*device, *reference, w) < 1e-3);
        }
    }
    // The ledger of energy holds only if a particle that has gone through the end is still that much lower.
    CHECK(reference->advance(1, 0).through[2] > 5 * massOf(w, p, 0));
    CHECK(across > 4);
    requireClean(*device);
}

TEST_CASE("period: momentum stays in a domain that repeats along two directions") {
    const bool reference = GENERATE(false, true);
    const int open = GENERATE(0, 1, 2);
    RuledWorld w = emptyWorld();
    w.gravity = Vec3(0);
    w.energyBook = true;
    w.domain = {Vec3(-6e-3, -7e-3, -8e-3), Vec3(6e-3, 7e-3, 8e-3)};
    for (int d = 0; d < 3; ++d)
        if (d != open) repeatAlong(w, d);
    w.domain.low[open] = -1;
    w.domain.high[open] = 1;
    Particles p;
    std::mt19937 random(8);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 64; ++i)
        p.add(Vec3(-4.5e-3, -5.25e-3, -6e-3) + Vec3(3e-3, 3.5e-3, 4e-3) * Vec3(i % 4, i / 4 % 4, i / 16),
              single(1.45e-3), Vec3(unit(random), unit(random), unit(random)));
    const auto backend = made(reference);
    backend->load(w, p);
    Vec3 before(0);
    double scale = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        before += massOf(w, p, i) * p.velocity[i];
        scale += massOf(w, p, i) * glm::length(p.velocity[i]);
    }
    Sensors s;
    for (int call = 0; call < 4; ++call) {
        s = backend->advance(1500, 0);
        CHECK(near(s.energy->momentum, before, scale, reference ? 1e-12 : 1e-5));
    }
    const Particles q = backend->particles();
    std::array<double, 3> through{};
    for (std::size_t i = 0; i < q.size(); ++i)
        for (int d = 0; d < 3; ++d) {
            through[std::size_t(d)] += massOf(w, p, i) * q.gone[i][d];
            if (d != open) CHECK(std::abs(q.position[i][d]) <= w.period[d] / 2 * (1 + 1e-5));
        }
    for (int d = 0; d < 3; ++d) {
        const auto k = std::size_t(d);
        CHECK(near(s.through[k], through[k], massOf(w, p, 0), 1e-4));
        bool some = false;
        for (const glm::ivec3& gone : q.gone) some = some || gone[d] != 0;
        CHECK(some == (d != open));
    }
    if (!reference) requireClean(*backend);
}

TEST_CASE("period: a slice of a screw is as a long one") {
    const bool reference = GENERATE(false, true);
    const double pitch = 9e-3;
    const Vec3 z(0, 0, 1);
    const auto screwOf = [&](int turns, double from) {
        const geometry::Flight flight{3e-3, 9e-3, 1e-3, pitch, pitch, 2 * kPi * turns, from, 0.3, 1};
        return bodyOf("screw", {flight, geometry::Cone{{0, 0, from}, z, 3e-3, 3e-3, pitch * turns}},
                      geometry::Turn{z, Vec3(0), -450});
    };
    RuledWorld open = emptyWorld();
    open.domain = {Vec3(-0.03, -0.03, -0.02), Vec3(0.03, 0.03, 0.08)};
    open.bodies = {screwOf(9, -2 * pitch), bodyOf("tube", {geometry::Tube{{0, 0, -0.1}, z, 10e-3, 0.3, true}})};
    RuledWorld w = open;
    w.bodies[0] = screwOf(3, -pitch);
    w.domain.low.z = 0;
    w.domain.high.z = pitch;
    repeatAlong(w, 2);
    Particles p;
    for (double height = 0.3e-3; p.size() < 2; height += 0.1e-3) {  // where they are clear of the blade
        const Vec3 at(1.5e-3 * double(p.size()) - 1e-3, -7e-3, height);
        const bool apart = p.size() == 0 || at.z - p.position.back().z > 2.6e-3;
        if (apart && geometry::touched(open.bodies[0].shapes, at, 1.3e-3).empty())
            p.add(at, single(1.25e-3), Vec3(0.05, -0.1, 0.4), Vec3(3, 1, -2));
    }
    const auto endless = made(reference), part = made(reference);
    endless->load(open, p);
    part->load(w, p);
    double way = 0;
    for (int call = 0; call < 8; ++call) {
        endless->advance(1000, 0);
        part->advance(1000, 0);
        const Particles a = part->particles(), b = endless->particles();
        for (std::size_t i = 0; i < p.size(); ++i) {
            CHECK(near(unfolded(w, a, i), b.position[i], a.radius[i], reference ? 1e-6 : 1e-2));
            way = std::max(way, b.position[i].z - p.position[i].z);
        }
        CHECK(part->contacts().size() == endless->contacts().size());
    }
    CHECK(way > pitch);
    if (!reference) requireClean(*part);
}

TEST_CASE("period: a sphere that goes through the end finds the mesh there") {
    RuledWorld w = emptyWorld();
    w.gravity = Vec3(0);
    w.domain = {Vec3(-0.02, -0.01, 0), Vec3(0.02, 0.1, kLength)};
    repeatAlong(w, 2);
    w.bodies = {bodyOf("plate", {stripThrough({{-5e-3, 0}, {5e-3, 0}})})};
    // It rebounds from the edge of the plate, and goes through in the middle of the 70 steps that
    // this takes.
    const double a = single(1.25e-3), speed = 0.02;
    const Vec3 from(std::sin(0.3), std::cos(0.3), 0);
    Particles p;
    p.add(Vec3(5e-3, 0, kLength - 6.4e-6) + (a + 1.03e-6) * from, a, Vec3(0, 0, 0.05) - speed * from);
    const auto device = gpu(), reference = makeReferenceBackend();
    for (Backend* b : {device.get(), reference.get()}) {
        b->load(w, p);
        b->advance(120, 0);
        CHECK(b->contacts().empty());
        CHECK(b->particles().gone[0].z == 1);
        CHECK(glm::dot(b->particles().velocity[0], from) > 0.5 * speed);
    }
    CHECK(near(device->particles().velocity[0], reference->particles().velocity[0], speed, 1e-3));
    requireClean(*device);
}

TEST_CASE("period: a restart, other batches, tables by address and other members change no bit") {
    RuledWorld w = slice();
    w.energyBook = GENERATE(false, true);
    const Particles p = heaped(97);
    VulkanOptions small;
    small.batch = 13;
    const auto whole = gpu(), other = gpu(small), second = gpu(byAddress());
    for (Backend* b : {whole.get(), other.get(), second.get()}) b->load(w, p);
    whole->advance(2501, 0);
    other->advance(2501, 0);
    CHECK(sameBits(whole->particles(), other->particles()));
    CHECK(whole->particles().gone == other->particles().gone);
    const Record taken = whole->snapshot();
    second->restore(taken);
    checkSameArrays(taken, second->snapshot());
    for (int call = 0; call < 2; ++call) {
        const Sensors a = whole->advance(1701, 0), b = second->advance(1701, 0);
        CHECK(a.through == b.through);
        CHECK(a.through[2] != 0);
        CHECK(sameBits(whole->particles(), second->particles()));
        CHECK(sameBits(whole->contacts(), second->contacts()));
    }
    // Beside a member whose domain ends.
    auto members = gpuEnsemble(2);
    RuledWorld ending = w;
    ending.period = Vec3(0);
    ending.domain = {Vec3(-1), Vec3(1)};
    ending.gravity = Vec3(0, -9.81, 0);
    std::thread first([&] {
        members[0]->load(ending, heaped(33));
        members[0]->advance(2501, 0);
        members[0].reset();  // nobody waits for it any more
    });
    members[1]->load(w, p);
    members[1]->advance(2501, 0);
    CHECK(sameBits(members[1]->particles(), other->particles()));
    requireClean(*members[1]);
    first.join();
}

TEST_CASE("period: reference: restored and uninterrupted are the same bits") {
    RuledWorld w = slice();
    const auto whole = makeReferenceBackend(), second = makeReferenceBackend();
    whole->load(w, heaped(60));
    whole->advance(3000, 0);
    second->load(w, heaped(60));
    second->restore(whole->snapshot());
    const Sensors a = whole->advance(2000, 0), b = second->advance(2000, 0);
    CHECK(a.through == b.through);
    CHECK(a.through[2] != 0);
    CHECK(sameBits(whole->particles(), second->particles()));
}

TEST_CASE("period: fields go on across the end") {
    RuledWorld w = slice();
    FieldRequest request;
    request.grid = {Vec3(-8e-3, 0, 0), Vec3(8e-3, 20e-3, kLength), {12, 15, 8}};
    request.kernel = GENERATE(Kernel::Gaussian, Kernel::Lucy);
    request.width = 1.2e-3;
    request.contactStress = true;
    // Two points along z are as far apart as the shift is long.
    const double shift = 2 * kLength / 8;
    const auto reference = makeReferenceBackend(), moved = makeReferenceBackend(), device = gpu();
    reference->load(w, heaped(80));
    moved->load(w, heaped(80, shift));
    device->load(w, heaped(80));
    for (Backend* b : {reference.get(), moved.get(), device.get()}) b->advance(1500, 0);
    const FieldPoints a = reference->fields(request), b = moved->fields(request), c = device->fields(request);
    double mass = 0, whole = 0;
    const Particles p = reference->particles();
    for (const FieldPoint& point : a) mass += point.density * request.grid.cellVolume();
    for (std::size_t i = 0; i < p.size(); ++i) whole += massOf(w, p, i);
    CHECK(near(mass, whole, whole, 1e-12));
    CHECK(stressDifference(c, a) < 1e-2);
    double most = 0;
    for (const FieldPoint& point : a) most = std::max(most, point.density);
    for (std::uint32_t z = 0; z < 8; ++z)
        for (std::uint32_t k = 0; k < 180; ++k) {
            const std::size_t here = z * 180 + k, there = (z + 2) % 8 * 180 + k;
            CHECK(near(b[there].density, a[here].density, most, 1e-6));
            CHECK(near(b[there].contactStress[1][1], a[here].contactStress[1][1], 1e4, 1e-3));
            CHECK(near(c[here].density, a[here].density, most, 1e-3));
            CHECK(near(c[here].touches, a[here].touches, std::max(1.0, a[here].touches), 1e-2));
        }
    requireClean(*device);
}
