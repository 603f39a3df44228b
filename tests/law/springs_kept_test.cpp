// Springs whose stiffness follows the overlap give no energy: a loop of shear at a small overlap and back at a large
// one.

#include <array>

#include "host/backend/reference/contact.h"
#include "host/backend/reference/rolling.h"
#include "host/law/eepa.h"
#include "host/law/hertz.h"
#include "host/law/jkr.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::reference;
using test::nearRelative;

namespace {

constexpr double kReduced = 2e-3, kMass = 1e-5;  // [m], [kg]
constexpr int kPieces = 4000;                    // of each part of the loop

struct Work {
    double sliding = 0, rolling = 0, torsion = 0;
};

/// A contact under one law, moved as told.
struct Pressed {
    ContactLaw law;
    History history = {};
    Parts before = {};
    double overlap = 0;
    Work taken = {};  ///< from the motion [J]

    explicit Pressed(const ContactParameters& p) { law.pairs.fill(p); }

    /// To this overlap, while the surfaces move by `way` in each direction.
    void go(double to, double way) {
        const double lever = rollingLever(law.rollingLever, kReduced), from = overlap;
        for (int k = 1; k <= kPieces; ++k) {
            overlap = from + (to - from) * k / kPieces;
            const double step = way / kPieces;
            Touch touch{};
            touch.normal = Vec3(0, 1, 0);
            touch.overlap = overlap;
            touch.reduced = kReduced;
            touch.smaller = kReduced / 2;
            touch.mass = kMass;
            touch.velocity = Vec3(step, 0, 0);
            touch.spin = Vec3(0, 1, 1) * step / lever;
            const Parts now = contactResponse(law, {kFirstPowder, kWallMaterial}, touch, 1, history).parts;
            taken.sliding -= 0.5 * glm::dot(before.sliding + now.sliding, touch.velocity);
            taken.rolling -= 0.5 * glm::dot(before.rolling + now.rolling, touch.spin);
            taken.torsion -= 0.5 * glm::dot(before.torsion + now.torsion, touch.spin);
            before = now;
        }
    }
};

std::array<ContactParameters, 3> lawsOfModuli() {
    const Elasticity soft{2e7, 0.25};
    ContactParameters plastic, adhesive;
    plastic.plasticityRatio = 0.4;
    adhesive.surfaceEnergy = 0.05;
    std::array laws{hertzMindlin(soft, soft, 1), elastoPlasticAdhesive(soft, soft, 1, plastic),
                    elasticAdhesive(soft, soft, 1, adhesive)};
    for (ContactParameters& p : laws) {
        p.mu = p.muR = p.muTo = 1e6;  // nothing slips
        p.kr = 0.7;
        p.kTo = 0.4;
    }
    return laws;
}

}  // namespace

TEST_CASE("a contact that is sheared, pressed, sheared back and let go takes energy and gives none") {
    constexpr double kSmall = 1e-6, kLarge = 9e-6, kWay = 1e-7;  // [m]
    for (const ContactParameters& p : lawsOfModuli()) {
        INFO("law " << int(p.law));
        const ContactParameters small = linearised(p, kMass, kReduced, kSmall),
                                large = linearised(p, kMass, kReduced, kLarge);
        Pressed loop(p);
        loop.go(kSmall, 0);
        loop.go(kSmall, kWay);
        loop.go(kLarge, 0);
        loop.go(kLarge, -kWay);
        loop.go(0.01 * kSmall, 0);
        // The force k1 s stays while the stiffness grows to k2. On the way back it falls by k2 s.
        const auto lost = [&](double was, double is) { return (is - was) * kWay * kWay / 2; };
        CHECK(nearRelative(loop.taken.sliding, lost(small.kt, large.kt), 1e-3));
        CHECK(nearRelative(loop.taken.rolling, lost(small.kr, large.kr), 1e-3));
        CHECK(nearRelative(loop.taken.torsion, lost(small.kTo, large.kTo), 1e-3));
    }
}

TEST_CASE("a spring keeps its length while the contact gets softer") {
    for (const ContactParameters& p : lawsOfModuli()) {
        INFO("law " << int(p.law));
        Pressed contact(p);
        contact.go(9e-6, 0);
        contact.go(9e-6, 1e-7);
        const Vec3 spring = contact.history.sliding;
        contact.go(7e-6, 0);
        CHECK(contact.history.sliding == spring);
        CHECK(nearRelative(contact.before.sliding.x, -linearised(p, kMass, kReduced, 7e-6).kt * spring.x, 1e-12));
    }
}
