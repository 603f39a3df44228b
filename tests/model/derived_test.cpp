#include <algorithm>
#include <cmath>
#include <limits>

#include "host/core/error.h"
#include "host/model/case.h"
#include "host/model/size_distribution.h"
#include "host/model/stability.h"
#include "tests/model/case_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using test::Folder;
using test::kGoodCase;
using test::shippedCase;

TEST_CASE("contact durations of the paper") {
    const Case c = loadCase(shippedCase("paper-48g.toml"));
    const ContactParameters& p = c.dosingLaw.of(ContactClass::ParticleParticle);
    // Printed: 1.1297e-4 s. The table's k1 and gamma are rounded to 0.2 %, so t_c may differ by half as much.
    CHECK(contactDuration(p, reducedMass(1427, 1.25e-3, 1.25e-3), p.k1) == Approx(1.1297e-4).epsilon(1e-3));
    // Against a wall the reduced mass doubles. By hand: m = 1.167458e-5 kg, k1/m = 4.12298e8, (gamma/2m)^2 = 1.25449e7.
    const double wall = contactDuration(p, sphereMass(1427, 1.25e-3), p.k1);
    CHECK(wall == Approx(kPi / std::sqrt(4.12298e8 - 1.25449e7)).epsilon(1e-5));
    ContactParameters overdamped = p;
    overdamped.gamma = 10;
    CHECK(std::isinf(contactDuration(overdamped, reducedMass(1427, 1.25e-3, 1.25e-3), p.k1)));
}

TEST_CASE("predictions for the paper's case") {
    const Case c = loadCase(shippedCase("paper-48g.toml"));
    const Insertion filled = insertParticles(c);
    const Derived d = derive(c, filled);
    CHECK(d.pushVelocity == Approx(13.125e-3).epsilon(1e-12));
    CHECK(d.tipVelocity == Approx(98.0e-3).epsilon(1e-3));
    CHECK(d.massPerDose == Approx(4.20e-3).epsilon(1e-3));
    CHECK(d.doses == Approx(filled.mass / d.massPerDose));
    CHECK(d.doses == Approx(11.43).epsilon(1e-3));
    CHECK(d.particles == filled.particles.size());
    CHECK(d.timeStep == 2.26e-6);
    REQUIRE(d.durations.size() == 3);
    CHECK(d.durations[0].name == "particle-particle");
    CHECK(d.durations[0].mean == Approx(1.1297e-4).epsilon(1e-3));
    CHECK(d.durations[0].stiffest == Approx(1.73e-5).epsilon(1e-3));
    CHECK(d.durations[1].stiffest == Approx(std::sqrt(2.0) * d.durations[0].stiffest));
    CHECK(d.stiffest == d.durations[0].stiffest);
    // 2 s, then 12 predicted doses and 3 for the stop rule, 2.5 s each
    CHECK(d.steps == Approx((2 + 15 * 2.5) / 2.26e-6).epsilon(1e-6));
}

TEST_CASE("the work of a run counts what is added, where it is known when") {
    const Folder folder;
    const auto workOf = [&](const std::string& refill) {
        // A coil that stands, so that nothing leaves.
        const Case c = loadCase(folder.write("case.toml", std::string(kGoodCase) + refill),
                                {"coil.speed_rpm=0", "stop.max_doses=3"});
        const Insertion filled = insertParticles(c);
        const Derived d = derive(c, filled);
        const double added = filled.waiting.empty() ? 0 : double(filled.waiting[0].particles.size());
        CHECK((refill.empty() || added > 0));
        return std::pair((d.work - d.steps * double(d.particles)) / std::max(added, 1.0), d);
    };
    CHECK(workOf("").first == 0);
    const auto [timed, d] = workOf("[[refill]]\nname = \"more\"\nmass_g = 2\ntime_s = 0.1\n");
    REQUIRE(d.steps * d.timeStep > 0.1);
    CHECK(timed == Approx(d.steps - 0.1 / d.timeStep));
    const double dosed = workOf("[[refill]]\nname = \"more\"\nmass_g = 2\nbefore_dose = 2\n").first;
    CHECK((dosed > 0 && dosed < d.steps));
    CHECK(workOf("[[refill]]\nname = \"more\"\nmass_g = 2\nbelow_g = 1\n").first == 0);
}

