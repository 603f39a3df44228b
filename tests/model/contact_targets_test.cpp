// Parameters as people have them: a restitution, a contact duration, an overlap under the bed's weight, a Bond number.
// Closed forms and case files; target_physics_test.cpp simulates what comes out.
#include "host/model/contact_targets.h"
#include "host/law/luding.h"

#include <cmath>

#include "host/core/error.h"
#include "host/model/bed_weight.h"
#include "host/model/stability.h"
#include "tests/model/case_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using test::Folder;
using test::kGoodCase;
using test::replaced;

namespace {

constexpr double kWall = std::numeric_limits<double>::infinity();
constexpr ContactClass kPair = ContactClass::ParticleParticle, kAtWall = ContactClass::ParticleWall;

/// The paper's contact of two mean spheres.
constexpr double kRadius = 1.25e-3, kDensity = 1427;
ContactParameters paperContact(double gamma, double kcOverK) {
    ContactParameters p;
    p.k2Max = 24067;
    p.k1 = 0.2 * p.k2Max;
    p.kc = kcOverK * p.k2Max;
    p.plasticityDepth = 0.05;
    p.gamma = gamma;
    return p;
}
double paperRebound(const ContactParameters& p, double speed) {
    return restitutionAt(p, reducedMass(kDensity, kRadius, kRadius), kRadius, speed);
}

/// kGoodCase with a line of [contact] replaced.
std::string withContact(const std::string& line, const std::string& now) {
    return replaced(kGoodCase, line + "\n", now + "\n");
}

std::string messageOf(const std::string& text, const std::vector<std::string>& overrides = {}) {
    const Folder folder;
    try {
        loadCase(folder.write("case.toml", text), overrides);
        return "";
    } catch (const CaseError& error) {
        return error.what();
    }
}

}  // namespace

TEST_CASE("restitution at a speed: the closed form without damping, another program's figures with it") {
    // Without damping: E/kappa comes back on the unloading line, and the adhesive branch costs
    // E chi (kappa - 1)^2/(kappa (kappa + chi)), kappa = k2/k1, chi = k_c/k1.
    const double mass = reducedMass(kDensity, kRadius, kRadius), limit = 1.25 * 0.05 * kRadius;
    for (const double speed : {0.1, 0.4, 0.6, 0.65}) {
        CAPTURE(speed);
        const ContactParameters p = paperContact(0, 0.873);
        const double kappa = 1 + 4 * speed * std::sqrt(mass / p.k1) / limit, chi = p.kc / p.k1;
        const double expected = std::sqrt(1 / kappa - chi * (kappa - 1) * (kappa - 1) / (kappa * (kappa + chi)));
        CHECK(paperRebound(p, speed) == Approx(expected).margin(1e-4));
    }
    CHECK(paperRebound(paperContact(0, 0.873), 0.8) == 0);  // they stick above 0.76 m/s
    // Beyond the plastic limit the line is k2 both ways; the loss is that of the limit.
    const ContactParameters dry = paperContact(0, 0);
    const double fast = 10, atLimit = dry.k1 * limit * limit / 2, lost = atLimit * (1 - dry.k1 / dry.k2Max);
    CHECK(paperRebound(dry, fast) == Approx(std::sqrt(1 - lost / (mass * fast * fast / 2))).margin(1e-4));

    // With damping: MercuryDPM, steps of 1e-7 s.
    const ContactParameters damped = paperContact(0.0827, 0);
    CHECK(paperRebound(damped, 0.05) == Approx(0.4220781761).margin(1e-3));
    CHECK(paperRebound(damped, 0.2) == Approx(0.3541910262).margin(1e-3));
    CHECK(paperRebound(damped, 1) == Approx(0.1578007475).margin(1e-3));
    CHECK(paperRebound(paperContact(0.0827, 0.873), 0.2) == Approx(0.325962277).margin(1e-3));
    // Slow impacts tend to the closed form of damping alone.
    CHECK(paperRebound(damped, 1e-5) ==
          Approx(restitution(damped, reducedMass(kDensity, kRadius, kRadius))).margin(1e-4));
    CHECK(paperRebound(damped, 0) == restitution(damped, reducedMass(kDensity, kRadius, kRadius)));
}

