// The case of a user's law that comes with vkdose: two wet spheres part, and their bridge ruptures.

#include <cmath>
#include <filesystem>

#include "host/backend/vulkan/law_trial.h"
#include "host/model/case.h"
#include "tests/scene/beds.h"
#include "tests/support/places.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

// As in cases/laws/liquid-bridge.toml.
constexpr double kRadius = 2.381e-3, kTension = 0.0206, kVolume = 74.2e-12;
const double kRupture = std::cbrt(kVolume);

/// Willett et al. (2000), of equal spheres without contact angle, at a gap s [N].
double pullAt(double s) {
    const double x = s * std::sqrt(kRadius / kVolume);
    return 2 * kPi * kRadius * kTension / (1 + 1.05 * x + 2.5 * x * x);
}

/// Its integral from touch to rupture in closed form [J].
double workOfRupture() {
    const double a = std::sqrt(kRadius / kVolume), b = 1.05 * a, c = 2.5 * a * a;
    const double root = std::sqrt(4 * c - b * b);
    const double area = 2 / root * (std::atan((2 * c * kRupture + b) / root) - std::atan(b / root));
    return 2 * kPi * kRadius * kTension * area;
}

Case bridgeCase() {
    tryLawsOnDevices();
    return loadCase(std::filesystem::path(sourceDir()) / "cases/laws/liquid-bridge.toml");
}

double gapOf(const Particles& p) {
    return p.position[1].x - p.position[0].x - 2 * kRadius;
}

}  // namespace

TEST_CASE("a bridge of liquid pulls by its closed form until it ruptures") {
    const Case c = bridgeCase();
    auto device = gpu();
    const Particles start = insertParticles(c).particles;
    device->load(c.world, c.dosingLaw, start);
    double last = 0;  // gap at the last step with a contact
    bool ruptured = false;
    for (int step = 0; step < 400 && !ruptured; ++step) {
        const double gap = gapOf(device->particles());  // where the forces of the next steps act
        device->advance(1, 0);
        const auto contacts = device->contacts();
        ruptured = contacts.empty();
        if (ruptured) {
            CHECK(gap >= kRupture * (1 - 1e-4));
            break;
        }
        last = gap;
        if (gap <= 0) continue;  // the spring of touch acts too
        REQUIRE(contacts.size() == 1);
        // Single precision, with a gap that is the difference of lengths five times as long or more.
        CHECK(near(contacts[0].force.x, pullAt(gap), pullAt(0), 1e-5));
        for (int more = 0; more < 20; ++more) device->advance(1, 0);
    }
    CHECK(ruptured);
    CHECK(last > 0.8 * kRupture);
    requireClean(*device);
}

TEST_CASE("the rupture of a bridge of liquid costs the work of its closed form") {
    const Case c = bridgeCase();
    auto device = gpu();
    const Particles start = insertParticles(c).particles;
    device->load(c.world, c.dosingLaw, start);
    const auto steps = std::uint32_t(std::lround(c.schedule.settleTime / c.world.timeStep));
    const Sensors s = device->advance(steps, 0);
    CHECK(device->contacts().empty());
    const double mass = sphereMass(c.world.density(), kRadius), before = mass * 0.05 * 0.05;
    // The contact begins and ends at a step, the way of which is 1/840 of the reach. The pull at touch is 2.6 times the
    // mean one.
    CHECK(near(before - s.kineticEnergy, workOfRupture(), workOfRupture(), 3e-3));
    REQUIRE(s.energy.has_value());
    CHECK(near(s.energy->plastic, workOfRupture(), workOfRupture(), 3e-3));  // a law without energy() loses all
    requireClean(*device);
}

TEST_CASE("a bridge of liquid ruptures in the reference where it does on the device") {
    const Case c = bridgeCase();
    auto device = gpu(), reference = makeReferenceBackend();
    const Particles start = insertParticles(c).particles;
    device->load(c.world, c.dosingLaw, start);
    reference->load(c.world, c.dosingLaw, start);
    for (int step = 0; step < 400; ++step) {
        device->advance(21, 0);
        reference->advance(21, 0);
        CHECK(device->contacts().size() == reference->contacts().size());
    }
    CHECK(reference->contacts().empty());
    CHECK(near(gapOf(device->particles()), gapOf(reference->particles()), kRadius, 1e-5));
    requireClean(*device);
}

TEST_CASE("a bridge of liquid comes about at touch, not within its reach") {
    const Case c = bridgeCase();
    auto device = gpu();
    Particles p;
    p.add({-kRadius - 0.2 * kRupture, 0, 0}, kRadius, {0.05, 0, 0}, {0, 0, 0});
    p.add({kRadius + 0.2 * kRupture, 0, 0}, kRadius, {-0.05, 0, 0}, {0, 0, 0});
    device->load(c.world, c.dosingLaw, p);
    bool touched = false, held = false;
    for (int k = 0; k < 400; ++k) {
        const bool apart = gapOf(device->particles()) > 1e-7;
        device->advance(5, 0);
        const bool contact = !device->contacts().empty();
        if (!touched && apart && gapOf(device->particles()) > 1e-7) CHECK_FALSE(contact);
        touched = touched || contact;
        held = held || (contact && gapOf(device->particles()) > 1e-5);
    }
    CHECK(touched);
    CHECK(held);
    requireClean(*device);
}
