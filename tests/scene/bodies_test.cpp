// Bodies on the device: the same motion as in the reference, the same bits after a restart, in other batches and beside
// other canisters, and the loads.

#include <cmath>
#include <thread>

#include "tests/scene/body_beds.h"
#include "tests/support/catch.h"
#include "tests/support/records.h"

using namespace vkdose;
using namespace vkdose::test;

TEST_CASE("bodies: one sphere meets each, on the device as in the reference", "[every-driver]") {
    const RuledWorld w = deviceWorld();
    struct Throw {
        const char* at;
        Vec3 from, velocity;
    };
    for (const Throw& t : {Throw{"drum", {-12e-3, -13.9e-3, 5e-3}, {-0.2, -0.4, 0.02}},
                           Throw{"drum's corner", {-17.3e-3, -5e-3, 1.3e-3}, {-0.5, -0.05, -0.3}},
                           Throw{"block", {6e-3, -8.2e-3, 5e-3}, {0.01, -0.4, 0.03}},
                           Throw{"stirrer", {-14e-3, 4.4e-3, 5.2e-3}, {0.05, -0.4, 0}}}) {
        CAPTURE(t.at);
        Particles p;
        p.add(t.from, single(1.25e-3), t.velocity, Vec3(40, -30, 60));
        auto device = gpu();
        auto reference = makeReferenceBackend();
        device->load(w, p);
        reference->load(w, p);
        bool met = false;
        for (int call = 0; call < 12; ++call) {
            const Sensors a = device->advance(100, kDrive), b = reference->advance(100, kDrive);
            met = met || b.maxOverlapRatio > 1e-4;
            REQUIRE(a.bodies.size() == 3);
            for (std::size_t k = 0; k < 3; ++k) {
                const double scale = std::max(1e-3, glm::length(b.bodies[k].force));
                CHECK(near(a.bodies[k].force, b.bodies[k].force, scale, 2e-3));
                CHECK(near(a.bodies[k].torque, b.bodies[k].torque, scale * 0.02, 2e-3));
                CHECK(near(a.bodies[k].work, b.bodies[k].work, scale * 1e-4, 2e-3));
            }
        }
        CHECK(met);
        const Differences d = differences(*device, *reference, 0.5);
        CHECK(d.unmatched == 0);
        CHECK(d.position < 1e-4);
        CHECK(d.velocity < 1e-3);
        CHECK(d.spin < 1e-3);
        requireClean(*device);
    }
}

TEST_CASE("bodies: a screw that turns moves spheres on the device as in the reference") {
    RuledWorld w = emptyWorld();
    w.domain = {Vec3(-0.03, -0.03, -0.01), Vec3(0.03, 0.03, 0.04)};
    const Vec3 z(0, 0, 1);
    const geometry::Flight flight{3e-3, 9e-3, 1e-3, 8e-3, 10e-3, 6 * kPi, 0, 0.3, 1};
    const double length = flight.height(flight.angle);
    w.bodies.push_back(
        bodyOf("screw", {flight, geometry::Cone{Vec3(0), z, 3e-3, 3e-3, length}}, geometry::Turn{z, Vec3(0), -150}));
    w.bodies.push_back(bodyOf("tube", {geometry::Tube{Vec3(0, 0, -0.02), z, 10e-3, 0.08, true}}));
    Particles p;
    for (double height = 2e-3; p.size() < 6; height += 0.1e-3) {  // where they are clear of the blade
        const auto i = int(p.size());
        const Vec3 at(0.4e-3 * i - 1e-3, -7e-3, height);
        const bool apart = i == 0 || at.z - p.position.back().z > 2.6e-3;
        if (apart && geometry::touched(w.bodies[0].shapes, at, 1.3e-3).empty())
            p.add(at, single(1.25e-3), Vec3(0.05 * i, -0.1, -0.1), Vec3(3, i, -2));
    }
    auto device = gpu();
    auto reference = makeReferenceBackend();
    device->load(w, p);
    reference->load(w, p);
    double work = 0, error = 0, torque = 0;
    for (int call = 0; call < 20; ++call) {
        const Sensors a = device->advance(100, 0), b = reference->advance(100, 0);
        work = std::max(work, std::abs(b.bodies.at(0).work));
        error = std::max(error, std::abs(a.bodies.at(0).work - b.bodies.at(0).work));
        torque = std::max(torque, std::abs(a.bodies.at(0).torque - b.bodies.at(0).torque) /
                                      (9e-3 * std::max(1e-3, glm::length(b.bodies.at(0).force))));
    }
    CHECK(work > 1e-8);
    CHECK(error < 2e-3 * work);
    CHECK(torque < 2e-3);
    const Differences d = differences(*device, *reference, 0.5);
    CHECK(d.unmatched == 0);
    CHECK(d.position < 1e-3);
    CHECK(d.velocity < 1e-2);
    requireClean(*device);
}