TEST_CASE("the adhesion of a wanted pull is the inverse of the pull-off force") {
    for (const double load : {0.01, 1.0, kWall}) {
        const ContactParameters p = paperContact(0, 0);
        const double most = strongestPull(p, kRadius, load);
        for (const double share : {0.0, 0.01, 0.5, 0.99}) {
            CAPTURE(load, share);
            ContactParameters sticky = p;
            const auto kc = adhesionFor(share * most, p, kRadius, load);
            REQUIRE(kc);
            sticky.kc = *kc;
            CHECK(pullOffUnder(sticky, kRadius, load) == Approx(share * most));
        }
        CHECK_FALSE(adhesionFor(1.01 * most, p, kRadius, load));
    }
}

TEST_CASE("the paper's restitution and contact duration give the paper's damping and stiffness") {
    const auto file = test::shippedCase("paper-48g.toml");
    const Case e = loadCase(file, {"contact.restitution=0.45"});
    // The paper prints e = 0.45 beside gamma = 0.0827; the closed form makes 0.0826 on its k1.
    CHECK(e.dosingLaw.of(kPair).gamma == Approx(0.0826).epsilon(1e-3));
    const Case both =
        loadCase(file, {"contact.restitution=0.45", "contact.contact_duration_s=1.1297e-4", "time.step_s=auto"});
    CHECK(both.dosingLaw.of(kPair).k1 == Approx(4806).epsilon(2e-3));
    CHECK(both.dosingLaw.of(kPair).gamma == Approx(0.0825).epsilon(2e-3));
    CHECK(derive(both, insertParticles(both)).durations[0].mean == Approx(1.1297e-4).epsilon(1e-9));
}

TEST_CASE("each class gets the restitution and the duration for its own mass") {
    const Folder folder;
    const auto file = folder.write("case.toml", withContact("damping = 0.02", "restitution = 0.6"));
    const Case c = loadCase(file);
    const double mean = 1.1e-3;
    CHECK(restitution(c.dosingLaw.of(kPair), reducedMass(1427, mean, mean)) == Approx(0.6).epsilon(1e-12));
    for (const ContactClass kind : {kAtWall, ContactClass::ParticleCoil})
        CHECK(restitution(c.dosingLaw.of(kind), reducedMass(1427, mean, kWall)) == Approx(0.6).epsilon(1e-12));
    CHECK(c.dosingLaw.of(kAtWall).gamma > 1.3 * c.dosingLaw.of(kPair).gamma);

    // A class that states its own parameter keeps it, and so do those below it.
    const Case own = loadCase(file, {"contact.wall.damping=0.03"});
    CHECK(own.dosingLaw.of(kAtWall).gamma == 0.03);
    CHECK(own.dosingLaw.of(ContactClass::ParticleCoil).gamma == 0.03);
    const Case other = loadCase(file, {"contact.wall.restitution=0.3", "contact.coil.k=3000"});
    CHECK(restitution(other.dosingLaw.of(kAtWall), reducedMass(1427, mean, kWall)) == Approx(0.3).epsilon(1e-12));
    CHECK(restitution(other.dosingLaw.of(ContactClass::ParticleCoil), reducedMass(1427, mean, kWall)) ==
          Approx(0.3).epsilon(1e-12));
    CHECK(restitution(other.dosingLaw.of(kPair), reducedMass(1427, mean, mean)) == Approx(0.6).epsilon(1e-12));

    const Case timed = loadCase(file, {"contact.contact_duration_s=2e-4", "contact.wall.contact_duration_s=3e-4"});
    const Derived d = derive(timed, insertParticles(timed));
    CHECK(d.durations[0].mean == Approx(2e-4).epsilon(1e-12));
    CHECK(d.durations[1].mean == Approx(3e-4).epsilon(1e-12));
    CHECK(d.durations[2].mean == Approx(3e-4).epsilon(1e-12));
    // With a stated damping too.
    const Case damped = loadCase(file, {"contact.damping=0.02", "contact.contact_duration_s=2e-4"});
    CHECK(derive(damped, insertParticles(damped)).durations[0].mean == Approx(2e-4).epsilon(1e-12));
    CHECK(damped.dosingLaw.of(kPair).gamma == 0.02);
}

