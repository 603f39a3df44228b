// Loads on walls: on the device as in the reference, beside those of bodies and coil, in other batches, and without a
// change of the motion.

#include <cmath>
#include <thread>

#include "tests/scene/body_beds.h"
#include "tests/support/catch.h"
#include "tests/support/records.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// The canister with its coil and a ball in it.
RuledWorld loadedCanister() {
    RuledWorld w = canisterWorld();
    w.wallLoads = true;
    w.coil->radius = 6e-3;  // clear of what lies in the trough
    w.bodies.push_back(bodyOf("ball", {geometry::Ball{Vec3(0, -2e-3, 30e-3), 2e-3}}));
    return w;
}

/// Spheres that overlap trough, rear wall, front wall, the floor of the throat and the rim before it, the ball, the
/// coil from inside, and each wall of a corner; they move and turn.
Particles pressedSpheres() {
    const RuledWorld w = loadedCanister();
    const double a = 1.25e-3, low = -11.5e-3 + a - 1e-5;
    Particles p;
    p.add({0, low, 10e-3}, single(a), Vec3(0.05, 0, 0.02), Vec3(20, 3, -10));
    p.add({2e-3, 2e-3, a - 1e-5}, single(a), Vec3(0, 0.03, -0.01), Vec3(1, -20, 5));
    p.add({-2e-3, low + 0.2e-3, a - 2e-5}, single(a), Vec3(0, -0.1, -0.1), Vec3(0));
    p.add({0, 14e-3, 60e-3 - a + 1e-5}, single(a), Vec3(0.02, 0, 0), Vec3(0, 0, 30));
    p.add({0, low, 65e-3}, single(a), Vec3(0.04, 0, 0), Vec3(0, 5, 0));
    p.add({1e-3, low + 0.05e-3, 59.9e-3}, single(a), Vec3(0, 0, 0.1), Vec3(10, 0, 0));
    p.add({0, 2e-5 + a - 0.03e-3, 30e-3}, single(a), Vec3(0, -0.02, 0), Vec3(0, 0, -10));
    p.add({-6e-3 + 1e-3 + a - 1e-5, 0, w.coil->pitch / 2}, single(a), Vec3(0, 0.02, 0), Vec3(0, 0, 3));
    p.add({-10.2e-3, 5e-3, 20e-3}, single(a), Vec3(-0.05, 0.01, 0), Vec3(0, 0, 8));
    return p;
}

constexpr double kDriveOfCoil = -3;  // [rad/s]

}  // namespace

TEST_CASE("wall loads: on the device as in the reference, behind those of bodies and coil", "[every-driver]") {
    RuledWorld w = loadedCanister();
    std::size_t before = 2;
    SECTION("beside a body and the coil") {}
    SECTION("of walls alone") {
        w.bodies.clear();
        w.coil.reset();
        before = 0;
    }
    auto device = gpu();
    auto reference = makeReferenceBackend();
    device->load(w, pressedSpheres());
    reference->load(w, pressedSpheres());
    for (int call = 0; call < 4; ++call) {
        const Sensors a = device->advance(50, kDriveOfCoil), b = reference->advance(50, kDriveOfCoil);
        REQUIRE(a.bodies.size() == before + 3);
        REQUIRE(b.bodies.size() == before + 3);
        for (std::size_t k = 0; k < a.bodies.size(); ++k) {
            CAPTURE(call, k);
            const double scale = std::max(1e-3, glm::length(b.bodies[k].force));
            CHECK(near(a.bodies[k].force, b.bodies[k].force, scale, 2e-3));
            CHECK(near(a.bodies[k].torque, b.bodies[k].torque, scale * 0.01, 2e-3));
            if (k >= before) CHECK(a.bodies[k].work == 0);
            if (call == 0 && k >= before) CHECK(glm::length(b.bodies[k].force) > 1e-4);
        }
    }
    requireClean(*device);
}

TEST_CASE("wall loads: a wall tells what the same wall as a body tells") {
    RuledWorld walls = emptyWorld();
    walls.gravity = Vec3(0, -9.81, 0);
    walls.wallLoads = true;
    const geometry::Plane floor{Vec3(0, -12e-3, 0), Vec3(0, 1, 0)};
    const geometry::Tube tube{Vec3(0), Vec3(0, 1, 0), 9e-3, geometry::kEndless, true};
    RuledWorld bodies = walls;
    walls.walls = {floor, tube};
    bodies.wallLoads = false;
    bodies.bodies = {bodyOf("floor", {floor}), bodyOf("tube", {tube})};
    Particles bed = tubeBed();
    for (Vec3& x : bed.position) x.y -= 12e-3;
    auto a = gpu(), b = gpu();
    a->load(walls, bed);
    b->load(bodies, bed);
    const Sensors of = a->advance(8000, 0), as = b->advance(8000, 0);
    REQUIRE(of.bodies.size() == 2);
    for (std::size_t k = 0; k < 2; ++k) {
        const double scale = glm::length(as.bodies[0].force);
        CHECK(scale > 1e-3);
        CHECK(near(of.bodies[k].force, as.bodies[k].force, scale, 2e-2));
        CHECK(near(of.bodies[k].torque, as.bodies[k].torque, scale * 0.01, 2e-2));
    }
}

TEST_CASE("wall loads: to tell them changes no bit of the motion, and batches no bit of them") {
    RuledWorld silent = loadedCanister();
    silent.wallLoads = false;
    auto a = gpu(), b = gpu(), c = gpu();
    a->load(loadedCanister(), pressedSpheres());
    b->load(silent, pressedSpheres());
    c->load(loadedCanister(), pressedSpheres());
    const Sensors whole = a->advance(120, kDriveOfCoil);
    CHECK(b->advance(120, kDriveOfCoil).bodies.size() == 2);
    const Sensors first = c->advance(50, kDriveOfCoil), second = c->advance(70, kDriveOfCoil);
    checkSameArrays(a->snapshot(), b->snapshot());
    checkSameArrays(a->snapshot(), c->snapshot());
    for (std::size_t k = 0; k < whole.bodies.size(); ++k) {
        const Vec3 joined = (50.0 * first.bodies[k].force + 70.0 * second.bodies[k].force) / 120.0;
        CHECK(near(whole.bodies[k].force, joined, std::max(1e-3, glm::length(joined)), 1e-5));
    }
}

TEST_CASE("wall loads: of a canister beside one that does not ask for them, and that has other bodies") {
    RuledWorld asks = loadedCanister(), silent = loadedCanister();
    silent.wallLoads = false;
    silent.bodies.push_back(bodyOf("second", {geometry::Ball{Vec3(0, 5e-3, 40e-3), 1e-3}}));
    auto alone = gpu();
    alone->load(asks, pressedSpheres());
    const Sensors expected = alone->advance(60, kDriveOfCoil);
    std::vector<std::unique_ptr<Backend>> both = gpuEnsemble(2);
    Sensors told, untold;
    std::thread other([&] {
        both[1]->load(silent, pressedSpheres());
        untold = both[1]->advance(60, kDriveOfCoil);
        both[1].reset();
    });
    both[0]->load(asks, pressedSpheres());
    told = both[0]->advance(60, kDriveOfCoil);
    both[0].reset();
    other.join();
    REQUIRE(told.bodies.size() == 5);
    CHECK(untold.bodies.size() == 3);
    for (std::size_t k = 0; k < 5; ++k) {
        CHECK(told.bodies[k].force == expected.bodies[k].force);
        CHECK(told.bodies[k].torque == expected.bodies[k].torque);
    }
}
