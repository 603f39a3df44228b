// Silo, drum and ball of Dosta and others (2024) at reduced size, one setup of each, as `vkdose test validate` runs and
// judges them beside other programs. All setups are run by hand: `vkdose test validate`.

#include <nlohmann/json.hpp>

#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose::test;

namespace {

/// Runs a study of one setup on the bed of the comparison, and requires that every figure agrees with LAMMPS, LIGGGHTS
/// and Yade.
void requireAgreement(const std::string& comparison, const std::string& study, std::size_t figures) {
    const Sandbox box;
    const std::filesystem::path shipped = std::filesystem::path(VKDOSE_SOURCE_DIR) / "cases/validate";
    // A folder cases goes before that of the program.
    std::filesystem::create_directories(box / "cases/validate");
    box.write("cases/validate/" + comparison + ".toml",
              "base = \"" + (shipped / (comparison + "-bed.toml")).string() + "\"\n" + study);
    std::filesystem::copy(shipped / (comparison + "-peers.csv"), box / "cases/validate");

    const auto outcome = box.vkdose("test validate " + comparison + " --jobs 1");
    INFO(outcome.out << outcome.err);
    CHECK(outcome.code == 0);
    const auto told = nlohmann::json::parse(readText(box / "out/validate/validate.json"));
    const auto& findings = told["comparisons"][0]["findings"];
    CHECK(findings.size() == figures);
    for (const auto& finding : findings) {
        INFO(finding.dump());
        CHECK(finding["verdict"] == "agrees");
        for (const char* program : {"LAMMPS", "LIGGGHTS", "Yade"})
            CHECK_THAT(finding["source"].get<std::string>(), Catch::Contains(program));
    }
}

}  // namespace

TEST_CASE("dosta: a silo runs out as in other programs", "[slow]") {
    requireAgreement("dosta-silo",
                     "[[axis]]\nkeys = [\"particles.density\", \"contact.friction\"]\nvalues = [[2500.0, 0.3]]\n"
                     "[[axis]]\nkeys = [\"body.cone.radius_mm\", \"body.cone.length_mm\", \"body.bin.at\"]\n"
                     "values = [[20.0, 20.0, [0, 20e-3, 0]]]\n",
                     1);
}

TEST_CASE("dosta: two powders go round in a drum as in other programs", "[slow]") {
    requireAgreement("dosta-drum", "seeds = 1\n", 6);
}

TEST_CASE("dosta: a ball sinks into a bed as in other programs", "[slow]") {
    // Of seeds 1 to 3 the second is in the middle of what is allowed, so that another packing agrees as well.
    requireAgreement("dosta-ball",
                     "seeds = [2]\n[[axis]]\nkeys = [\"body.ball.motion.velocity\", \"settle.time_s\"]\n"
                     "values = [[[0, -1.0, 0], 0.45]]\n",
                     2);
}