TEST_CASE("a restitution at a speed counts plasticity and adhesion") {
    const Folder folder;
    const auto file = folder.write("case.toml", withContact("damping = 0.02", "restitution = 0.6"));
    const double mean = 1.1e-3, pairMass = reducedMass(1427, mean, mean);
    const Case c = loadCase(file, {"contact.restitution_speed=0.05"});
    const ContactParameters& p = c.dosingLaw.of(kPair);
    CHECK(restitutionAt(p, pairMass, mean, 0.05) == Approx(0.6).epsilon(1e-6));
    CHECK(restitutionAt(c.dosingLaw.of(kAtWall), 2 * pairMass, 2 * mean, 0.05) == Approx(0.6).epsilon(1e-6));
    CHECK(p.gamma < 0.95 * loadCase(file).dosingLaw.of(kPair).gamma);
    // Together with the duration and the Bond number, all at once.
    const Case all = loadCase(file, {"contact.restitution_speed=0.05", "contact.contact_duration_s=2e-4",
                                     "contact.bond_number=50", "contact.wall.restitution_speed=0.02"});
    const ContactParameters& q = all.dosingLaw.of(kPair);
    CHECK(restitutionAt(q, pairMass, mean, 0.05) == Approx(0.6).epsilon(1e-6));
    CHECK(restitutionAt(all.dosingLaw.of(kAtWall), 2 * pairMass, 2 * mean, 0.02) == Approx(0.6).epsilon(1e-6));
    CHECK(derive(all, insertParticles(all)).durations[0].mean == Approx(2e-4).epsilon(1e-9));
    CHECK(pullOffUnder(q, mean, kWall) == Approx(50 * 2 * pairMass * 9.81).epsilon(1e-9));
}

TEST_CASE("stiffness from an overlap, adhesion from a Bond number") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);
    const double mean = 1.1e-3, weight = 1427 * 4.0 / 3 * kPi * mean * mean * mean * 9.81;
    const Case c = loadCase(file, {"contact.overlap_under_bed=0.004"});
    // The bed's pressure on the square of a diameter, five times that in a chain of force.
    const double depth = bedDepth(*c.canister, 0.9e-3, 1427);
    const double load = 1427 * 0.46 * 9.81 * depth * 4 * mean * mean;
    CHECK(5 * load / c.dosingLaw.of(kPair).k1 / mean == Approx(0.004).epsilon(1e-12));
    CHECK(c.dosingLaw.of(kAtWall).k1 == c.dosingLaw.of(kPair).k1);

    const Case limit = loadCase(file, {"contact.bond_number=30"});
    CHECK(pullOffUnder(limit.dosingLaw.of(kPair), mean, kWall) == Approx(30 * weight).epsilon(1e-12));
    // a* is twice as large at a wall, so that it needs less adhesion.
    CHECK(pullOffUnder(limit.dosingLaw.of(kAtWall), 2 * mean, kWall) == Approx(30 * weight).epsilon(1e-12));
    CHECK(limit.dosingLaw.of(kAtWall).kc < limit.dosingLaw.of(kPair).kc);
    const Case bed = loadCase(file, {"contact.bond_number=0.01", "contact.bond_load=bed"});
    CHECK(pullOffUnder(bed.dosingLaw.of(kPair), mean, load) == Approx(0.01 * weight).epsilon(1e-12));
    CHECK(loadCase(file, {"contact.bond_number=0"}).dosingLaw.of(kPair).kc == 0);
    // The wire's curvature makes a* smaller.
    const Case curved = loadCase(file, {"contact.bond_number=30", "coil.wire_curvature=true"});
    CHECK(pullOffUnder(curved.dosingLaw.of(ContactClass::ParticleCoil), 2 * mean * 0.8e-3 / (mean + 0.8e-3), kWall) ==
          Approx(30 * weight).epsilon(1e-12));

    // While settling every class keeps its own, unless [settle] says otherwise.
    for (int i = 0; i < kContactClasses; ++i)
        CHECK(limit.settlingLaw.between(0, i).kc == limit.dosingLaw.between(0, i).kc);
    const Case weak = loadCase(file, {"contact.bond_number=30", "settle.kc_over_k=0.1"});
    for (const ContactParameters& p : test::classesOf(weak.settlingLaw)) CHECK(p.kc == Approx(200));
}

