// The closed forms against what they are closed forms of: a collision step by step, a contact that is pulled apart.
#include "host/advice/figures.h"

#include <cmath>
#include <limits>

#include "host/law/eepa.h"
#include "host/law/hertz.h"
#include "host/law/jkr.h"
#include "host/law/luding.h"
#include "host/model/bed_weight.h"
#include "host/model/stability.h"
#include "tests/advice/warnings.h"
#include "tests/model/case_files.h"
#include "tests/support/catch.h"

using namespace vkdose;

namespace {

constexpr double kDensity = 1427;
constexpr double kWall = std::numeric_limits<double>::infinity();

ContactParameters paperContact() {
    ContactParameters p;
    p.k2Max = 24067;
    p.k1 = 0.2 * p.k2Max;
    p.kc = 0.873 * p.k2Max;
    p.plasticityDepth = 0.05;
    p.gamma = 0.0827;
    return p;
}

/// Restitution of a spring and dashpot, step by step, from touch to the end of the overlap.
double collision(double k, double gamma, double mass) {
    const double dt = 1e-4 * std::sqrt(mass / k);
    double x = 0, v = 1;
    do {
        v -= dt * (k * x + gamma * v) / mass;
        x += dt * v;
    } while (x > 0);
    return -v;
}

/// The strongest pull on the way apart after loading to `deepest`, by the law itself.
double pulledApart(const ContactParameters& p, double reduced, double deepest) {
    double largest = 0, pull = 0;
    normalForce(p, deepest, reduced, largest);
    for (int i = 0; i <= 100000; ++i) {
        const double overlap = deepest * (1 - i * 1e-5);
        pull = std::max(pull, -normalForce(p, overlap, reduced, largest));
    }
    return pull;
}

}  // namespace

TEST_CASE("restitution by the closed form is that of the spring and dashpot") {
    const ContactParameters p = paperContact();
    const double a = 1.25e-3, mass = sphereMass(kDensity, a);
    // The steps are 1e-4 of the oscillation's time; the error is of that order.
    CHECK(restitution(p, reducedMass(kDensity, a, a)) == Approx(collision(p.k1, p.gamma, mass / 2)).margin(1e-3));
    CHECK(restitution(p, reducedMass(kDensity, a, kWall)) == Approx(collision(p.k1, p.gamma, mass)).margin(1e-3));
    // The paper's own figure.
    CHECK(restitution(p, reducedMass(kDensity, a, a)) == Approx(0.45).margin(0.01));

    ContactParameters thick = p;
    thick.gamma = 10;
    CHECK(restitution(thick, reducedMass(kDensity, a, a)) == 0);
    for (const double e : {0.05, 0.45, 0.9}) {
        thick.gamma = dampingFor(e, p, reducedMass(kDensity, a, a));
        CHECK(restitution(thick, reducedMass(kDensity, a, a)) == Approx(e));
    }
}

TEST_CASE("restitution of a law that is given one is that one") {
    ContactParameters rest;
    rest.surfaceEnergy = 0.2;
    rest.plasticityRatio = 0.5;
    const Elasticity elastic{5e6, 0.25};
    for (const auto make : {hertzMindlin, elastoPlasticAdhesive, elasticAdhesive})
        CHECK(restitution(make(elastic, elastic, 0.6, rest), 1e-6) == Approx(0.6));
}

TEST_CASE("restitutions are told of the pairs of powders that have particles") {
    const test::Folder folder;
    const auto file = folder.write("case.toml", test::kFreeCase + "[[powder]]\nname = \"sugar\"\ndensity = 1590.0\n");
    const auto pairs = [&](const char* second) {
        folder.write("two.csv", std::string("x,y,z,r,powder\n0,0,0,1e-3,powder\n0,3e-3,0,1e-3,") + second);
        const Case c = loadCase(file);
        return figuresOf(c, insertParticles(c)).restitutions.size();
    };
    CHECK(pairs("sugar\n") == 3);
    CHECK(pairs("powder\n") == 1);
}

TEST_CASE("the pull-off force is the strongest pull of the contact law") {
    const ContactParameters p = paperContact();
    const double a = 1.25e-3;
    const double limit = p.k2Max / (p.k2Max - p.k1) * p.plasticityDepth * a;
    for (const double part : {0.1, 0.5, 1.0}) {
        CAPTURE(part);
        // The overlap is walked in 1e5 steps.
        CHECK(pullOffUnder(p, a, part * limit * p.k1) == Approx(pulledApart(p, a, part * limit)).epsilon(1e-3));
    }
    CHECK(pullOffUnder(p, a, kWall) == Approx(pulledApart(p, a, limit)).epsilon(1e-3));
    ContactParameters elastic = p;
    elastic.k1 = p.k2Max;
    CHECK(pullOffUnder(elastic, a, kWall) == 0);
}

