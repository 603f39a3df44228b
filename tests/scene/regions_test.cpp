// Regions on the device: particles are dosed where the reference doses them, at the step at which it does.

#include <algorithm>
#include <array>
#include <thread>

#include "host/sim/region_book.h"
#include "tests/scene/beds.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

CountRegion beyond(const Vec3& point, const Vec3& normal, bool deletes = true) {
    return {"beyond", CountRegion::Kind::Beyond, point, glm::normalize(normal), {}, {}, deletes};
}

CountRegion boxed(const Vec3& low, const Vec3& high, bool deletes = true) {
    return {"box", CountRegion::Kind::Box, {}, {}, low, high, deletes};
}

/// Five spheres that fly along x at 1 m/s in lanes 5 mm apart, without gravity.
Particles lanes() {
    Particles p;
    for (int i = 0; i < 5; ++i) p.add({0, 5e-3 * i, 0}, single(1e-3), {1, 0, 0});
    return p;
}

/// A world for them with a box that deletes across each of the first lanes.
RuledWorld boxesAcross(std::size_t count) {
    RuledWorld w = emptyWorld();
    w.gravity = Vec3(0);
    w.domain = {Vec3(-0.1), Vec3(0.1)};
    for (std::size_t k = 0; k < count; ++k)
        w.regions.push_back(boxed({10e-3, 5e-3 * double(k) - 2e-3, -1}, {20e-3, 5e-3 * double(k) + 2e-3, 1}));
    return w;
}

/// What the lanes' spheres are after 15 mm.
std::vector<Status> flown(Backend& device, const RuledWorld& w) {
    device.load(w, lanes());
    device.advance(std::uint32_t(15e-3 / w.timeStep), 0);
    return device.particles().status;
}

std::vector<Status> firstDosed(std::size_t count) {
    std::vector<Status> status(lanes().size(), Status::Active);
    std::fill_n(status.begin(), count, Status::Dosed);
    return status;
}

}  // namespace

TEST_CASE("regions: a slanted plane and a box dose what comes into them, and nothing else") {
    RuledWorld w = emptyWorld();
    w.gravity = Vec3(0);
    w.domain = {Vec3(-0.1), Vec3(0.1)};
    // The plane is met at x = 10 mm in the first lane and 5 mm later in each next one. The box stands in the last lane
    // before the plane, so that only it stops that sphere. The third region deletes nothing.
    w.regions = {beyond({10e-3, 0, 0}, {1, -1, 0}), boxed({4e-3, 18e-3, -5e-3}, {8e-3, 22e-3, 5e-3}),
                 beyond({2e-3, 0, 0}, {1, 0, 0}, false)};
    const Particles p = lanes();
    auto device = gpu();
    auto reference = makeReferenceBackend();
    device->load(w, p);
    reference->load(w, p);
    RegionBook book(w);
    const double dt = w.timeStep;
    std::vector<double> dosedAt(p.size(), 0);
    const auto perCall = std::uint32_t(std::ceil(0.5e-3 / dt));  // half a millimetre
    for (int call = 1; call <= 70; ++call) {
        device->advance(perCall, 0);
        reference->advance(perCall, 0);
        const Particles a = device->particles(), b = reference->particles();
        for (std::size_t i = 0; i < p.size(); ++i) {
            CHECK(a.status[i] == b.status[i]);
            if (a.status[i] == Status::Dosed && dosedAt[i] == 0) dosedAt[i] = a.position[i].x;
        }
        book.look(a, {});
    }
    // A sphere goes a step farther at most, and the device rounds its place to single precision.
    const double step = dt * 1.0 + 1e-8;
    const std::vector<double> expected{10e-3, 15e-3, 20e-3, 25e-3, 4e-3};
    for (std::size_t i = 0; i < p.size(); ++i) {
        CAPTURE(i);
        CHECK(dosedAt[i] > expected[i] - 1e-8);
        CHECK(dosedAt[i] < expected[i] + step);
    }
    const double mass = sphereMass(w.density(), single(1e-3));
    CHECK(book.samples()[0].came.particles == 4);
    CHECK(book.samples()[1].came.particles == 1);
    CHECK(book.samples()[2].came.particles == 5);
    CHECK(book.samples()[0].came.mass == Approx(4 * mass));
    CHECK(book.samples()[2].came.mass == Approx(5 * mass));

    // Back from a record, the book counts nobody again.
    Record record;
    book.save(record);
    RegionBook again(w);
    again.restore(record);
    again.look(device->particles(), {});
    CHECK(again.samples()[0].came.particles == 4);
    CHECK(again.samples()[2].came.particles == 5);
    again.openDose();
    CHECK(again.sinceDose()[2].particles == 0);
}

TEST_CASE("regions: as many as a device has places for, and none more", "[every-driver]") {
    auto device = gpu();
    for (const std::size_t count : {std::size_t(0), kMaxOutlets, std::size_t(1)})
        CHECK(flown(*device, boxesAcross(count)) == firstDosed(count));
    CHECK_THROWS_AS(device->load(boxesAcross(kMaxOutlets + 1), lanes()), RunError);
}

TEST_CASE("regions: members with none, one and two that delete share tables") {
    auto backends = gpuEnsemble(3);
    std::array<std::vector<Status>, 3> status;
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < 3; ++k)
        threads.emplace_back([&, k] {
            status[k] = flown(*backends[k], boxesAcross(k));
            backends[k].reset();
        });
    for (std::thread& t : threads) t.join();
    for (std::size_t k = 0; k < 3; ++k) CHECK(status[k] == firstDosed(k));
}
