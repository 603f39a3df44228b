// Which members of a study share a bed.
#include "host/study/bed.h"

#include "host/model/case.h"
#include "tests/study/study_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

std::vector<Bed> beds(const std::string& key, const std::string& values, const std::string& set = "") {
    const StudyFolder place;
    std::string text = "base = \"good.toml\"\n[set]\n" + set + "\n";
    for (const std::string line : {"settle.time_s = 0.1\n", "settle.kc_over_k = 0.3\n"})
        if (!line.starts_with(key)) text += line;
    return bedsOf(place.members(text + "[[axis]]\nkey = \"" + key + "\"\nvalues = " + values + "\n"));
}

}  // namespace

TEST_CASE("members share a bed if what differs acts from the first dose on") {
    for (const auto& [key, values] :
         std::vector<std::pair<std::string, std::string>>{{"contact.kc_over_k", "[0.1, 0.2, 0.4]"},
                                                          {"coil.speed_rpm", "[30, 60, 90]"},
                                                          {"dose.rotate_s", "[0.1, 0.2, 0.3]"},
                                                          {"dose.ramp_s", "[0, 0.01, 0.02]"},
                                                          {"stop.max_doses", "[1, 2, 3]"},
                                                          {"bulk_density", "[400, 500, 600]"}}) {
        CAPTURE(key);
        const std::vector<Bed> shared = beds(key, values);
        REQUIRE(shared.size() == 1);
        CHECK(shared[0].number == 0);
        CHECK(shared[0].members == std::vector<int>{0, 1, 2});
        const Case bed = loadResolvedCase(shared[0].caseText, "bed.toml");
        CHECK(bed.schedule.rotateTime == 0);
        CHECK(bed.schedule.settleTime == 0.1);
        CHECK(bed.resolved == shared[0].caseText);
    }
}

TEST_CASE("members share a bed with any number of steps in a contact, and it has their time step") {
    const StudyFolder place;
    for (const char* steps : {"4", "8", "30"}) {
        CAPTURE(steps);
        const std::vector<Member> members =
            place.members(std::string("base = \"good.toml\"\n[set]\nsettle.time_s = 0.1\nsettle.kc_over_k = 0.3\n"
                                      "time.step_s = \"auto\"\ntime.steps_per_contact = ") +
                          steps + "\n[[axis]]\nkey = \"contact.kc_over_k\"\nvalues = [0.1, 0.2]\n");
        const std::vector<Bed> shared = bedsOf(members);
        REQUIRE(shared.size() == 1);
        CHECK(loadResolvedCase(shared[0].caseText, "bed.toml").world.timeStep ==
              loadResolvedCase(members[0].caseText, "case.toml").world.timeStep);
    }
}

TEST_CASE("members do not share a bed if what differs acts while the powder settles") {
    for (const auto& [key, values] :
         std::vector<std::pair<std::string, std::string>>{{"settle.kc_over_k", "[0.1, 0.2]"},
                                                          {"settle.time_s", "[0.1, 0.2]"},
                                                          {"settle.damping_factor", "[1, 2]"},
                                                          {"settle.elastic", "[true, false]"},
                                                          {"settle.gravity_factor", "[0.5, 1]"},
                                                          {"contact.friction", "[0.1, 0.2]"},
                                                          {"contact.wall.friction", "[0.1, 0.2]"},
                                                          {"contact.max_overlap_ratio", "[0.2, 0.3]"},
                                                          {"particles.density", "[1400, 1500]"},
                                                          {"canister.height_mm", "[100, 120]"},
                                                          {"sensors.interval_s", "[0.004, 0.005]"},
                                                          {"time.skin_mm", "[0.3, 0.4]"}}) {
        CAPTURE(key);
        CHECK(beds(key, values).empty());
    }
}

TEST_CASE("a bed is not shared that frames tell of, or that an end time may cut short") {
    CHECK(beds("stop.max_doses", "[1, 2]").size() == 1);
    CHECK(beds("stop.max_doses", "[1, 2]", "frames.interval_s = 0.1").empty());
    CHECK(beds("stop.max_doses", "[1, 2]", "stop.end_time_s = 0.1").empty());
    CHECK(beds("stop.max_doses", "[1, 2]", "stop.end_time_s = 0.2").size() == 1);
}
