// [settle] and [dose]: what a case gets from their keys, and what is refused.
#include "host/core/error.h"
#include "host/model/case.h"
#include "tests/model/case_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using test::Folder;
using test::kGoodCase;
using test::replaced;

namespace {

Case dosing(const std::string& keys) {
    const Folder folder;
    return loadCase(
        folder.write("case.toml", replaced(kGoodCase, "rotate_s = 0.3\nrest_s = 0.1\n[stop]\n", keys + "[stop]\n")));
}

/// The faults of the case, one a line.
std::string faultsOf(const std::string& keys) {
    try {
        dosing(keys);
    } catch (const CaseError& e) {
        std::string text;
        for (const Diagnostic& d : e.faults()) text += d.text() + "\n";
        return text;
    }
    return "";
}

const std::string kToMass = "mass_g = 0.1\nmax_rotate_s = 2\n";

}  // namespace

TEST_CASE("a dose to a mass has its target, its longest time and its stages") {
    const std::string keys = kToMass + R"(ramp_s = 0.05
reverse_turns = 0.25
max_torque_mNm = 3
at_max_torque = "run"
[[dose.stage]]
speed_rpm = 180
until = 0.6
[[dose.stage]]
speed_rpm = 150
until = 0.9
)";
    const Case c = dosing(keys);
    const Schedule& s = c.schedule;
    CHECK(s.targetMass == Approx(1e-4));
    CHECK(s.rotateTime == 2);
    CHECK(s.rampTime == 0.05);
    CHECK(s.maxTorque == Approx(3e-3));
    CHECK(s.torqueEndsRun);
    REQUIRE(s.stages.size() == 2);
    CHECK(s.stages[0].speed == Approx(6 * kPi));
    CHECK(s.stages[1].until == 0.9);
    CHECK(s.fastestSpeed() == Approx(6 * kPi));
    CHECK(s.reverseTime() == Approx(0.25 / 2 + 0.05));  // at 120 rpm, and a ramp
    CHECK_FALSE(s.isPlain());

    const Case again = loadResolvedCase(c.resolved, "case.toml");
    CHECK(again.resolved == c.resolved);
    CHECK(again.schedule.stages.size() == 2);
    CHECK(again.schedule.targetMass == s.targetMass);
    CHECK(again.schedule.maxTorque == s.maxTorque);
}

TEST_CASE("a case without these keys doses by time as ever") {
    const Folder folder;
    const Schedule s = loadCase(folder.write("case.toml", kGoodCase)).schedule;
    CHECK(s.isPlain());
    CHECK(s.rotateTime == 0.3);
    CHECK(s.reverseTime() == 0);
    CHECK(s.fastestSpeed() == s.coilSpeed);
    CHECK_FALSE(s.untilRest);
}

TEST_CASE("an upper layer's mass replaces a lower one's time, and the other way round") {
    const Folder folder;
    const auto timed = folder.write("timed.toml", kGoodCase);
    const Case mass =
        loadCase(timed, {"dose.mass_g=0.1", "dose.max_rotate_s=2", "dose.stage=[{speed_rpm=200,until=0.5}]"});
    CHECK(mass.schedule.targetMass == Approx(1e-4));
    const auto file = folder.write("mass.toml", mass.resolved);
    const Case back = loadCase(file, {"dose.rotate_s=0.4"});
    CHECK(back.schedule.targetMass == 0);
    CHECK(back.schedule.rotateTime == 0.4);
    CHECK(back.schedule.stages.empty());
}

TEST_CASE("the expected mass of a dose is its target, where the longest time conveys more") {
    const Case timed = dosing("rotate_s = 2\n"), mass = dosing(kToMass),
               ramped = dosing("rotate_s = 2\nramp_s = 0.5\n");
    const double full = derive(timed, insertParticles(timed)).massPerDose;  // four turns
    CHECK(derive(mass, insertParticles(mass)).massPerDose == Approx(1e-4));
    CHECK(derive(mass, insertParticles(mass)).massPerTurn == Approx(full / 4));
    CHECK(derive(ramped, insertParticles(ramped)).massPerDose == Approx(full * 0.75));
    CHECK(derive(mass, insertParticles(mass)).steps < derive(timed, insertParticles(timed)).steps * 9);
}

TEST_CASE("nonsense in [dose] and [settle] is refused by name") {
    using Catch::Contains;
    CHECK(faultsOf(kToMass).empty());
    CHECK_THAT(faultsOf("mass_g = 2\nmax_rotate_s = 2\n"), Contains("dose.mass_g") && Contains("fill of 0.9 g"));
    CHECK_THAT(faultsOf("mass_g = 0.1\n"), Contains("max_rotate_s") && Contains("missing"));
    CHECK_THAT(faultsOf(kToMass + "rotate_s = 1\n"), Contains("dose.rotate_s") && Contains("mass_g"));
    CHECK_THAT(faultsOf("max_rotate_s = 1\nrotate_s = 1\n"), Contains("has no use without mass_g"));
    const auto stages = [](const char* a, const char* b) {
        return faultsOf(kToMass + "[[dose.stage]]\nspeed_rpm = 180\nuntil = " + a +
                        "\n[[dose.stage]]\nspeed_rpm = 150\nuntil = " + b + "\n");
    };
    CHECK_THAT(stages("0.9", "0.6"), Contains("stage[1].until") && Contains("rising"));
    CHECK_THAT(stages("0.5", "0.5"), Contains("stage[1].until"));
    CHECK_THAT(stages("0.5", "1.2"), Contains("stage[1].until") && Contains("beyond the target"));
    CHECK_THAT(faultsOf("rotate_s = 1\n[[dose.stage]]\nspeed_rpm = 9\nuntil = 0.5\n"), Contains("dose.mass_g"));
    CHECK_THAT(faultsOf("rotate_s = 1\nramp_s = 0.6\n"), Contains("dose.ramp_s") && Contains("at most half"));
    CHECK_THAT(faultsOf("rotate_s = 1\nramp_s = 0.4\nreverse_turns = 0.5\n"), Contains("dose.reverse_turns"));
    CHECK_THAT(faultsOf("rotate_s = 0\nreverse_turns = 0.5\nrest_s = 0\n"), Contains("dose.reverse_turns"));
    CHECK_THAT(faultsOf(kToMass + "[[dose.stage]]\nspeed_rpm = 1e7\nuntil = 0.5\n"), Contains("dose.stage"));
    const Folder folder;
    for (const char* wrong : {"until_rest = true\ntime_s = 0", "time_s = 0.15\nrest_speed_ratio = 1"})
        CHECK_THROWS_AS(loadCase(folder.write("case.toml", replaced(kGoodCase, "time_s = 0.15", wrong))), CaseError);
}