TEST_CASE("bodies: the torque on a body that moves is about its axis where that is in each step") {
    const Vec3 z(0, 0, 1);
    RuledWorld w = emptyWorld();
    w.domain = {Vec3(-0.03), Vec3(0.03)};
    geometry::Motion motion;
    SECTION("it slides") {
        motion = geometry::Slide{Vec3(1.5, 0, 0)};
    }
    SECTION("it shakes") {
        motion = geometry::Shake{Vec3(1, 0, 0), 2e-3, 120, 0};
    }
    SECTION("it follows a table, turned about a line that stays") {
        motion = geometry::Table{z, Vec3(-4e-3, 1e-3, 0), {{0, 0, Vec3(0)}, {0.01, 1.5, Vec3(15e-3, 0, 0)}}};
    }
    w.bodies.push_back(bodyOf("pusher", {geometry::Block{Vec3(-2e-3), Vec3(2e-3)}}, motion));
    w.bodies[0].course.start.origin = Vec3(-10e-3, 0, 0);
    Particles p;
    p.add({-6.9e-3, 1.1e-3, 0.2e-3}, single(1.05e-3));
    auto device = gpu();
    auto reference = makeReferenceBackend();
    const auto steps = std::uint32_t(2e-3 / w.timeStep);  // the body goes up to 3 mm
    device->load(w, p);
    reference->load(w, p);
    const BodyLoad a = device->advance(steps, 0).bodies.at(0), b = reference->advance(steps, 0).bodies.at(0);
    const double lever = 1e-3, force = glm::length(b.force);  // where the sphere lies above the block's middle
    CHECK(force > 1e-4);
    CHECK(near(a.force, b.force, force, 2e-3));
    CHECK(near(a.torque, b.torque, force * lever, 5e-3));
    requireClean(*device);
}

TEST_CASE("bodies: a heap in a turning drum stays close to the reference") {
    const RuledWorld w = deviceWorld();
    const Particles p = layers(60);
    auto device = gpu();
    auto reference = makeReferenceBackend();
    device->load(w, p);
    reference->load(w, p);
    const Sensors a = device->advance(3000, kDrive), b = reference->advance(3000, kDrive);
    CHECK(b.maxOverlapRatio > 1e-3);
    CHECK(near(a.kineticEnergy, b.kineticEnergy, b.kineticEnergy, 1e-2));
    CHECK(differences(*device, *reference, 0.5).position < 0.05);
    for (std::size_t k = 0; k < 3; ++k) CHECK(near(a.bodies[k].work, b.bodies[k].work, b.kineticEnergy, 1e-2));
    CHECK(std::abs(b.bodies[1].work) > 1e-3 * b.kineticEnergy);
    requireClean(*device);
}

