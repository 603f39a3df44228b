// The law of Hertz and Mindlin against its closed forms.

#include <cmath>

#include "host/law/hertz.h"
#include "host/model/stability.h"
#include "tests/law/setups.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr Elasticity kGlass{48e9, 0.2}, kSteel{210e9, 0.3};
constexpr double kReduced = 0.8e-3, kMass = 3e-6;  // R* = 0.4 mm

NormalAnswer at(const ContactParameters& p, double overlap) {
    double memory = 0;
    const NormalAnswer answer = normalAnswer(p, overlap, kReduced, kMass, memory);
    CHECK(memory == overlap);
    return answer;
}

}  // namespace

TEST_CASE("hertz: the moduli of two materials") {
    const ContactParameters alike = hertzMindlin(kGlass, kGlass, 0.9);
    CHECK(nearRelative(alike.modulus, 48e9 / (2 * (1 - 0.04)), kRounding));
    // G* = G/(2 (2 - nu)) of two alike, G = E/(2 (1 + nu)).
    CHECK(nearRelative(alike.kt * alike.modulus / 4, 48e9 / 2.4 / (2 * 1.8), kRounding));
    const ContactParameters mixed = hertzMindlin(kGlass, kSteel, 0.9);
    CHECK(nearRelative(mixed.modulus, 1 / (0.96 / 48e9 + 0.91 / 210e9), kRounding));
    CHECK(nearRelative(hertzMindlin(kSteel, kGlass, 0.9).modulus, mixed.modulus, kRounding));
    CHECK(nearRelative(mixed.kt * mixed.modulus / 4, 1 / (2 * 1.8 * 1.2 / 48e9 + 2 * 1.7 * 1.3 / 210e9), kRounding));
}

TEST_CASE("hertz: force, stiffness and damping at an overlap") {
    ContactParameters p = hertzMindlin(kGlass, kSteel, 0.5);
    p.kr = 0.3;
    p.kTo = 0.2;
    p.gammaR = 0.1;
    p.gammaTo = 0.05;
    for (const double overlap : {1e-8, 1e-6, 2e-5}) {
        const NormalAnswer a = at(p, overlap);
        const double force = 4.0 / 3.0 * p.modulus * std::sqrt(4e-4) * std::pow(overlap, 1.5);
        CHECK(nearRelative(a.force, force, kRounding));
        CHECK(a.pull == 0);
        const double h = overlap * 1e-4, slope = (at(p, overlap + h).force - at(p, overlap - h).force) / (2 * h);
        CHECK(nearRelative(hertzStiffness(p, kReduced, overlap), slope, 1e-8));
        const double share = std::log(2.0) / std::sqrt(std::log(2.0) * std::log(2.0) + kPi * kPi);
        CHECK(nearRelative(a.gamma, 2 * std::sqrt(5.0 / 6) * share * std::sqrt(slope * kMass), 1e-8));
        CHECK(nearRelative(a.gammaT, a.gamma * std::sqrt(a.kt / slope), 1e-8));
        CHECK(nearRelative(a.kr, 0.3 * slope, 1e-8));
        CHECK(nearRelative(a.kTo, 0.2 * slope, 1e-8));
        CHECK(nearRelative(a.gammaR, 0.1 * a.gamma, kRounding));
        CHECK(nearRelative(a.gammaTo, 0.05 * a.gamma, kRounding));
        // The stored energy is the area under the force.
        double area = 0;
        for (int n = 0; n < 1000; ++n) area += at(p, overlap * (n + 0.5) / 1000).force * overlap / 1000;
        CHECK(nearRelative(storedEnergy(p, overlap, kReduced, a.force, overlap), area, 1e-4));
    }
}

TEST_CASE("hertz: overlaps under a load and of an impact") {
    const ContactParameters p = hertzMindlin(kGlass, kGlass, 1);
    const double overlap = overlapUnder(p, kReduced, 0.3);
    CHECK(nearRelative(at(p, overlap).force, 0.3, kRounding));
    const double deepest = overlapOfImpact(p, kMass, kReduced, 0.7);
    const double stored = storedEnergy(p, deepest, kReduced, at(p, deepest).force, deepest);
    CHECK(nearRelative(stored, 0.5 * kMass * 0.49, kRounding));
}

TEST_CASE("hertz: restitution is the one asked for") {
    for (const double e : {0.05, 0.5, 1.0}) {
        const ContactParameters p = hertzMindlin(kGlass, kSteel, e);
        CHECK(nearRelative(restitution(p, reducedMass(2500, 1e-3, 2e-3)), e, kRounding));
        CHECK(nearRelative(restitutionAt(p, kMass, kReduced, 3), e, kRounding));
    }
}

TEST_CASE("hertz: a time step is judged at the largest overlap that the run allows") {
    ContactLaw law = lawOf(hertzMindlin(kGlass, kGlass, 0.9));
    for (ContactParameters& p : law.pairs) p.mu = 0.5;
    const double radius = 1e-3, mass = 2500 * 4.0 / 3.0 * kPi * 1e-9;
    World world;
    world.density() = 2500;
    world.maxOverlapRatio = 0.02;
    const PowderSizes sizes{{radius, radius, radius}};
    const auto modes = contactModes(world, law, sizes);
    REQUIRE(modes.size() == 2);
    const ContactParameters& p = law.between(0, 0);
    const double k = 2 * p.modulus * std::sqrt(radius / 2 * 0.02 * radius);
    CHECK(nearRelative(modes[0].duration, kPi * std::sqrt(mass / 2 / k), kRounding));
    CHECK(nearRelative(modes[1].duration, kPi * std::sqrt(mass / 7 / (p.kt * k)), kRounding));
    world.maxOverlapRatio = 0.32;
    const auto deeper = contactModes(world, law, sizes);
    CHECK(nearRelative(deeper[0].duration, modes[0].duration / 2, kRounding));
}
