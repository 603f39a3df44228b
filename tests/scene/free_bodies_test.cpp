// Bodies that move freely on the device: as in the reference, and the same bits after a restart, in other batches and
// beside other canisters.

#include <cmath>
#include <thread>

#include "host/law/hertz.h"
#include "host/sim/energy_ledger.h"
#include "tests/scene/free_body_bits.h"
#include "tests/support/catch.h"
#include "tests/support/records.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr double kMass = 4e-3;  // [kg]

/// A closed tube about y with a ball over the spheres, which falls on them, and a piston below that stands.
RuledWorld dropWorld() {
    RuledWorld w = emptyWorld();
    w.domain = {Vec3(-0.02, -0.02, -0.02), Vec3(0.02, 0.06, 0.02)};
    const Vec3 y(0, 1, 0);
    w.bodies.push_back(bodyOf("tube", {geometry::Cone{Vec3(0), y, 9e-3, 9e-3, 50e-3}}));
    w.bodies.push_back(bodyOf("floor", {geometry::Cone{Vec3(0), y, 0, 9e-3, 0}}));
    RigidBody ball =
        bodyOf("ball", {geometry::Ball{Vec3(0), 5e-3}}, geometry::Free{kMass, Vec3(0.05, -1, 0.02), {}}, Clock::Forces);
    ball.course.start.origin = Vec3(0.2e-3, 17.1e-3, -0.3e-3);
    w.bodies.push_back(std::move(ball));
    return w;
}

}  // namespace

TEST_CASE("free bodies: on the device a ball flies and meets spheres as in the reference", "[every-driver]") {
    RuledWorld w = dropWorld();
    const Vec3 line = glm::normalize(Vec3(0.05, -1, 0.02));
    auto& free = std::get<geometry::Free>(w.bodies[2].course.motion);
    SECTION("anywhere") {}
    SECTION("along a line") {
        free.line = line;
        free.velocity = 1.0 * line;
    }
    SECTION("no heavier than a few spheres, under a law whose damping knows the masses") {
        w.law.pairs.fill(hertzMindlin({2e6, 0.25}, {2e6, 0.25}, 0.5));
        free.mass = 5e-5;
    }
    SECTION("driven along a line and about it, against damping") {
        free.line = line;
        free.velocity = 0.9 * line;
        free.through = w.bodies[2].course.start.origin;
        free.rows = {{0, 0, 0}, {1000 * w.timeStep, 0.2, 2}, {2500 * w.timeStep, 0.1, 3}};
        free.damping = 0.05;
    }
    SECTION("from a time on") {
        w.bodies[2].course.schedule.intervals = {{33.5 * w.timeStep, geometry::kEndless}};
    }
    Particles p;
    p.add({-1e-3, 9.2e-3, 0.4e-3}, single(1.25e-3));
    p.add({2e-3, 9.0e-3, 0.9e-3}, single(1.2e-3));
    auto device = gpu();
    auto reference = makeReferenceBackend();
    device->load(w, p);
    reference->load(w, p);
    bool met = false;
    for (int call = 0; call < 30; ++call) {
        const Sensors a = device->advance(100, 0), b = reference->advance(100, 0);
        met = met || b.maxOverlapRatio > 1e-3;
        const double scale = std::max(1e-2, glm::length(b.bodies[2].force));
        CHECK(near(a.bodies[2].force, b.bodies[2].force, scale, 2e-3));
        CHECK(near(a.bodies[2].torque, b.bodies[2].torque, scale * 5e-3, 2e-3));  // about the centre of the ball
        const FreeBody one = device->freeBodies().at(2), other = reference->freeBodies().at(2);
        CHECK(near(one.shift, other.shift, 1.25e-3, 1e-4));  // a ten-thousandth of a sphere's radius
        CHECK(near(one.velocity, other.velocity, 1, 1e-5));
    }
    CHECK(met);
    CHECK(differences(*device, *reference, 1).position < 1e-4);
    requireClean(*device);
}

TEST_CASE("free bodies: on the device one comes to its stops and stays there") {
    RuledWorld w = dropWorld();
    const Vec3 line = glm::normalize(Vec3(0.05, -1, 0.02));
    w.bodies[2].course.motion = geometry::Free{kMass, Vec3(0), line, w.bodies[2].course.start.origin, {{0, 0.3, 0}}};
    auto& free = std::get<geometry::Free>(w.bodies[2].course.motion);
    free.high = 0.7e-3;
    Particles p;
    p.add({-1e-3, 2e-3, 0.4e-3}, single(1.25e-3));
    auto device = gpu();
    auto reference = makeReferenceBackend();
    for (Backend* b : {device.get(), reference.get()}) {
        b->load(w, p);
        b->advance(std::uint32_t(10e-3 / w.timeStep), 0);
        CHECK(near(b->freeBodies().at(2).shift, 0.7e-3 * line, 1, 1e-7));
        CHECK(b->freeBodies().at(2).velocity == Vec3(0));
        b->setGravity({0, 200, 0});  // it lifts the ball off against its force
        b->advance(std::uint32_t(1e-3 / w.timeStep), 0);
    }
    CHECK(glm::dot(reference->freeBodies().at(2).shift, line) < 0.69e-3);
    CHECK(near(device->freeBodies().at(2).shift, reference->freeBodies().at(2).shift, 1e-3, 1e-4));
    requireClean(*device);
}