TEST_CASE("bodies: a restart, other batches and other canisters change no bit") {
    const RuledWorld w = deviceWorld();
    const Particles p = layers(60);
    VulkanOptions small;
    small.batch = 7;
    const auto whole = gpu(), other = gpu(small), second = gpu();
    for (Backend* b : {whole.get(), other.get(), second.get()}) b->load(w, p);
    const Sensors one = whole->advance(2501, kDrive), same = other->advance(2501, kDrive);
    CHECK(sameBits(whole->particles(), other->particles()));
    CHECK(one.bodies.at(0).torque == same.bodies.at(0).torque);

    const Record taken = whole->snapshot();
    second->restore(taken);
    checkSameArrays(taken, second->snapshot());
    for (int call = 0; call < 2; ++call) {
        whole->advance(701, kDrive);
        second->advance(701, kDrive);
        CHECK(sameBits(whole->particles(), second->particles()));
        CHECK(sameBits(whole->contacts(), second->contacts()));
    }
    bool onBody = false;
    for (const Contact& c : whole->contacts()) onBody = onBody || c.kind == ContactClass::ParticleCoil;
    CHECK(onBody);

    // Beside a canister with fewer bodies and other particles.
    auto members = gpuEnsemble(2);
    RuledWorld fewer = w;
    fewer.bodies.pop_back();
    fewer.bodies[0].shapes.emplace_back(geometry::Ball{Vec3(0, 15e-3, 5e-3), 1e-3});
    std::thread first([&] {
        members[0]->load(fewer, layers(33));
        members[0]->advance(2501, 0);
        members[0].reset();  // nobody waits for it any more
    });
    members[1]->load(w, p);
    members[1]->advance(2501, kDrive);
    const Particles together = members[1]->particles();
    requireClean(*members[1]);
    first.join();
    whole->load(w, p);
    whole->advance(2501, kDrive);
    CHECK(sameBits(together, whole->particles()));
    requireClean(*whole);
}

TEST_CASE("bodies: canisters that come and go beside one change no bit of it, nor it of theirs") {
    const RuledWorld w = deviceWorld();
    RuledWorld fewer = w, more = w;
    fewer.bodies.pop_back();
    // More triangles than the tables were made for, another kind of shape, and a body that moves freely.
    more.bodies.push_back(
        bodyOf("block", {meshOf(geometry::Block{Vec3(-2e-3, 8e-3, 2e-3), Vec3(2e-3, 12e-3, 6e-3)}, 4e-4)}));
    more.bodies.push_back(bodyOf("ball", {geometry::Ball{Vec3(0, 14e-3, 5e-3), 3e-3}},
                                 geometry::Free{4e-3, Vec3(0, -1, 0), {}}, Clock::Forces));
    struct Visit {
        const RuledWorld& world;
        Particles particles;
        std::uint32_t steps;
    };
    const std::vector<Visit> visits{
        {fewer, layers(33), 301}, {more, layers(33), 403}, {fewer, layers(41), 205}, {w, layers(60), 307}};

    VulkanOptions options;
    options.device = testDevice();
    VulkanEnsemble ensemble(options);
    const auto stays = ensemble.enter();
    auto visitor = ensemble.enter();
    std::vector<Particles> seen;
    std::thread beside([&] {
        for (const Visit& v : visits) {
            visitor->load(v.world, v.particles);
            visitor->advance(v.steps, kDrive);
            seen.push_back(visitor->particles());
            visitor = ensemble.enter();  // before the former one leaves, so that the other waits
        }
        visitor.reset();
    });
    stays->load(w, layers(60));
    const Sensors one = stays->advance(3001, kDrive);  // all visits fall into this call
    beside.join();
    const auto alone = gpu();
    alone->load(w, layers(60));
    const Sensors same = alone->advance(3001, kDrive);
    CHECK(sameBits(stays->particles(), alone->particles()));
    REQUIRE(one.bodies.size() == same.bodies.size());
    for (std::size_t b = 0; b < one.bodies.size(); ++b) {
        CHECK(one.bodies[b].torque == same.bodies[b].torque);
        CHECK(one.bodies[b].force == same.bodies[b].force);
        CHECK(one.bodies[b].work == same.bodies[b].work);
    }
    CHECK(one.bodies[1].work != 0);  // spheres lie on the block
    for (std::size_t k = 0; k < visits.size(); ++k) {
        INFO("visit " << k);
        alone->load(visits[k].world, visits[k].particles);
        alone->advance(visits[k].steps, kDrive);
        CHECK(sameBits(seen.at(k), alone->particles()));
    }
    requireClean(*stays);
    requireClean(*alone);
}

