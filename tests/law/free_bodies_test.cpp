// Bodies that move freely in the reference backend: closed forms, momentum, energy, restart.

#include <algorithm>
#include <cmath>

#include "host/core/record.h"
#include "host/law/hertz.h"
#include "host/model/stability.h"
#include "host/sim/energy_ledger.h"
#include "tests/law/setups.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr double kStep = 2e-6;
const Vec3 kPull(0, 0, -kGravity);

/// A world with one body that moves freely.
RuledWorld worldWith(std::vector<geometry::Shape> shapes, const geometry::Free& free, const Vec3& at,
                     const ContactParameters& p) {
    RuledWorld world = freeWorld(p, kStep);
    world.gravity = kPull;
    world.bodies.push_back({"ball", std::move(shapes), {{{1, 0, 0, 0}, at}, free, {}}, Clock::Forces, kWallMaterial});
    return world;
}

/// A sphere far away from all, which falls.
Particles farAway() {
    Particles p;
    p.add(Vec3(0.5, 0.5, 0), kRadius);
    return p;
}

/// A disc of 12 mm that lies on 13 spheres on a floor, a little above or below touch.
RuledWorld lidWorld(const ContactParameters& p, double mass, double gap) {
    RuledWorld world = worldWith({geometry::Cone{Vec3(0), Vec3(0, 0, 1), 0, 12e-3, 0}}, {mass, Vec3(0), Vec3(0, 0, 1)},
                                 Vec3(0, 0, 2 * kRadius + gap), p);
    world.walls.push_back(geometry::Plane{Vec3(0), Vec3(0, 0, 1)});
    return world;
}

Particles underLid() {
    Particles p;
    for (int i = 0; i < 13; ++i) {
        const double angle = 2.4 * i, out = 2.5e-3 * std::sqrt(double(i));
        p.add(Vec3(out * std::cos(angle), out * std::sin(angle), kRadius), kRadius);
    }
    return p;
}

/// Kinetic and potential energy of the body at the full step between two calls of one step [J].
double energyAt(const FreeBody& before, const FreeBody& after, double mass, const Vec3& gravity) {
    return mass * (0.5 * glm::dot(before.velocity, after.velocity) - glm::dot(gravity, before.shift));
}

}  // namespace