TEST_CASE("free bodies: a ball that nothing else moves beside makes the contact lists anew as it comes near") {
    RuledWorld w = dropWorld();
    w.bodies.erase(w.bodies.begin(), w.bodies.begin() + 2);
    w.gravity = Vec3(0);
    auto& ball = w.bodies[0];
    ball.course.start.origin = Vec3(0, 20e-3, 0);
    std::get<geometry::Free>(ball.course.motion).velocity = Vec3(0, -3, 0);
    Particles p;
    p.add({0.3e-3, 0, -0.2e-3}, single(1.25e-3));
    auto device = gpu();
    auto reference = makeReferenceBackend();
    for (Backend* b : {device.get(), reference.get()}) {
        b->load(w, p);
        b->advance(std::uint32_t(6e-3 / w.timeStep), 0);  // it goes 18 mm; 13.75 mm are free
    }
    CHECK(reference->freeBodies().at(0).velocity.y > -2.995);
    CHECK(near(device->freeBodies().at(0).velocity, reference->freeBodies().at(0).velocity, 3, 1e-4));
    CHECK(differences(*device, *reference, 3).position < 1e-2);
    requireClean(*device);
}

TEST_CASE("free bodies: on the device free fall is good to a millionth of the way") {
    RuledWorld w = dropWorld();
    w.bodies.erase(w.bodies.begin() + 1);
    w.domain.low.y = -1;
    Particles p;
    p.add({0, 0.05, 0}, single(1.25e-3));
    auto device = gpu();
    device->load(w, p);
    const std::uint32_t steps = 20'000;
    device->advance(steps, 0);
    const double t = steps * w.timeStep;
    const Vec3 thrown = std::get<geometry::Free>(w.bodies[1].course.motion).velocity;
    const Vec3 fallen = t * thrown + 0.5 * t * t * w.gravity;
    CHECK(near(device->freeBodies().at(1).shift, fallen, glm::length(fallen), 1e-6));
    requireClean(*device);
}

TEST_CASE("free bodies: a ball that falls into a bed changes no bit by batches, a restart or other canisters") {
    checkSameBitsOverBed(dropWorld(),
                         [](const FreeBody& ball) { return glm::length(ball.velocity - Vec3(0.05, -1, 0.02)) > 0.1; });
}

TEST_CASE("free bodies: a ball goes on as it is when larger tables are made for a canister that comes") {
    const RuledWorld w = dropWorld();
    RuledWorld more = w;
    more.bodies.push_back(bodyOf("ring", {geometry::Cone{Vec3(0, 45e-3, 0), Vec3(0, 1, 0), 8e-3, 8e-3, 3e-3}}));
    VulkanOptions options;
    options.device = testDevice();
    VulkanEnsemble ensemble(options);
    const auto stays = ensemble.enter();
    auto visitor = ensemble.enter();
    std::thread beside([&] {
        for (const RuledWorld& world : {w, more}) {
            visitor->load(world, tubeBed());
            visitor->advance(801, 0);
            visitor = ensemble.enter();  // before the former one leaves, so that the other waits
        }
        visitor.reset();
    });
    stays->load(w, tubeBed());
    stays->advance(2501, 0);
    beside.join();
    const auto alone = gpu();
    alone->load(w, tubeBed());
    alone->advance(2501, 0);
    CHECK(sameBody(*stays, *alone));
    CHECK(sameBits(stays->particles(), alone->particles()));
    requireClean(*stays);
}

TEST_CASE("free bodies: the bed takes from the ball what the ledger says, on the device as in the reference") {
    RuledWorld w = dropWorld();
    w.energyBook = true;
    const auto ballAt = [&](const Backend& b) {
        const FreeBody f = b.freeBodies().at(2);
        return kMass * (0.5 * glm::dot(f.velocity, f.velocity) - glm::dot(w.gravity, f.shift));
    };
    for (const bool onDevice : {false, true}) {
        CAPTURE(onDevice);
        const auto backend = onDevice ? gpu() : makeReferenceBackend();
        backend->load(w, tubeBed());
        EnergyLedger ledger;
        for (int call = 0; call < 8; ++call) ledger.add(*backend->advance(499, 0).energy);
        const double had = 0.5 * kMass * (0.05 * 0.05 + 1 + 0.02 * 0.02), lost = had - ballAt(*backend);
        CHECK(lost > 0.1 * had);
        // The velocity of half a step before is at hand.
        CHECK(near(ledger.sum.bodyWork, lost, had, 1e-3));
        CHECK(near(ledger.residual(), 0, had, 1e-4));
        if (onDevice) requireClean(*backend);
    }
}

TEST_CASE("free bodies: on the device the momentum of ball and spheres stays") {
    RuledWorld w = dropWorld();
    w.bodies.erase(w.bodies.begin(), w.bodies.begin() + 2);
    w.gravity = Vec3(0);
    w.domain = {Vec3(-0.1), Vec3(0.1)};
    const Particles p = tubeBed();
    auto device = gpu();
    device->load(w, p);
    const auto momentum = [&] {
        const Particles now = device->particles();
        Vec3 sum = kMass * device->freeBodies().at(0).velocity;
        for (std::size_t i = 0; i < now.size(); ++i) sum += massOf(w, now, i) * now.velocity[i];
        return sum;
    };
    const Vec3 first = momentum();
    device->advance(3000, 0);
    CHECK(glm::length(device->freeBodies().at(0).velocity - Vec3(0.05, -1, 0.02)) > 0.05);
    CHECK(near(momentum(), first, glm::length(first), 1e-5));
    requireClean(*device);
}

TEST_CASE("free bodies: a device that cannot add up a force says so") {
    RuledWorld w = dropWorld();
    w.maxOverlapRatio = 1;
    std::get<geometry::Free>(w.bodies[2].course.motion).mass = 1e-12;
    Particles p;
    p.add({0.2e-3, 17.1e-3 - 6.1e-3, -0.3e-3}, single(1.25e-3));
    auto device = gpu();
    device->load(w, p);
    CHECK_THROWS_WITH(device->advance(10, 0), Catch::Contains("pushes a body that moves freely"));
}
