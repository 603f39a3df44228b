// `vkdose test validate` as a user meets it. Its figures and verdicts have their tests in tests/validate.

#include <nlohmann/json.hpp>

#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose::test;

TEST_CASE("validate tells its comparisons, and refuses one that it does not know") {
    const Sandbox box;
    const auto listed = box.vkdose("test validate --list");
    CHECK(listed.code == 0);
    for (const char* name : {"chung-ooi", "beverloo", "anand", "heap", "plane-shear", "ring-shear", "screw",
                             "long-screw", "dosta-silo", "dosta-ball", "dosta-drum"})
        CHECK(listed.out.find(name) != std::string::npos);
    const auto unknown = box.vkdose("test validate beverlo --backend reference");
    CHECK(unknown.code == 2);
    CHECK(unknown.err.find("beverlo not in {chung-ooi,beverloo,") != std::string::npos);
    CHECK(box.files().empty());
}

TEST_CASE("validate plays the published impacts and writes what it prints") {
    const Sandbox box;
    const auto outcome = box.vkdose("test validate chung-ooi --backend reference");
    INFO(outcome.out << outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.out.find("8 agrees") != std::string::npos);
    const auto json = nlohmann::json::parse(readText(box / "out/validate/validate.json"));
    CHECK(json["comparisons"][0]["findings"].size() == 8);
    CHECK(readText(box / "out/validate/validate.md").find("test 8") != std::string::npos);
    CHECK(readText(box / "out/validate/validate.html").find("chung-ooi") != std::string::npos);
}

namespace {

/// A folder cases goes before that of the program: three silos of a few spheres, which run out at once.
void smallBeverloo(const Sandbox& box) {
    std::filesystem::create_directories(box / "cases/validate");
    box.write("cases/validate/beverloo.toml",
              "base = \"small.toml\"\n[[axis]]\nkey = \"body.floor.hole_radius_mm\"\n"
              "values = [6.0, 7.0, 8.0]\n");
    box.write("cases/validate/small.toml",
              "base = \"" VKDOSE_SOURCE_DIR
              "/cases/validate/flat-silo.toml\"\n"
              "[particles]\nmass_g = 0.5\n[settle]\ntime_s = 0.02\n"
              "[measure.settled]\ntime_s = 0.01\n[measure.discharge]\nfrom_s = 0.0\nto_s = 0.02\n");
}

}  // namespace

TEST_CASE("validate runs the study of a comparison, judges it, and finds it done the next time") {
    const Sandbox box;
    smallBeverloo(box);
    const auto outcome = box.vkdose("test validate beverloo --backend reference --jobs 2");
    INFO(outcome.out << outcome.err);
    CHECK(outcome.code == 1);  // nothing has run out: no figure, so it differs
    CHECK(outcome.out.find("3 differs") != std::string::npos);
    CHECK(readText(box / "out/validate/beverloo/members.csv").find("\n1,") != std::string::npos);
    CHECK(readText(box / "out/validate/beverloo.csv").find("chart,curve") == 0);

    const auto summary = box / "out/validate/beverloo/members/0000/summary.json";
    const auto before = std::filesystem::last_write_time(summary);
    CHECK(box.vkdose("test validate beverloo --backend reference --jobs 2").code == 1);
    CHECK(std::filesystem::last_write_time(summary) == before);
}

TEST_CASE("validate --judge judges the runs that have ended, tells how many have not, and begins none") {
    const Sandbox box;
    const auto nothing = box.vkdose("test validate --judge");
    CHECK(nothing.code == 2);
    CHECK(nothing.err.find("has no run of a comparison that has ended") != std::string::npos);
    CHECK(box.files().empty());

    smallBeverloo(box);
    CHECK(box.vkdose("test validate beverloo --backend reference --jobs 2").code == 1);
    // As if the second and the third run had not ended yet.
    const std::string members = readText(box / "out/validate/beverloo/members.csv");
    box.write("out/validate/beverloo/members.csv", members.substr(0, members.find("\n1,") + 1));
    for (const char* member : {"0001", "0002"})
        std::filesystem::remove_all(box / "out/validate/beverloo/members" / member);
    const auto judged = box.vkdose("test validate --judge");  // it needs no device
    INFO(judged.out << judged.err);
    CHECK(judged.code == 0);
    CHECK(judged.out.find("1 of 3 runs") != std::string::npos);
    CHECK(judged.out.find("on reference)") != std::string::npos);
    CHECK(judged.out.find("3 not comparable") != std::string::npos);
    CHECK(judged.out.find("chung-ooi") == std::string::npos);
    CHECK(readText(box / "out/validate/validate.md").find("1 of 3 runs") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(box / "out/validate/beverloo/members/0001"));
}