TEST_CASE("bodies: a mesh of a hundred thousand triangles steps on the device as in the reference, and as its rod") {
    const double radius = 20e-3;
    const geometry::Cone rod{Vec3(0, 0, -20e-3), Vec3(0, 0, 1), radius, radius, 40e-3};
    const auto mesh = meshOf(rod, 0.3e-3);
    REQUIRE(mesh->mesh().triangles.size() > 100'000);
    RuledWorld exact = emptyWorld();
    exact.domain = {Vec3(-0.03), Vec3(0.03)};
    RuledWorld faceted = exact;
    exact.bodies.push_back(bodyOf("rod", {rod}));
    faceted.bodies.push_back(bodyOf("rod", {mesh}));
    Particles p;
    for (int i = 0; i < 7; ++i) {
        const Vec3 out(std::cos(0.9 * i), std::sin(0.9 * i), 0);
        const double a = single((1.25 - 0.07 * i) * 1e-3);
        p.add((radius + a + 20e-6) * out + Vec3(0, 0, (i - 3) * 2.3e-3), a, -0.3 * out + Vec3(0, 0, 0.1));
    }
    auto device = gpu();
    auto reference = makeReferenceBackend(), ofRod = makeReferenceBackend();
    device->load(faceted, p);
    reference->load(faceted, p);
    ofRod->load(exact, p);
    device->advance(300, 0);
    const Sensors met = reference->advance(300, 0);
    ofRod->advance(300, 0);
    CHECK(met.maxOverlapRatio > 1e-3);
    CHECK(differences(*device, *reference, 0.5).position < 1e-4);
    // A facet is tilted by up to 0.0075, so a sphere leaves it by twice that angle aside: 3 micrometres on its way of
    // 0.2 mm, which are 4 thousandths of the smallest radius.
    CHECK(differences(*reference, *ofRod, 0.5).position < 4e-3);
    requireClean(*device);
}

TEST_CASE("bodies: one that moves leaves the contact lists as they are for long") {
    RuledWorld w = emptyWorld();
    w.timeStep = 2e-6;
    w.skin = 0.4e-3;
    RigidBody drum;
    drum.name = "drum";
    drum.course.motion = geometry::Turn{Vec3(0, 0, 1), Vec3(0), 10};
    SECTION("the coil") {
        w.coil = geometry::Coil{10.4e-3, 8.75e-3, 1e-3, 70e-3};
    }
    SECTION("a drum") {
        drum.shapes = {geometry::Tube{Vec3(0), Vec3(0, 0, 1), 40e-3, 70e-3, true}};
        w.bodies = {drum};
    }
    SECTION("a box, whose corners go far in a step") {
        w.domain = {Vec3(-45e-3, -45e-3, -5e-3), Vec3(45e-3, 45e-3, 75e-3)};
        drum.shapes = {geometry::Block{Vec3(-40e-3, -40e-3, 0), Vec3(40e-3, 40e-3, 70e-3), true}};
        w.bodies = {drum};
    }
    Particles p;
    p.add({0, 0, 35e-3}, 1e-3);  // touches nothing and hardly falls
    auto device = gpu();
    device->load(w, p);
    device->advance(8, 10);
    CHECK(profile(*device, 256, 10).refreshes <= 4);
}