TEST_CASE("the resolved case has the parameters and says what they were made from") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);
    const Case c = loadCase(file, {"contact.restitution=0.5", "contact.restitution_speed=0.02",
                                   "contact.overlap_under_bed=0.004", "contact.bond_number=30"});
    CHECK(c.resolved.find("\nrestitution") == std::string::npos);
    CHECK(c.resolved.find("\nbond_number") == std::string::npos);
    CHECK(c.resolved.find("\noverlap_under_bed") == std::string::npos);
    CHECK_THAT(c.resolved, Catch::Contains("from restitution = 0.5 at 0.02 m/s") &&
                               Catch::Contains("from overlap_under_bed = 0.004") &&
                               Catch::Contains("from bond_number = 30 after a load beyond the plastic limit"));
    REQUIRE(c.derivations.size() == 3);
    CHECK_THAT(c.derivations[1], Catch::StartsWith("contact.wall: k = "));
    CHECK(loadCase(file).derivations.empty());
    CHECK(loadCase(file).resolved.find("derived") == std::string::npos);

    const Case again = loadResolvedCase(c.resolved, file);
    CHECK(again.resolved == c.resolved);
    CHECK(again.derivations == c.derivations);
    for (int i = 0; i < kContactClasses; ++i) {
        CHECK(again.dosingLaw.between(0, i).gamma == c.dosingLaw.between(0, i).gamma);
        CHECK(again.dosingLaw.between(0, i).k1 == c.dosingLaw.between(0, i).k1);
        CHECK(again.settlingLaw.between(0, i).kc == c.settlingLaw.between(0, i).kc);
    }
    CHECK(again.world.timeStep == c.world.timeStep);

    // What is set on top of a resolved case takes its word back.
    const auto resolved = folder.write("resolved.toml", c.resolved);
    const Case set = loadCase(resolved, {"contact.damping=0.01", "contact.wall.restitution=0.7"});
    CHECK(set.dosingLaw.of(kPair).gamma == 0.01);
    CHECK(restitution(set.dosingLaw.of(kAtWall), reducedMass(1427, 1.1e-3, kWall)) == Approx(0.7));
    REQUIRE(set.derivations.size() == 2);
    CHECK_THAT(set.derivations[0], Catch::StartsWith("contact.wall: damping = ") && !Catch::Contains("0.004"));

    // Softening comes after: k falls, and the share of critical damping stays.
    const Case soft =
        loadCase(file, {"contact.restitution=0.5", "contact.soften=4", "contact.overlap_under_bed=0.004"});
    CHECK(soft.dosingLaw.of(kPair).k2Max == Approx(c.dosingLaw.of(kPair).k2Max / 4));
    CHECK(restitution(soft.dosingLaw.of(kPair), reducedMass(1427, 1.1e-3, 1.1e-3)) == Approx(0.5));
    CHECK_THAT(soft.derivations.at(0), Catch::EndsWith("; then softened 4 times"));
    CHECK(loadResolvedCase(soft.resolved, file).resolved == soft.resolved);
}

