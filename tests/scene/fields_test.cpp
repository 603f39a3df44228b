// Coarse-grained fields on the device, against the reference and against themselves.

#include <algorithm>
#include <bit>
#include <map>
#include <thread>

#include "tests/scene/beds.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

FieldRequest request(std::array<std::uint32_t, 3> cells, double width, Kernel kernel = Kernel::Gaussian) {
    FieldRequest r;
    r.grid = {Vec3(-0.0115, -0.0115, 0), Vec3(0.0115, 0.05, 0.07), cells};
    r.kernel = kernel;
    r.width = width;
    r.contactStress = true;
    return r;
}

/// The scales of the numbers of FieldPoint: the largest of their kind.
std::array<double, FieldPoint::kNumbers> scales(const FieldPoints& points) {
    std::array<double, FieldPoint::kNumbers> most{};
    const auto kinds = [](std::size_t k) { return k < 1 ? 0 : k < 4 ? 1 : k < 5 ? 2 : k < 6 ? 3 : k < 12 ? 4 : 5; };
    std::array<double, 6> largest{};
    for (const FieldPoint& p : points)
        for (std::size_t k = 0; k < most.size(); ++k)
            largest[std::size_t(kinds(k))] = std::max(largest[std::size_t(kinds(k))], std::abs(p.numbers()[k]));
    for (std::size_t k = 0; k < most.size(); ++k) most[k] = largest[std::size_t(kinds(k))];
    return most;
}

/// The worst difference of each number, in units of the largest of its kind.
double difference(const FieldPoints& a, const FieldPoints& b) {
    REQUIRE(a.size() == b.size());
    const auto scale = scales(b);
    double worst = 0;
    for (std::size_t n = 0; n < a.size(); ++n)
        for (std::size_t k = 0; k < scale.size(); ++k) {
            REQUIRE(scale[k] > 0);
            const double d = std::abs(a[n].numbers()[k] - b[n].numbers()[k]) / scale[k];
            worst = std::isfinite(d) ? std::max(worst, d) : INFINITY;
        }
    return worst;
}

bool sameBits(const FieldPoints& a, const FieldPoints& b) {
    return a.size() == b.size() &&
           std::equal(a.begin(), a.end(), b.begin(), [](const FieldPoint& x, const FieldPoint& y) {
               const auto p = x.numbers(), q = y.numbers();
               return std::equal(p.begin(), p.end(), q.begin(), [](double s, double t) {
                   return std::bit_cast<std::uint64_t>(s) == std::bit_cast<std::uint64_t>(t);
               });
           });
}

constexpr double kRate = -9.42;

}  // namespace

TEST_CASE("fields: the device's are the reference's, of a packing on walls and coil", "[every-driver]") {
    RuledWorld world = canisterWorld();
    world.maxOverlapRatio = 1;
    const auto device = gpu(), reference = makeReferenceBackend();
    reference->load(world, thrownIn(307));
    reference->advance(6000, kRate);  // until they lie on each other, on walls and coil
    const Particles p = reference->particles();
    for (Backend* b : {device.get(), reference.get()}) {
        b->load(world, p);
        b->advance(50, kRate);
    }
    std::array<int, kContactClasses> contacts{};
    for (const Contact& c : reference->contacts()) ++contacts[std::size_t(c.kind)];
    REQUIRE(contacts[0] > 40);
    REQUIRE(contacts[1] > 10);
    REQUIRE(contacts[2] > 5);
    const Sensors now = reference->advance(0, kRate);
    const double whole = now.mass[0] + now.mass[1];
    for (const auto& r : {request({1, 1, 37}, 2.5e-3), request({1, 29, 41}, 2e-3),
                          request({7, 13, 19}, 6e-3, Kernel::Lucy), request({1, 1, 1}, 1e-3)}) {
        const FieldPoints expected = reference->fields(r), got = device->fields(r);
        // Single precision: a kernel's value at its edge is good to 1e-5, a force to 1e-7 of k times the radius, which
        // is 1e-4 of the largest here.
        CHECK(difference(got, expected) < 4e-4);
        double mass = 0;
        for (const FieldPoint& at : got) mass += at.density * r.grid.cellVolume();
        CHECK(nearRelative(mass, whole, 1e-6));  // rounding of single precision
    }
    requireClean(*device);
}

