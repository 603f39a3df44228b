// The integrated impact against what is known in closed form of it.

#include "host/verify/impact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/catch.h"

using namespace vkdose::verify;

namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

Striker sphere(double radius, double density = 2700) {
    return {70e9, 0.33, radius, density * 4.0 / 3.0 * 3.14159265358979 * radius * radius * radius};
}
Striker plane() {
    return {70e9, 0.33, kEndless, kEndless};
}

/// What is left of a slip of 1 that never slides, in an elastic impact with nu = 0. Without units: x'' = -x^1.5 and
/// s' = -3.5 f, where the spring stretches by f' = 1.5 x^0.5 s, and loses force as x falls.
double slipLeft() {
    const double step = 1e-5;
    double x = 0, speed = 1, slip = 1, force = 0, stiffness = 0;
    do {
        speed -= std::pow(x, 1.5) * step;
        slip -= 3.5 * force * step;
        x = std::max(0.0, x + speed * step);
        const double now = 1.5 * std::sqrt(x);
        if (now < stiffness) force *= now / stiffness;
        force += now * slip * step;
        stiffness = now;
    } while (x > 0);
    return slip;
}

}  // namespace

TEST_CASE("an integrated impact gives back the restitution, whatever the speed") {
    for (const double e : {0.3, 0.5, 0.9, 1.0})
        for (const double speed : {0.01, 3.0}) {
            CAPTURE(e, speed);
            const AfterImpact after = impactOf(sphere(0.01), plane(), e, 0.3, speed);
            CHECK(after.apart / speed == Approx(e).margin(2e-4));  // the last step ends beyond the contact
            CHECK(after.alongUpper == 0);
        }
}

TEST_CASE("an integrated impact that slips throughout passes the impulse mu (1 + e) m* v") {
    const double speed = 0.2, mu = 0.1, e = 0.5, spin = 50;
    Striker small = sphere(0.1), large = sphere(0.5);
    small.spin = spin;
    const AfterImpact after = impactOf(small, large, e, mu, speed);
    const double impulse = mu * (1 + e) * speed * small.mass * large.mass / (small.mass + large.mass);
    CHECK(after.alongUpper * small.mass / impulse == Approx(-1).epsilon(1e-4));
    CHECK(after.alongLower * large.mass / impulse == Approx(1).epsilon(1e-4));
    // The lever is shorter than the radius by half the overlap, a few ten thousandths here.
    CHECK((after.spinUpper - spin) * 0.4 * small.mass * 0.1 / impulse == Approx(-1).epsilon(1e-3));
    CHECK(after.spinLower * 0.4 * large.mass * 0.5 / impulse == Approx(-1).epsilon(1e-3));
}

TEST_CASE("an integrated impact without slip turns a slow slip around, and leaves gear wheels alone") {
    Striker upper = sphere(0.1), lower = sphere(0.1);
    upper.spin = 5;
    lower.spin = -5;
    const AfterImpact gears = impactOf(upper, lower, 0.5, 0.4, 0.4);
    CHECK(gears.spinUpper == 5);
    CHECK(gears.alongUpper == 0);
    // With nu = 0 Mindlin's stiffness is Hertz's, and 2/7 of the mass swings along the tangent: the slip swings
    // sqrt(7/2) = 1.87 times as fast as the normal direction, and comes back before the contact ends.
    upper = sphere(0.1);
    upper.spin = 0.01;
    upper.poisson = 0;
    Striker rigid = plane();
    rigid.poisson = 0;
    const AfterImpact stuck = impactOf(upper, rigid, 1, 1e6, 0.2);
    CHECK((stuck.alongUpper + stuck.spinUpper * 0.1) / (0.01 * 0.1) == Approx(slipLeft()).margin(1e-3));
    // m R v = I w lost, but for the lever.
    CHECK(stuck.alongUpper == Approx(0.4 * 0.1 * (stuck.spinUpper - 0.01)).epsilon(5e-3));
}