TEST_CASE("targets that cannot be met are refused with what can be") {
    const std::string both = messageOf(withContact("damping = 0.02", "damping = 0.02\nrestitution = 0.5"));
    CHECK_THAT(both, Catch::Contains(":17: contact.restitution = 0.5: stands beside damping") &&
                         Catch::Contains("give restitution or damping, not both"));
    const std::string fast = messageOf(kGoodCase, {"contact.restitution=0.9", "contact.restitution_speed=0.1"});
    CHECK_THAT(fast, Catch::Contains("contact.restitution = 0.9: no damping reaches it: at 0.1 m/s plasticity and "
                                     "adhesion leave at most 0."));
    CHECK(fast.find("contact.wall") == std::string::npos);  // an inherited target is told once
    // What it says can be reached is reached.
    const std::size_t most = fast.find("give at most ");
    REQUIRE(most != std::string::npos);
    const std::string reachable = fast.substr(most + 13, 5);
    CHECK(messageOf(kGoodCase, {"contact.restitution=" + std::to_string(std::stod(reachable)),
                                "contact.restitution_speed=0.1", "contact.wall.damping=0.02"}) == "");
    CHECK_THAT(messageOf(kGoodCase, {"contact.restitution=0.1", "contact.restitution_speed=1"}),
               Catch::Contains("no damping reaches it: at 1 m/s the two stick"));

    const std::string sticky = messageOf(kGoodCase, {"contact.bond_number=1e6"});
    CHECK_THAT(sticky, Catch::Contains("contact.bond_number = 1e6: no adhesion reaches it: after a load beyond the "
                                       "plastic limit a contact pulls with at most"));
    CHECK_THAT(messageOf(kGoodCase, {"contact.bond_number=10", "contact.bond_load=bed"}),
               Catch::Contains("a smaller plasticity_depth, or bond_load = \"limit\""));
    CHECK_THAT(messageOf(kGoodCase, {"contact.bond_number=10", "contact.k1_over_k=1"}),
               Catch::Contains("with k1_over_k = 1 a contact has no adhesion"));
    CHECK_THAT(messageOf(kGoodCase, {"contact.bond_number=10", "gravity=[0, 0, 0]"}),
               Catch::Contains("nothing has a weight without gravity"));
    CHECK_THAT(messageOf(kGoodCase, {"contact.overlap_under_bed=0.01", "gravity=[0, 9.81, 0]"}),
               Catch::Contains("contact.overlap_under_bed = 0.01: the weight of a bed is known only"));
}

TEST_CASE("a class that states a restitution or a bond alone keeps the speed or the load that it inherits") {
    const Folder folder;
    const auto gammaAtWall = [&](std::vector<std::string> wall) {
        const auto file =
            folder.write("case.toml", withContact("damping = 0.02", "restitution = 0.3\nrestitution_speed = 0.05"));
        wall.emplace_back("contact.kc_over_k=0");
        return loadCase(file, wall).dosingLaw.of(kAtWall).gamma;
    };
    const double inherited = gammaAtWall({"contact.wall.restitution=0.25"});
    CHECK(inherited == gammaAtWall({"contact.wall.restitution=0.25", "contact.wall.restitution_speed=0.05"}));
    CHECK(inherited != Approx(gammaAtWall({"contact.wall.restitution=0.25", "contact.wall.restitution_speed=0"})));

    const auto kcAtWall = [&](const std::vector<std::string>& wall) {
        const auto file =
            folder.write("case.toml", withContact("kc_over_k = 0.5", "bond_number = 0.02\nbond_load = \"bed\""));
        return loadCase(file, wall).dosingLaw.of(kAtWall).kc;
    };
    const double ofBed = kcAtWall({"contact.wall.bond_number=0.01"});
    CHECK(ofBed == kcAtWall({"contact.wall.bond_number=0.01", "contact.wall.bond_load=bed"}));
    CHECK(ofBed != Approx(kcAtWall({"contact.wall.bond_number=0.01", "contact.wall.bond_load=limit"})));
}