TEST_CASE("the work of a run leaves out what leaves the device by the closed form") {
    const Folder folder;
    const auto derivedOf = [](const Case& c) { return derive(c, insertParticles(c)); };
    const auto file = folder.write("case.toml", kGoodCase);
    // A coil that empties the canister in doses of 2.5 s after a settling of 2 s: half of it is there then on average.
    const Derived paper = derivedOf(loadCase(shippedCase("paper-48g.toml")));
    const double all = 2 + 2.5 * paper.doses / 2;
    CHECK(paper.work * paper.timeStep / double(paper.particles) == Approx(all).epsilon(1e-3));
    CHECK(paper.countsLeaving);
    // A hopper that is topped up at its mark holds its powder, and nobody knows how much of it.
    const Derived full = derivedOf(loadCase(shippedCase("devices/loss-in-weight.toml")));
    CHECK(full.work == full.steps * double(full.particles));
    CHECK_FALSE(full.countsLeaving);
    // Without a closed form nobody knows how fast it leaves.
    const Derived still = derivedOf(loadCase(file, {"coil.speed_rpm=0", "stop.max_doses=2"}));
    CHECK(still.work == still.steps * double(still.particles));
    CHECK_FALSE(still.countsLeaving);
    // A run without doses: a belt tells no rate, a screw that turns by itself does, from when it turns.
    const Derived belt = derivedOf(loadCase(shippedCase("devices/belt-feeder.toml")));
    CHECK(belt.work == belt.steps * double(belt.particles));
    CHECK_FALSE(belt.countsLeaving);
    Case c = loadCase(shippedCase("auger.toml"));
    c.schedule.rotateTime = 0;
    c.schedule.settleTime = 2;
    for (RigidBody& body : c.world.bodies)
        if (body.name == "screw") {
            body.clock = Clock::Time;
            std::get<geometry::Turn>(body.course.motion).rate = -2 * kPi;
            body.course.schedule.intervals = {{0.5, geometry::kEndless}};
        }
    const Derived screw = derivedOf(c);
    REQUIRE(screw.massPerSecond > 0);
    REQUIRE(screw.massPerSecond * 1.5 < screw.fillMass);
    const double spared = (2 - screw.work * screw.timeStep / double(screw.particles)) * screw.fillMass;  // [kg s]
    CHECK(spared == Approx(screw.massPerSecond * 1.5 * 1.5 / 2).epsilon(1e-3));
    CHECK(screw.countsLeaving);
}

TEST_CASE("the wide coil pushes twice as fast and doses twice as much") {
    const Case narrow = loadCase(shippedCase("paper-48g.toml"));
    const Case wide = loadCase(shippedCase("paper-48g-wide.toml"));
    const Derived a = derive(narrow, insertParticles(narrow));
    const Derived b = derive(wide, insertParticles(wide));
    CHECK(b.pushVelocity == Approx(2 * a.pushVelocity));
    CHECK(b.massPerDose == Approx(2 * a.massPerDose));
}

TEST_CASE("a run is as long as its limits allow") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);
    const auto duration = [&](const std::vector<std::string>& overrides) {
        const Case c = loadCase(file, overrides);
        return derive(c, insertParticles(c)).steps * c.world.timeStep;
    };
    CHECK(duration({"stop.max_doses=2"}) == Approx(0.15 + 2 * 0.4).epsilon(1e-4));
    CHECK(duration({"stop.end_time_s=0.5"}) == Approx(0.5).epsilon(1e-4));
    // Without a closed form too: a coil that stands.
    CHECK(duration({"coil.speed_rpm=0", "stop.max_doses=2"}) == Approx(0.15 + 2 * 0.4).epsilon(1e-4));
    CHECK(duration({"coil.speed_rpm=0", "stop.end_time_s=0.5"}) == Approx(0.5).epsilon(1e-4));
    CHECK(duration({"dose.rotate_s=0", "dose.rest_s=0", "stop.rule=none"}) == Approx(0.15).epsilon(1e-4));
}

TEST_CASE("the automatic time step resolves the stiffest contact") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);
    const Case c = loadCase(file);
    const Derived d = derive(c, insertParticles(c));
    // 1/8 of the normal mode, rounded down to three digits
    CHECK(c.world.timeStep <= d.stiffest / 8);
    CHECK(c.world.timeStep > d.stiffest / 8 * 0.989);
    // Four times the sliding stiffness is the stiffer motion: half the normal mode's time, of which a sixth.
    const Case sliding = loadCase(file, {"contact.kt_over_k=1.142857"});
    CHECK(sliding.world.timeStep == Approx(d.stiffest / 2 / 6).epsilon(0.011));
}