TEST_CASE("the settled bed fills the canister to its volume") {
    // The mass that fills the lower half of the trough: the bed stands at the axis.
    const double half = 11.5e-3, length = 40e-3;
    const double mass = 0.5 * kPi * half * half * length * kDensity * kBedFraction;
    const auto figures = [&](double share) {
        const Case c = loadCase(test::plainCase(), {"particles.mass_g=" + std::to_string(share * mass * 1e3)});
        return figuresOf(c, insertParticles(c));
    };
    // One sphere more or less is 0.05 g, a hundredth of the mass, which makes 0.1 mm.
    CHECK(figures(1).bedTop == Approx(0).margin(2e-4));
    CHECK(figures(1).bedDepth == Approx(half).margin(2e-4));
    CHECK(figures(2).bedTop == Approx(0.25 * kPi * half).margin(2e-4));
    const Figures f = figures(2);
    CHECK(f.fall == Approx(0.5 * 9.81 * f.fallTime * f.fallTime));
    CHECK(f.fallSpeed == Approx(9.81 * f.fallTime));
}

TEST_CASE("the fall ends on the canister's own material") {
    const auto figures = [](const std::vector<std::string>& overrides) {
        const Case c = loadCase(test::plainCase(), overrides);
        return figuresOf(c, insertParticles(c));
    };
    const double stiffness = loadCase(test::plainCase()).dosingLaw.of(ContactClass::ParticleWall).k2Max;
    const std::vector<std::string> steel{"particles.material=\"cocoa\"", "material=[{name=\"steel\"}]",
                                         "canister.material=\"steel\"",
                                         "contact.cocoa-steel.k=" + std::to_string(stiffness / 4)};
    // The overlap of a linear spring goes with the root of its stiffness.
    CHECK(figures(steel).overlapOfFall == Approx(2 * figures({}).overlapOfFall));
    CHECK(figures(steel).overlapUnderBed == Approx(figures({}).overlapUnderBed));
}

TEST_CASE("gaps of the coil are measured across the wire") {
    const Case c = loadCase(test::plainCase());
    const Figures f = figuresOf(c, insertParticles(c));
    // Two points of neighbouring turns, the nearest pair found by search.
    const geometry::Coil& coil = *c.world.coil;
    double nearest = kWall;
    for (int i = 0; i <= 10000; ++i) {
        const double s = coil.pitch * (0.5 + i * 1e-4);  // along the axis from the point at s = 0
        const double psi = 2 * kPi * s / coil.pitch;
        nearest = std::min(nearest, std::hypot(coil.radius * (std::cos(psi) - 1), coil.radius * std::sin(psi), s));
    }
    // The straight gap is that of the helix unrolled, which curvature changes little.
    CHECK(f.coilGap == Approx(nearest - 2 * coil.wireRadius).epsilon(0.01));
    CHECK(f.coilClearance == Approx(0.1e-3));
    CHECK(f.stepLimit == "particle-particle normal");
    CHECK(std::isnan(figuresOf(loadCase(test::plainCase(), {"gravity=[0, 9.81, 0]"}), insertParticles(c)).bedDepth));
}

TEST_CASE("the automatic time step that is told is the one that is taken, with the spheres that refills bring") {
    const test::Folder folder;
    const std::string flap =
        "[[body]]\nname = \"flap\"\nshape = \"disc\"\nradius_mm = 8\nat = [0, 0, 0.1]\n[body.motion]\n"
        "kind = \"hinge\"\ninertia_g_mm2 = 1\n";
    const auto taken = [&](const std::string& refill) {
        const Case c = loadCase(folder.write("case.toml", std::string(test::kGoodCase) + flap + refill),
                                {"particles.mass_g=0.01"});
        const Figures f = figuresOf(c, insertParticles(c));
        // It is that of the bounds of the sizes; the few spheres that are drawn are somewhat larger.
        CHECK(c.world.timeStep == Approx(f.automaticStep).epsilon(0.1));
        CHECK((f.stepLimit.find("flap") != std::string::npos) == !refill.empty());
        return c.world.timeStep;
    };
    CHECK(taken("[[refill]]\nname = \"more\"\nmass_g = 0.2\nbefore_dose = 2\n") < 0.8 * taken(""));
}

TEST_CASE("what limits the time step is told with the bodies that it may be") {
    const test::Folder folder;
    const std::string disc = "shape = \"disc\"\nradius_mm = 8\nat = [0, 0, 0.1]\n";
    const auto file =
        folder.write("case.toml", std::string(test::kGoodCase) + "[[body]]\nname = \"gate\"\n" + disc +
                                      "[[body]]\nname = \"lid\"\n" + disc + "material = \"steel\"\n" +
                                      "[[body]]\nname = \"paddle\"\n" + disc + "[[material]]\nname = " + "\"steel\"\n");
    const auto limit = [&](const char* key) {
        const Case c = loadCase(file, {key});
        return figuresOf(c, insertParticles(c)).stepLimit;
    };
    // Rolling against a wall is faster than bouncing off it: 1/6 of sqrt(0.1 m / 0.286 k) against 1/8 of sqrt(m / k).
    // Of two spheres bouncing is, since it moves half the mass.
    CHECK(limit("contact.wall.k=90000") == "powder-wall rolling (bodies of this material: gate, paddle)");
    CHECK(limit("contact.powder-steel.k=90000") == "powder-steel rolling (bodies of this material: lid)");
    CHECK(limit("contact.coil.k=90000") == "powder-coil rolling");
    CHECK(limit("contact.wall.k=1") == "powder-powder normal");
}
