// The four laws put together in one contact.

#include "host/backend/reference/contact.h"

#include "tests/law/setups.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;
using namespace vkdose::reference;

namespace {

Body sphere(const Vec3& x, const Vec3& v = Vec3(0), const Vec3& w = Vec3(0), double a = kRadius) {
    return {x, v, w, a};
}

/// A contact at `overlap` that has been pressed deeper before and now slides, `vn` along the normal.
Touch slidingTouch(double overlap, double vn) {
    Touch touch{};
    touch.normal = Vec3(0, 1, 0);
    touch.overlap = overlap;
    touch.reduced = 2 * kRadius;
    touch.smaller = kRadius;
    touch.leverI = Vec3(0, -(kRadius - overlap / 2), 0);
    touch.velocity = Vec3(1, vn, 0);
    return touch;
}

}  // namespace

TEST_CASE("contact: spheres touch when their distance is less than both radii") {
    const Body a = sphere(Vec3(0)), b = sphere(Vec3(3e-3, 0, 0), Vec3(0), Vec3(0), 2e-3);
    const std::optional<Touch> touch = touchSphere(a, b);
    REQUIRE(touch);
    CHECK(near(touch->overlap, 0.25e-3, kRadius, kRounding));
    CHECK(near(touch->normal, Vec3(-1, 0, 0), 1, kRounding));
    CHECK(nearRelative(touch->reduced, 2 * 1.25e-3 * 2e-3 / 3.25e-3, kRounding));
    CHECK(near(touch->leverI, Vec3(1.125e-3, 0, 0), kRadius, kRounding));
    CHECK(near(touch->leverJ, Vec3(-1.875e-3, 0, 0), kRadius, kRounding));
    CHECK(touch->smaller == kRadius);
    CHECK_FALSE(touchSphere(a, sphere(Vec3(2.5e-3, 0, 0))));
    CHECK_FALSE(touchSphere(a, sphere(Vec3(std::nan(""), 0, 0))));
}

TEST_CASE("contact: the relative velocity holds both spins, and a rolling pair does not slide") {
    const Body a = sphere(Vec3(0, kRadius, 0), Vec3(0.1, 0, 0), Vec3(0, 0, -0.1 / kRadius));
    const Body b = sphere(Vec3(0, -kRadius, 0), Vec3(-0.1, 0, 0), Vec3(0, 0, -0.1 / kRadius));
    // Still touching by a hair: the lever is a - delta/2.
    Body pressed = a;
    pressed.position.y -= 1e-9;
    const std::optional<Touch> gears = touchSphere(pressed, b);
    REQUIRE(gears);
    // At the contact point a moves with 0.1 - 0.1 = 0, b with -0.1 + 0.1 = 0.
    CHECK(near(gears->velocity, Vec3(0), 0.1, 1e-6));
    Body reversed = b;
    reversed.spin = -b.spin;
    CHECK(near(touchSphere(pressed, reversed)->velocity, Vec3(0.2, 0, 0), 0.1, 1e-6));
}

TEST_CASE("contact: swapping the two spheres turns force and couple round") {
    const Body a = sphere(Vec3(0), Vec3(0.1, 0.2, -0.1), Vec3(10, 5, -7));
    const Body b = sphere(Vec3(1.4e-3, 1.2e-3, -1.6e-3), Vec3(0.05, -0.1, 0.3), Vec3(3, -20, 5), 1.3e-3);
    ContactParameters p = paperParameters(0.3);
    p.kTo = 1000;
    p.gammaTo = 0.01;
    p.muTo = 0.1;
    const ContactLaw law = lawOf(p);
    History one, two;
    const Response there = contactResponse(law, pairOf(ContactClass::ParticleParticle), *touchSphere(a, b), 1e-6, one);
    const Response back = contactResponse(law, pairOf(ContactClass::ParticleParticle), *touchSphere(b, a), 1e-6, two);
    CHECK(near(there.force, -back.force, glm::length(there.force), kRounding));
    CHECK(near(there.couple, -back.couple, glm::length(there.couple), kRounding));
    CHECK(near(there.torqueI, back.torqueJ, glm::length(there.torqueI), kRounding));
    CHECK(near(there.torqueJ, back.torqueI, glm::length(there.torqueJ), kRounding));
    CHECK(near(one.sliding, -two.sliding, glm::length(one.sliding), kRounding));
    CHECK(near(one.torsion, two.torsion, std::abs(one.torsion), kRounding));
}