TEST_CASE("the number of steps in the fastest motion of a contact is the case's choice, within what is stable") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);
    const auto derived = [&](const std::vector<std::string>& overrides, const std::filesystem::path& from) {
        const Case c = loadCase(from, overrides);
        return derive(c, insertParticles(c));
    };
    const auto fastest = [](const std::filesystem::path& from) {
        const Case c = loadCase(from, {});
        const std::vector<ContactMode> modes = modesOf(c, powderSizes(c));
        return *std::min_element(modes.begin(), modes.end(),
                                 [](const ContactMode& a, const ContactMode& b) { return a.duration < b.duration; });
    };
    const ContactMode soft = fastest(file);
    for (const double steps : {4.0, 6.0, 20.0}) {
        const Derived d = derived({"time.steps_per_contact=" + std::to_string(steps)}, file);
        CAPTURE(steps, soft.name);
        // Cut to three digits. In this soft case no damping is faster.
        CHECK(d.timeStep <= soft.duration / steps);
        CHECK(d.timeStep > 0.989 * soft.duration / steps);
    }
    // In the paper's case rolling against a wall is faster than any normal contact, and with four steps in it the
    // dashpot of rolling, half of whose time is 3.09e-6 s, decides. A step that the base states gives way.
    const Derived paper = derived({"time.steps_per_contact=4"}, shippedCase("paper-48g.toml"));
    const ContactMode rolling = fastest(shippedCase("paper-48g.toml"));
    CHECK_THAT(rolling.name, Catch::EndsWith(" rolling"));
    CHECK(rolling.duration == Approx(1.45e-5).epsilon(0.005));
    CHECK(paper.timeStep == Approx(3.08e-6).epsilon(0.01));
    CHECK(derived({"time.steps_per_contact=6"}, shippedCase("paper-48g.toml")).timeStep ==
          Approx(1.45e-5 / 6).epsilon(0.01));
    // A resolved case with a step of this kind is read again as it is.
    const Case four = loadCase(file, {"time.steps_per_contact=4"});
    CHECK(loadResolvedCase(four.resolved, file).world.timeStep == four.world.timeStep);

    const auto refused = [&](const std::vector<std::string>& overrides) {
        try {
            loadCase(file, overrides);
        } catch (const CaseError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK_THAT(refused({"time.steps_per_contact=3.9"}),
               Catch::Contains("time.steps_per_contact = 3.9: is unstable") && Catch::Contains("give at least 4"));
    // Both stated in one file: the step is held against the number.
    const Folder other;
    const auto both = [&](double part, double steps) {
        const double step = soft.duration * part;
        const auto stated = other.write("case.toml", kGoodCase + "[time]\nstep_s = " + std::to_string(step * 1e9) +
                                                         "e-9\nsteps_per_contact = " + std::to_string(steps) + "\n");
        try {
            loadCase(stated);
        } catch (const CaseError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(both(1 / 4.1, 4) == "");
    CHECK_THAT(both(1 / 3.9, 4), Catch::Contains("time.step_s") && Catch::Contains("is unstable"));
    CHECK_THAT(both(1 / 7.9, 8), Catch::Contains("time.step_s") && Catch::Contains("more than 1/8 of it"));
}

TEST_CASE("contact modes: sliding of a full sphere has 2/7 of its mass") {
    World world;
    world.density() = 1000;
    ContactLaw law;
    ContactParameters& p = law.of(ContactClass::ParticleParticle);
    p.k1 = 1000;
    p.k2Max = 7000;
    p.kt = 2000;
    p.mu = 0.5;
    p.kr = 1000;
    p.muR = 0.1;
    const auto modes = contactModes(world, law, {{1e-3, 1e-3, 1e-3}});
    REQUIRE(modes.size() == 3);
    const double mass = 1000 * 4.0 / 3.0 * kPi * 1e-9;
    CHECK(modes[0].duration == Approx(kPi * std::sqrt(mass / 2 / 7000)));
    CHECK(modes[1].duration == Approx(modes[0].duration));
    // torque a_r^2 kr with a_r = 2 a on inertia 0.4 m a^2: rate^2 = 10 kr/m
    CHECK(modes[2].duration == Approx(kPi * std::sqrt(mass / 10 / 1000)));
    law.rollingLever = RollingLever::Half;
    CHECK(contactModes(world, law, {{1e-3, 1e-3, 1e-3}})[2].duration == Approx(2 * modes[2].duration));
}
