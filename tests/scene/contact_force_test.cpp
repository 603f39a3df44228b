// The forces that single contacts tell: their sum moves the particles, and at rest it is the weight.

#include <algorithm>

#include "tests/scene/beds.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

double massOf(const RuledWorld& w, double radius) {
    return w.density() * (4.0 / 3.0) * kPi * radius * radius * radius;
}

std::vector<Vec3> sums(const Backend& backend) {
    std::vector<Vec3> force(backend.particles().size(), Vec3(0));
    for (const Contact& c : backend.contacts()) {
        force[c.particle] += c.force;
        if (c.kind == ContactClass::ParticleParticle) force[c.other] -= c.force;
    }
    return force;
}

bool anyForce(const Backend& backend) {
    const auto contacts = backend.contacts();
    return std::any_of(contacts.begin(), contacts.end(), [](const Contact& c) { return c.force != Vec3(0); });
}

/// Makes one step and holds what the contacts exerted against what the particles' velocities did.
void checkMomentum(Backend& backend, const RuledWorld& w, double rate) {
    const Particles before = backend.particles();
    backend.advance(1, rate);
    const Particles after = backend.particles();
    const std::vector<Vec3> force = sums(backend);
    for (std::size_t i = 0; i < after.size(); ++i) {
        if (after.status[i] != Status::Active) continue;
        const double m = massOf(w, after.radius[i]);
        const Vec3 expected = m * ((after.velocity[i] - before.velocity[i]) / w.timeStep - w.gravity);
        // Two floats hold a velocity of 1 m/s to 4e-15 m/s: over a step that is 2e-9 m/s2. Gravity and the sums of
        // forces are rounded to single precision.
        CAPTURE(i);
        CHECK(near(force[i], expected, m * 9.81, 1e-6 + 3e-6 * glm::length(expected) / (m * 9.81)));
    }
}

}  // namespace

TEST_CASE("the forces of the contacts are what moves the particles, and survive refreshes, rebuilds and a restart") {
    const bool reference = GENERATE(false, true);
    RuledWorld w = canisterWorld();
    w.maxOverlapRatio = 1;
    w.energyBook = GENERATE(false, true);
    constexpr double kRate = -9.4;
    const Particles p = thrownIn(203);
    auto backend = made(reference);
    backend->load(w, p);
    CHECK_FALSE(anyForce(*backend));
    backend->advance(4000, 0);
    for (int look = 0; look < 12; ++look) {  // lists are refreshed every hundred steps or so
        checkMomentum(*backend, w, kRate);
        backend->advance(37, kRate);
    }
    CHECK(anyForce(*backend));
    std::array<std::size_t, kContactClasses> met{};
    for (const Contact& c : backend->contacts()) met[std::size_t(c.kind)] += c.force != Vec3(0) ? 1 : 0;
    for (const std::size_t count : met) CHECK(count > 3);

    const Record taken = backend->snapshot();
    auto second = made(reference);
    second->load(w, p);
    second->restore(taken);
    CHECK_FALSE(anyForce(*second));
    checkMomentum(*second, w, kRate);
    checkMomentum(*backend, w, kRate);
    CHECK(sums(*backend) == sums(*second));
    if (!reference) requireClean(*backend);
}

TEST_CASE("a sphere at rest presses on the floor with its weight") {
    const bool reference = GENERATE(false, true);
    RuledWorld w = emptyWorld();
    w.walls = {geometry::Plane{{0, 0, 0}, {0, 1, 0}}};
    const double a = single(1.25e-3);
    Particles p;
    p.add({0.01, a, 0.02}, a);
    auto backend = made(reference);
    backend->load(w, p);
    backend->advance(30000, 0);
    const auto contacts = backend->contacts();
    REQUIRE(contacts.size() == 1);
    const double weight = massOf(w, a) * 9.81;
    // Damped for thousands of contact durations. Two floats hold the position to 2^-48 of 1 cm, 4e-17 m; on k2 = 24
    // kN/m that is 1e-12 N, of a weight of 1e-4 N. What is left is the rounding of the force itself.
    CHECK(near(contacts[0].force, Vec3(0, weight, 0), weight, 1e-5));
}