TEST_CASE("contact: a wall has the velocity of its turning, a fixed one none") {
    const Body a = sphere(Vec3(0, -10e-3, 5e-3), Vec3(0), Vec3(0));
    const double overlap = 1e-6, rate = -9.0;
    const Vec3 n(0, 1, 0);
    const vkdose::geometry::Moving turning{Vec3(0), Vec3(0, 0, rate), Vec3(0)}, fixed{};
    const std::optional<Touch> touch = touchWall(a, n, kRadius - overlap, turning);
    REQUIRE(touch);
    const double arm = 10e-3 + kRadius - overlap / 2;  // of the contact point from the coil's axis
    CHECK(near(touch->velocity, -Vec3(rate * arm, 0, 0), rate * -arm, kRounding));
    CHECK(near(touch->spin, Vec3(0, 0, -rate), 9, kRounding));
    CHECK(nearRelative(touch->reduced, 2 * kRadius, kRounding));
    CHECK(touchWall(a, n, kRadius - overlap, fixed)->velocity == Vec3(0));
    CHECK_FALSE(touchWall(a, n, kRadius, turning));
    CHECK_FALSE(touchWall(a, n, std::nan(""), turning));
    // A sphere that turns with the coil as one rigid body feels no relative motion at all.
    const Body carried = sphere(a.position, glm::cross(Vec3(0, 0, rate), a.position), Vec3(0, 0, rate));
    CHECK(near(touchWall(carried, n, kRadius - overlap, turning)->velocity, Vec3(0), 0.1, kRounding));
    // The same if its velocity is that of half a step before, when it was where it came from by this velocity.
    const double back = 1e-3;
    const Body later = sphere(a.position + back * carried.velocity, carried.velocity, carried.spin);
    CHECK(near(touchWall(later, n, kRadius - overlap, turning, 0, back)->velocity, Vec3(0), 0.1, kRounding));
    CHECK(glm::length(touchWall(later, n, kRadius - overlap, turning)->velocity) > 1e-4);
}

TEST_CASE("contact: what limits friction, both readings") {
    ContactParameters p = paperParameters(0.873, 0.5, 0);
    const double pressed = 20e-6;
    for (const double overlap : {18e-6, 12e-6})      // repulsive and attractive
        for (const double vn : {-0.05, 0.0, 0.2}) {  // approaching, still, parting
            History h;
            h.maxOverlap = pressed;
            History copy = h;
            ContactParameters bare = p;
            bare.gamma = bare.mu = 0;
            const double f =
                contactResponse(lawOf(bare), pairOf(ContactClass::ParticleWall), slidingTouch(overlap, vn), 0, copy)
                    .force.y;
            const double fn = f - p.gamma * vn;
            for (const CoulombLimit limit : {CoulombLimit::Luding, CoulombLimit::Absolute}) {
                copy = h;
                copy.sliding = Vec3(1e-3, 0, 0);  // far beyond any limit
                const Response response = contactResponse(lawOf(p, limit), pairOf(ContactClass::ParticleWall),
                                                          slidingTouch(overlap, vn), 0, copy);
                const double bearing = limit == CoulombLimit::Luding ? std::max(0.0, f + p.kc * overlap) : std::abs(fn);
                CAPTURE(overlap, vn, f, fn, bearing);
                CHECK(near(response.force, Vec3(-p.mu * bearing, fn, 0), p.k1 * pressed, kRounding));
            }
        }
}

TEST_CASE("contact: with adhesion Luding's limit lets a pulled contact bear friction") {
    const ContactParameters p = paperParameters(0.873, 0.5, 0);
    History h;
    h.maxOverlap = 20e-6;
    h.sliding = Vec3(1e-3, 0, 0);
    Touch touch = slidingTouch(1.5e-6, 0);  // deep on the adhesive branch: f = -kc delta exactly
    const Response response =
        contactResponse(lawOf(p, CoulombLimit::Luding), pairOf(ContactClass::ParticleWall), touch, 0, h);
    CHECK(near(response.force, Vec3(0, -p.kc * 1.5e-6, 0), p.kc * 1.5e-6, 1e-9));  // there the shifted zero is reached
}

TEST_CASE("contact: rolling and torsion torques are capped by their own friction on the same normal force") {
    for (const RollingLever lever : {RollingLever::Full, RollingLever::Half}) {
        ContactParameters p = paperParameters(0, 0, 0.3);
        p.kTo = 1000;
        p.muTo = 0.1;
        p.gamma = 0;
        Touch touch = slidingTouch(1e-6, 0);
        touch.spin = Vec3(0, 0, -1);
        History h;
        h.rolling = Vec3(1e-3, 0, 0);
        h.torsion = 1e-3;
        const Response response =
            contactResponse(lawOf(p, CoulombLimit::Luding, lever), pairOf(ContactClass::ParticleWall), touch, 0, h);
        const double bearing = p.k1 * 1e-6, reach = lever == RollingLever::Full ? 2 * kRadius : kRadius;
        const Vec3 expected = reach * bearing * Vec3(0, -p.muTo, p.muR);
        CHECK(near(response.couple, expected, reach * bearing, kRounding));
        CHECK(near(response.torqueI, response.couple, reach * bearing, kRounding));
        CHECK(near(response.torqueJ, -response.couple, reach * bearing, kRounding));
    }
}

TEST_CASE("contact: every class takes its own parameters") {
    ContactLaw law;
    law.of(ContactClass::ParticleParticle) = spring(1000);
    law.of(ContactClass::ParticleWall) = spring(2000);
    law.of(ContactClass::ParticleCoil) = spring(3000);
    const Touch touch = slidingTouch(1e-6, 0);
    for (const auto& [kind, k] :
         {std::pair{ContactClass::ParticleParticle, 1000.0}, std::pair{ContactClass::ParticleWall, 2000.0},
          std::pair{ContactClass::ParticleCoil, 3000.0}}) {
        History h;
        CHECK(nearRelative(contactResponse(law, pairOf(kind), touch, 0, h).force.y, k * 1e-6, kRounding));
    }
}
