// The reference backend as a whole: conservation, history, status, errors and sensors.

#include "host/backend/reference/reference.h"

#include <random>

#include "host/core/error.h"
#include "tests/law/setups.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;
using Catch::Contains;

namespace {

/// A cluster in free space that collapses on itself: a jittered cube moving inwards, with random motion and spin.
Particles cluster(int side, double speed, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto vector = [&](double size) {
        const double x = unit(random), y = unit(random), z = unit(random);
        return size * Vec3(x, y, z);
    };
    Particles particles;
    for (int x = 0; x < side; ++x)
        for (int y = 0; y < side; ++y)
            for (int z = 0; z < side; ++z) {
                const Vec3 place = Vec3(x, y, z) - 0.5 * (side - 1);
                const Vec3 position = 2.06 * kRadius * place + vector(0.01 * kRadius);
                const double radius = kRadius * (1 + 0.02 * unit(random));
                particles.add(position, radius, vector(0.3 * speed) - speed * place, vector(speed / kRadius));
            }
    return particles;
}

struct Motion {
    Vec3 momentum{0}, angular{0};
    double momentumScale = 0, angularScale = 0;
};

Motion motionOf(const Particles& p) {
    Motion sum;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double m = massOf(p.radius[i]), inertia = 0.4 * m * p.radius[i] * p.radius[i];
        sum.momentum += m * p.velocity[i];
        sum.angular += m * glm::cross(p.position[i], p.velocity[i]) + inertia * p.spin[i];
        sum.momentumScale += m * glm::length(p.velocity[i]);
        sum.angularScale += m * glm::length(p.position[i]) * glm::length(p.velocity[i]);
    }
    return sum;
}

ContactParameters everything() {
    ContactParameters p = paperParameters(0.3);
    p.kTo = 1000;
    p.gammaTo = 0.01;
    p.muTo = 0.1;
    return p;
}