TEST_CASE("fields: on the device too each turn of the coil that a sphere touches has a branch of its own") {
    RuledWorld world = canisterWorld();
    world.energyBook = GENERATE(false, true);  // the history of a turn is longer with it
    world.walls.clear();
    world.gravity = Vec3(0);
    world.coil->pitch = 3.5e-3;  // spheres fit between two turns and lie in the groove
    const Particles p = aroundTheWire(*world.coil, single(0.9e-3));
    const auto device = gpu(), reference = makeReferenceBackend();
    for (Backend* b : {device.get(), reference.get()}) {
        b->load(world, p);
        b->advance(3, kRate);
    }
    std::map<std::uint32_t, int> turns;
    for (const Contact& c : reference->contacts()) ++turns[c.particle];
    const auto twice = std::count_if(turns.begin(), turns.end(), [](const auto& of) { return of.second == 2; });
    REQUIRE(twice > 2);
    for (const auto& r : {request({1, 1, 71}, 2.5e-3), request({9, 29, 31}, 5e-3, Kernel::Lucy)}) {
        // The wire's phase in single precision is good to 3e-9 m, of overlaps of 2e-6 m.
        CHECK(stressDifference(device->fields(r), reference->fields(r)) < 4e-3);
    }
    requireClean(*device);
}

TEST_CASE("fields: on the device, a bed that moves as one has that velocity to the last bits") {
    RuledWorld world = emptyWorld();
    Particles p = thrownIn(131);
    for (Vec3& v : p.velocity) v = Vec3(0.25, -0.5, 1);
    const auto device = gpu();
    device->load(world, p);
    const FieldRequest r = request({5, 11, 17}, 6e-3, Kernel::Lucy);
    std::size_t filled = 0;
    for (const FieldPoint& at : device->fields(r)) {
        if (at.density == 0) continue;
        ++filled;
        CHECK(near(at.velocity(), Vec3(0.25, -0.5, 1), 1, 3e-7));
        CHECK(near(at.temperature(), 0, 1, 1e-12));
        CHECK(at.contactStress[1].y == 0);  // no step has been made
    }
    CHECK(filled > 100);
    requireClean(*device);
}

TEST_CASE("fields: asking for them changes nothing, and gives the same bits however the steps were cut") {
    const RuledWorld world = canisterWorld();
    const Particles p = thrownIn(211);
    const FieldRequest r = request({1, 23, 31}, 2e-3), small = request({1, 1, 5}, 0.02);
    VulkanOptions few;
    few.batch = 7;
    VulkanOptions wide;
    wide.workgroup = 128;
    wide.mostGroups = 3;  // in layers
    const auto a = gpu(), b = gpu(few), c = gpu(byAddress(wide));
    for (Backend* backend : {a.get(), b.get(), c.get()}) backend->load(world, p);
    for (int n = 0; n < 4; ++n) {
        a->advance(100, kRate);
        CHECK(a->fields(small).size() == 5);
        CHECK(a->fields(r).size() == 23UL * 31);
        b->advance(30, kRate);
        b->advance(70, kRate);
    }
    c->advance(400, kRate);
    const FieldPoints first = a->fields(r);
    CHECK(sameBits(first, a->fields(r)));
    CHECK(sameBits(first, b->fields(r)));
    CHECK(sameBits(first, c->fields(r)));
    CHECK(test::sameBits(a->particles(), c->particles()));
    CHECK(test::sameBits(a->contacts(), c->contacts()));

    const auto again = gpu();
    again->load(world, p);
    again->restore(a->snapshot());
    for (Backend* backend : {a.get(), again.get()}) backend->advance(50, kRate);
    CHECK(sameBits(a->fields(r), again->fields(r)));
    for (const Backend* backend : {a.get(), b.get(), c.get(), again.get()}) requireClean(*backend);
}

TEST_CASE("fields: a canister has the same in an ensemble as alone") {
    const FieldRequest r = request({1, 11, 17}, 3e-3);
    const RuledWorld world = canisterWorld();
    const std::array<Particles, 2> beds{thrownIn(67), thrownIn(130)};
    std::array<FieldPoints, 2> alone, together;
    const auto run = [&](Backend& backend, std::size_t k) {
        backend.load(world, beds[k]);
        backend.advance(k == 0 ? 60 : 90, kRate);
        return backend.fields(r);
    };
    for (std::size_t k = 0; k < 2; ++k) alone[k] = run(*gpu(), k);
    auto ensemble = gpuEnsemble(2);
    std::thread other([&] {
        together[1] = run(*ensemble[1], 1);
        ensemble[1].reset();
    });
    together[0] = run(*ensemble[0], 0);
    requireClean(*ensemble[0]);
    ensemble[0].reset();
    other.join();
    for (std::size_t k = 0; k < 2; ++k) CHECK(sameBits(alone[k], together[k]));
}