TEST_CASE("free bodies: one that nothing touches is thrown as the closed form says") {
    const Vec3 thrown(0.3, -0.1, 1);
    RuledWorld world = worldWith({geometry::Ball{Vec3(0), 3e-3}}, {0.01, thrown, {}}, Vec3(0), spring(1e3));
    const int steps = 40'000;
    const double t = steps * kStep;
    const auto backend = makeReferenceBackend();
    SECTION("everywhere") {
        backend->load(world, farAway());
        backend->advance(steps, 0);
        const FreeBody ball = backend->freeBodies().at(0);
        CHECK(near(ball.shift, t * thrown + 0.5 * t * t * kPull, t, 1e-12));
        CHECK(near(ball.velocity, thrown + (t - kStep / 2) * kPull, 1, 1e-12));
    }
    SECTION("along its line") {
        const Vec3 line = glm::normalize(Vec3(1, 2, -2));
        world.bodies[0].course.motion = geometry::Free{0.01, 0.5 * line, line};
        backend->load(world, farAway());
        backend->advance(steps, 0);
        const double pull = glm::dot(kPull, line);
        CHECK(near(backend->freeBodies().at(0).shift, (0.5 * t + 0.5 * t * t * pull) * line, t, 1e-12));
    }
    SECTION("from a time on") {
        world.bodies[0].course.schedule.intervals = {{0.02, geometry::kEndless}};
        backend->load(world, farAway());
        backend->advance(9'999, 0);
        CHECK(backend->freeBodies().at(0).shift == Vec3(0));
        CHECK(backend->freeBodies().at(0).velocity == Vec3(0));
        backend->advance(steps - 9'999, 0);
        const double since = t - 0.02;
        CHECK(near(backend->freeBodies().at(0).shift, since * thrown + 0.5 * since * since * kPull, t, 1e-12));
    }
}

TEST_CASE("free bodies: a force drives one along its line, at its times and in its phases") {
    const Vec3 line = glm::normalize(Vec3(1, 2, -2));
    const double mass = 0.01, force = 0.3;
    geometry::Free free{mass, Vec3(0), line, Vec3(0), {{0, force, 0}}};
    RuledWorld world = worldWith({geometry::Ball{Vec3(0), 3e-3}}, free, Vec3(0), spring(1e3));
    world.gravity = Vec3(0);
    const auto backend = makeReferenceBackend();
    const int steps = 10'000;
    const double t = steps * kStep;
    const auto way = [&] { return glm::dot(backend->freeBodies().at(0).shift, line); };
    SECTION("always") {
        backend->load(world, farAway());
        backend->advance(steps, 0);
        CHECK(way() == Approx(0.5 * force / mass * t * t).epsilon(1e-9));
        CHECK(glm::length(glm::cross(backend->freeBodies().at(0).shift, line)) < 1e-12);
    }
    SECTION("a force that grows from nothing") {
        free.rows = {{0, 0, 0}, {t, force, 0}};
        world.bodies[0].course.motion = free;
        backend->load(world, farAway());
        backend->advance(steps, 0);
        CHECK(way() == Approx(force / mass * t * t / 6).epsilon(1e-4));
    }
    SECTION("in its phases: what is free goes on without the force") {
        world.bodies[0].phases = {Phase::Rotate};
        backend->load(world, farAway());
        backend->setClocks({BodyClock{0, true, BodyClock::kNever}});
        backend->advance(steps, 0);
        backend->setClocks({BodyClock{std::uint64_t(steps), false, BodyClock::kNever}});
        backend->advance(steps, 0);
        const double speed = force / mass * (t - kStep / 2);
        CHECK(glm::dot(backend->freeBodies().at(0).velocity, line) == Approx(speed).epsilon(1e-9));
        CHECK(way() == Approx(0.5 * force / mass * t * t + speed * t).epsilon(1e-4));
    }
    SECTION("to its stop, and back") {
        free.rows = {{0, force, 0}, {t, force, 0}, {1.0001 * t, -force, 0}};
        free.high = 1e-4;
        free.low = -2e-4;
        world.bodies[0].course.motion = free;
        backend->load(world, farAway());
        backend->advance(steps, 0);
        CHECK(way() == Approx(1e-4).margin(1e-12));
        CHECK(backend->freeBodies().at(0).velocity == Vec3(0));
        backend->advance(steps, 0);
        CHECK(way() == Approx(-2e-4).margin(1e-12));
    }
    SECTION("against damping") {
        free.damping = 5;
        world.bodies[0].course.motion = free;
        backend->load(world, farAway());
        backend->advance(steps, 0);
        const double fade = std::exp(-free.damping * (t - kStep / 2) / mass);
        CHECK(glm::dot(backend->freeBodies().at(0).velocity, line) ==
              Approx(force / free.damping * (1 - fade)).epsilon(1e-6));
    }
    SECTION("damping that a time step cannot resolve stops it, and does not throw it about") {
        free.damping = 100 * mass / kStep;
        free.rows = {};
        free.velocity = line;
        world.bodies[0].course.motion = free;
        backend->load(world, farAway());
        double before = 1;
        for (int call = 0; call < 20; ++call) {
            backend->advance(1, 0);
            const double now = std::abs(glm::dot(backend->freeBodies().at(0).velocity, line));
            CHECK(now < before);
            before = now;
        }
    }
}

TEST_CASE("free bodies: a lid that turns as its table says carries round what it presses") {
    ContactParameters p = spring(1e3);
    p.gamma = 0.1;
    p.mu = 0.5;
    p.kt = 3e2;
    p.gammaT = 0.05;
    const double force = 2e-3, rate = 20;
    RuledWorld world = lidWorld(p, 1e-4, 0);
    auto& lid = std::get<geometry::Free>(world.bodies[0].course.motion);
    lid.through = world.bodies[0].course.start.origin;
    lid.rows = {{0, -force, 0}, {1, -force, rate}};
    lid.damping = 0.05;
    const auto backend = makeReferenceBackend();
    backend->load(world, underLid());
    backend->advance(20'000, 0);
    const Sensors s = backend->advance(1000, 0);
    const Particles now = backend->particles();
    CHECK(s.bodies[0].force.z == Approx(force + 1e-4 * kGravity).epsilon(0.02));
    CHECK(s.bodies[0].torque < 0);  // about its line, +z: the powder resists
    // Spheres roll between floor and lid at half its speed.
    const Vec3 x = now.position[12], v = now.velocity[12];
    CHECK(glm::dot(v, glm::normalize(glm::cross(Vec3(0, 0, 1), x))) ==
          Approx(rate / 2 * std::hypot(x.x, x.y)).epsilon(0.1));
}

TEST_CASE("free bodies: the automatic step resolves the impact of one that is far lighter than the sphere") {
    const double sphere = massOf(kRadius);
    for (const double share : {0.02, 0.5, 20.0}) {
        CAPTURE(share);
        const double mass = share * sphere;
        RuledWorld world =
            worldWith({geometry::Ball{Vec3(0), 1e-3}}, {mass, Vec3(0, 0, 0.5), {}}, Vec3(0, 0, -1.1e-3), spring(1e4));
        world.gravity = Vec3(0);
        Particles one;
        one.add(Vec3(0, 0, kRadius), kRadius);
        const PowderSizes sizes = powderSizes(world, one);
        world.timeStep = automaticTimeStep(contactModes(world, world.law, sizes), {});
        const auto backend = makeReferenceBackend();
        backend->load(world, one);
        backend->advance(std::uint32_t(2e-3 / world.timeStep), 0);
        REQUIRE(backend->contacts().empty());
        // An elastic impact. Eight steps in a contact leave an error of some 1 %.
        CHECK(near(backend->particles().velocity[0].z, 2 * mass / (mass + sphere) * 0.5, 0.5, 0.02));
        CHECK(near(backend->freeBodies().at(0).velocity.z, (mass - sphere) / (mass + sphere) * 0.5, 0.5, 0.02));
    }
}

TEST_CASE("free bodies: with the automatic step a lid comes to rest on hundreds of spheres that it is lighter than") {
    constexpr double kLid = 25e-3, kApart = 2.02 * kRadius;
    ContactParameters p = spring(1e3);
    p.gamma = 0.2 * std::sqrt(p.k1 * massOf(kRadius));
    RuledWorld world = worldWith({geometry::Cone{Vec3(0), Vec3(0, 0, 1), 0, kLid, 0}}, {1, Vec3(0, 0, -0.02), {}},
                                 Vec3(0, 0, 2 * kRadius + 1e-5), p);
    world.walls.push_back(geometry::Plane{Vec3(0), Vec3(0, 0, 1)});
    Particles layer;
    for (int i = -12; i <= 12; ++i)
        for (int j = -12; j <= 12; ++j) {
            const Vec3 x(kApart * (i + 0.5 * (j & 1)), kApart * std::sqrt(0.75) * j, kRadius);
            if (std::hypot(x.x, x.y) < kLid - kRadius) layer.add(x, kRadius);
        }
    REQUIRE(layer.size() > 250);
    const double mass = double(layer.size()) * massOf(kRadius) / GENERATE(1.0, 100.0);
    CAPTURE(mass);
    std::get<geometry::Free>(world.bodies[0].course.motion).mass = mass;
    world.timeStep = automaticTimeStep(contactModes(world, world.law, powderSizes(world, layer)), {});
    const auto backend = makeReferenceBackend();
    backend->load(world, layer);
    backend->advance(std::uint32_t(0.03 / world.timeStep), 0);
    CHECK(glm::length(backend->freeBodies().at(0).velocity) < 1e-3);
    CHECK(std::abs(backend->freeBodies().at(0).shift.z + 1e-5) < 1e-5);
}

TEST_CASE("free bodies: the automatic step counts the spheres on both sides of each thin part, once") {
    constexpr double kDisc = 25e-3, kMass = 1e-9, kStiffness = 1e3;
    for (const int discs : {1, 4}) {
        std::vector<geometry::Shape> shapes;
        for (int k = 0; k < discs; ++k)
            shapes.emplace_back(geometry::Cone{Vec3(0, 0, 0.1 * k), Vec3(0, 0, 1), 0, kDisc, 0});
        const RuledWorld world = worldWith(shapes, {kMass, Vec3(0), {}}, Vec3(0), spring(kStiffness));
        const auto modes = contactModes(world, world.law, {{kRadius, kRadius, kRadius}});
        const double shortest = std::ranges::min(modes, {}, &ContactMode::duration).duration;
        // Both sides have the surface of a ball of this radius.
        const double around = kDisc * std::sqrt(discs / 2.0) + kRadius;
        const double most = 4 * kPi * around * around / (2 * std::sqrt(3.0) * kRadius * kRadius);
        CHECK(shortest == Approx(kPi * std::sqrt(kMass / most / kStiffness)).epsilon(0.01));
    }
}

TEST_CASE("free bodies: a sphere rebounds from one of any mass with the law's restitution") {
    const Elasticity soft{5e6, 0.25};
    const double sphere = massOf(kRadius), speed = 0.3;
    for (const double share : {0.5, 1.0, 20.0}) {
        CAPTURE(share);
        RuledWorld world = worldWith({geometry::Ball{Vec3(0), 1e-3}}, {share * sphere, Vec3(0, 0, speed), {}},
                                     Vec3(0, 0, -1.1e-3), hertzMindlin(soft, soft, 0.5));
        world.gravity = Vec3(0);
        Particles one;
        one.add(Vec3(0, 0, kRadius), kRadius);
        const auto backend = makeReferenceBackend();
        backend->load(world, one);
        backend->advance(std::uint32_t(3e-3 / world.timeStep), 0);
        REQUIRE(backend->contacts().empty());
        const double apart = backend->particles().velocity[0].z - backend->freeBodies().at(0).velocity.z;
        CHECK(near(apart, 0.5 * speed, speed, 0.01));
    }
}

TEST_CASE("free bodies: a lid that rests on spheres weighs on them, and on the floor with their weight") {
    const double mass = 0.02, weight = mass * kGravity;
    const RuledWorld world = lidWorld(paperParameters(), mass, -2e-6);
    const auto backend = makeReferenceBackend();
    backend->load(world, underLid());
    backend->advance(400'000, 0);
    Vec3 lid(0), floor(0);
    for (const Contact& c : backend->contacts()) {
        if (c.kind != ContactClass::ParticleWall) continue;
        (c.other == 1 ? lid : floor) += c.force;
    }
    double spheres = 0;
    for (const double r : underLid().radius) spheres += massOf(r) * kGravity;
    CHECK(near(-lid.z, weight, weight, 1e-3));
    CHECK(near(floor.z, weight + spheres, weight, 1e-3));
    const Sensors s = backend->advance(1000, 0);
    CHECK(near(s.bodies.at(0).force.z, weight, weight, 1e-3));
    CHECK(std::abs(backend->freeBodies().at(0).velocity.z) < 1e-4);
}

TEST_CASE("free bodies: what the spheres gain in momentum the body loses") {
    RuledWorld world = worldWith({geometry::Ball{Vec3(0), 6e-3}}, {2e-3, Vec3(0.1, 0, -0.5), {}}, Vec3(0, 0, 8e-3),
                                 paperParameters(0.1));
    world.gravity = Vec3(0);
    Particles particles;
    for (int i = 0; i < 9; ++i)
        particles.add(Vec3((i % 3 - 1) * 2.6e-3, (i / 3 - 1) * 2.6e-3, 0), kRadius * (1 - 0.01 * i));
    const auto backend = makeReferenceBackend();
    backend->load(world, particles);
    const auto momentum = [&] {
        const Particles p = backend->particles();
        Vec3 sum = 2e-3 * backend->freeBodies().at(0).velocity;
        for (std::size_t i = 0; i < p.size(); ++i) sum += massOf(p.radius[i]) * p.velocity[i];
        return sum;
    };
    const Vec3 first = momentum();
    backend->advance(5'000, 0);
    CHECK(glm::length(backend->freeBodies().at(0).velocity - Vec3(0.1, 0, -0.5)) > 0.01);
    CHECK(near(momentum(), first, glm::length(first), 1e-13));
}

TEST_CASE("free bodies: the work of a body is what its own energy falls by, and the ledger closes") {
    const double mass = 1e-3;
    RuledWorld world = lidWorld(paperParameters(0.1), mass, 0.5e-3);
    world.bodies[0].course.motion = geometry::Free{mass, Vec3(0.02, 0.01, -0.1), {}};
    world.energyBook = true;
    const auto backend = makeReferenceBackend();
    backend->load(world, underLid());
    EnergyLedger ledger;
    ledger.add(*backend->advance(1, 0).energy);
    FreeBody before = backend->freeBodies().at(0);
    ledger.add(*backend->advance(1, 0).energy);
    FreeBody after = backend->freeBodies().at(0);
    const double first = energyAt(before, after, mass, kPull);
    double booked = 0;
    for (int n = 0; n < 8'000; ++n) {
        before = after;
        const Sensors s = backend->advance(1, 0);
        after = backend->freeBodies().at(0);
        booked += s.energy.value().bodyWork;
        ledger.add(*s.energy);
    }
    const double last = energyAt(before, after, mass, kPull);
    CHECK(booked > 0.1 * first);
    CHECK(near(first - last, booked, booked, 1e-9));
    CHECK(near(ledger.residual(), 0, booked, 1e-9));
}

TEST_CASE("free bodies: a run goes on from its record with the same bits") {
    RuledWorld world = lidWorld(paperParameters(0.1), 5e-3, 0.1e-3);
    world.bodies[0].course.motion = geometry::Free{5e-3, Vec3(0, 0.05, -0.1), {}};
    auto whole = makeReferenceBackend(), cut = makeReferenceBackend(), on = makeReferenceBackend();
    for (Backend* b : {whole.get(), cut.get(), on.get()}) b->load(world, underLid());
    whole->advance(3'000, 0);
    cut->advance(2'000, 0);
    on->restore(cut->snapshot());
    on->advance(1'000, 0);
    CHECK(whole->freeBodies().at(0).shift == on->freeBodies().at(0).shift);
    CHECK(whole->freeBodies().at(0).velocity == on->freeBodies().at(0).velocity);
    CHECK(whole->particles().position == on->particles().position);
}