std::string errorOf(Backend& backend, std::uint32_t steps) {
    try {
        backend.advance(steps, 0);
    } catch (const RunError& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE("reference: an isolated cluster keeps its momentum and angular momentum") {
    const Particles start = cluster(3, 0.2, 17);
    auto backend = makeReferenceBackend();
    backend->load(freeWorld(everything(), 1e-6), start);
    backend->advance(1, 0);
    const Motion before = motionOf(backend->particles());
    std::size_t most = 0;
    for (int n = 0; n < 50; ++n) {
        backend->advance(100, 0);
        most = std::max(most, backend->contacts().size());
    }
    const Motion after = motionOf(backend->particles());
    REQUIRE(most > 20);
    // Both are conserved by every step apart from rounding: 5000 steps of 1e-16 each.
    CHECK(near(after.momentum, before.momentum, before.momentumScale, 1e-12));
    CHECK(near(after.angular, before.angular, before.angularScale, 1e-12));
    // And something did happen: the collisions cost most of the energy.
    double energyBefore = 0, energyAfter = 0;
    for (std::size_t i = 0; i < start.size(); ++i) {
        energyBefore += glm::dot(start.velocity[i], start.velocity[i]);
        energyAfter += glm::dot(backend->particles().velocity[i], backend->particles().velocity[i]);
    }
    CHECK(energyAfter < 0.5 * energyBefore);
}

TEST_CASE("reference: the neighbour list's skin changes nothing but the number of builds") {
    const Particles start = cluster(3, 0.2, 23);
    std::vector<Particles> ends;
    std::vector<std::uint64_t> builds;
    for (const double skin : {0.0, 0.05e-3, 1e-3}) {
        RuledWorld world = freeWorld(everything(), 1e-6);
        world.skin = skin;
        auto backend = makeReferenceBackend();
        backend->load(world, start);
        builds.push_back(backend->advance(2000, 0).rebuilds);
        ends.push_back(backend->particles());
    }
    CHECK(builds[0] == 2000);
    CHECK(builds[1] > 5);
    CHECK(builds[1] < 200);
    CHECK(builds[2] < builds[1]);
    for (std::size_t i = 0; i < start.size(); ++i) {  // to the last bit: the same sums in the same order
        CHECK(ends[0].position[i] == ends[1].position[i]);
        CHECK(ends[0].position[i] == ends[2].position[i]);
        CHECK(ends[0].spin[i] == ends[2].spin[i]);
    }
}

TEST_CASE("reference: many steps in one call are the same as one step in many calls") {
    const Particles start = cluster(3, 0.2, 29);
    auto one = makeReferenceBackend(), many = makeReferenceBackend();
    one->load(freeWorld(everything(), 1e-6), start);
    many->load(freeWorld(everything(), 1e-6), start);
    one->advance(300, 0);
    for (int n = 0; n < 300; ++n) many->advance(1, 0);
    for (std::size_t i = 0; i < start.size(); ++i) CHECK(one->particles().position[i] == many->particles().position[i]);
}

TEST_CASE("reference: the switch of the law keeps every history and state") {
    RuledWorld world = freeWorld(everything(), 1e-6);
    auto backend = makeReferenceBackend();
    backend->load(world, cluster(3, 0.2, 31));
    backend->advance(600, 0);
    const Particles state = backend->particles();
    const std::vector<Contact> before = backend->contacts();
    ContactLaw law = world.law;
    for (ContactParameters& p : law.pairs) p.kc = 0.873 * p.k2Max;
    backend->setLaw(law);

    const std::vector<Contact> after = backend->contacts();
    REQUIRE(after.size() == before.size());
    REQUIRE(before.size() > 10);
    for (std::size_t c = 0; c < before.size(); ++c) {
        CHECK(after[c].maxOverlap == before[c].maxOverlap);
        CHECK(after[c].sliding == before[c].sliding);
    }
    CHECK(backend->particles().position[5] == state.position[5]);

    // In the next step histories go on from there: a fresh contact would start with delta_max = delta and xi = 0.
    backend->advance(1, 0);
    int grown = 0;
    for (const Contact& now : backend->contacts())
        for (const Contact& was : before)
            if (was.particle == now.particle && was.other == now.other) {
                const Particles p = backend->particles();
                const double reach = p.radius[now.particle] + p.radius[now.other];
                const double overlap = reach - glm::length(p.position[now.particle] - p.position[now.other]);
                if (now.maxOverlap > 1.05 * overlap && now.maxOverlap == was.maxOverlap) ++grown;
            }
    CHECK(grown > 3);
}

TEST_CASE("reference: a contact that parts and comes back is a new contact") {
    // Straight up and down on a plane under gravity, bouncing.
    RuledWorld world = planeWorld(paperParameters(0, 0.5, 0.5), 1e-6);
    world.gravity = Vec3(0, -kGravity, 0);
    Particles one;
    one.add(Vec3(0, kRadius * (1 - 1e-12), 0), kRadius, Vec3(0.02, -0.3, 0));
    Stepper run(world, one);
    run.step();
    while (run.touching()) run.step();
    const double rebound = run.now().velocity[0].y;
    REQUIRE(rebound > 0.05);
    CHECK(run.backend().contacts().empty());
    while (!run.touching()) run.step();
    const std::vector<Contact> contacts = run.backend().contacts();
    REQUIRE(contacts.size() == 1);
    CHECK(contacts[0].kind == ContactClass::ParticleWall);
    CHECK(contacts[0].maxOverlap == kRadius - run.full().position[0].y);
    CHECK(glm::length(contacts[0].sliding) <= 0.1 * world.timeStep);  // one step's advance at most
    CHECK(glm::length(contacts[0].sliding) > 0);
}

TEST_CASE("reference: the first step is half a kick and leaves the springs at rest") {
    RuledWorld world = planeWorld(paperParameters(0, 0.5, 0.5), 1e-6);
    world.gravity = Vec3(0, -kGravity, 0);
    Particles one;
    one.add(Vec3(0, 1, 0), kRadius, Vec3(0));
    Stepper falling(world, one);
    falling.step();
    CHECK(near(falling.now().velocity[0].y, -kGravity * 0.5e-6, kGravity * 1e-6, 1e-12));
    falling.step();
    CHECK(near(falling.now().velocity[0].y, -kGravity * 1.5e-6, kGravity * 1e-6, 1e-12));

    for (ContactParameters& p : world.law.pairs) p.gammaT = 0;  // far from slipping
    one.position[0].y = kRadius - 1e-6;
    one.velocity[0].x = 0.1;
    Stepper touching(world, one);
    touching.step();
    CHECK(touching.backend().contacts().at(0).sliding == Vec3(0));
    touching.step();
    CHECK(near(touching.backend().contacts().at(0).sliding.x, 1e-7, 1e-7, 0.01));
}

TEST_CASE("reference: a particle past the outlet is dosed, frozen and stays in the ledger") {
    RuledWorld world = freeWorld(paperParameters(), 1e-4);
    world.throatZ = 10e-3;
    world.outletZ = 20e-3;
    Particles three;
    three.add(Vec3(0, 0, 5e-3), kRadius, Vec3(0, 0, 0));
    three.add(Vec3(0, 0, 12e-3), 2 * kRadius, Vec3(0, 0, 0.1));
    three.add(Vec3(0, 0, 30e-3), kRadius, Vec3(0, 0, 0.1));
    three.status[2] = Status::Dosed;
    auto backend = makeReferenceBackend();
    backend->load(world, three);
    const double m = massOf(kRadius);

    Sensors now = backend->advance(0, 0);
    CHECK(now.count == std::array<std::uint64_t, 4>{1, 1, 1, 0});
    CHECK(nearRelative(now.mass[1], 8 * m, 1e-12));
    CHECK(nearRelative(now.throatMomentumZ, 8 * m * 0.1, 1e-12));
    CHECK(nearRelative(now.kineticEnergy, 0.5 * 8 * m * 0.01, 1e-12));
    CHECK(now.coilTorque == 0);

    now = backend->advance(900, 0);  // 9 mm: past 20 mm
    CHECK(now.count == std::array<std::uint64_t, 4>{1, 0, 2, 0});
    CHECK(nearRelative(now.mass[2], 9 * m, 1e-12));
    CHECK(now.kineticEnergy == 0);
    const Particles end = backend->particles();
    CHECK(end.status[1] == Status::Dosed);
    CHECK(end.position[1].z > 20e-3);
    CHECK(end.position[1].z < 20.1e-3);
    CHECK(end.position[2] == three.position[2]);
}

TEST_CASE("reference: a particle that leaves the domain is an error that names it") {
    RuledWorld world = freeWorld(paperParameters(), 1e-3);
    world.domain = {Vec3(-10e-3), Vec3(9.5e-3)};
    Particles two;
    two.add(Vec3(0), kRadius);
    two.add(Vec3(5e-3, 0, 0), kRadius, Vec3(1, 0, 0));
    auto backend = makeReferenceBackend();
    backend->load(world, two);
    const std::string message = errorOf(*backend, 10);
    CHECK_THAT(message, Contains("particle 1 left the domain") && Contains("step 5 (t = 0.005 s)") &&
                            Contains("(0.01, 0, 0)") && Contains("domain.high"));
    CHECK(backend->particles().status[1] == Status::Lost);
    CHECK(backend->advance(0, 0).count[3] == 1);
}

TEST_CASE("reference: a velocity that is not finite is an error that names the particle") {
    auto backend = makeReferenceBackend();
    Particles two;
    two.add(Vec3(0), kRadius);
    two.add(Vec3(5e-3, 0, 0), kRadius, Vec3(0, std::nan(""), 0));
    backend->load(freeWorld(paperParameters(), 1e-6), two);
    CHECK_THAT(errorOf(*backend, 10), Contains("particle 1 is no longer finite") && Contains("step 1"));
    CHECK(backend->particles().status[1] == Status::Lost);
}

TEST_CASE("reference: an overlap beyond a fifth of the radius is an error that names the pair") {
    Particles two;
    two.add(Vec3(0), kRadius);
    two.add(Vec3(3e-3, 0, 0), kRadius);
    two.add(Vec3(3e-3 + 1.79 * kRadius, 0, 0), kRadius);
    auto backend = makeReferenceBackend();
    backend->load(freeWorld(paperParameters(), 1e-6), two);
    CHECK_THAT(errorOf(*backend, 1), Contains("particles 1 and 2 overlap by 21.0 %") && Contains("time step"));

    Particles one;
    one.add(Vec3(0, 0.79 * kRadius, 0), kRadius);
    backend->load(planeWorld(paperParameters(), 1e-6), one);
    CHECK_THAT(errorOf(*backend, 1), Contains("particle 0 and wall 0"));

    one.position[0].y = 0.81 * kRadius;
    backend->load(planeWorld(paperParameters(), 1e-6), one);
    CHECK(near(backend->advance(1, 0).maxOverlapRatio, 0.19, 1, 1e-9));
}

TEST_CASE("reference: load starts over") {
    auto backend = makeReferenceBackend();
    const RuledWorld world = freeWorld(everything(), 1e-6);
    const Particles start = cluster(2, 0.2, 5);
    backend->load(world, start);
    backend->advance(500, 3.0);
    const Particles first = backend->particles();
    CHECK(nearRelative(backend->coilAngle(), 3.0 * 500e-6, 1e-12));
    backend->load(world, start);
    CHECK(backend->coilAngle() == 0);
    CHECK(backend->contacts().empty());
    CHECK(backend->advance(500, 0).rebuilds >= 1);
    CHECK(backend->particles().position[3] == first.position[3]);
}
