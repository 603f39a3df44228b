// The page about several runs.
#include "host/report/runs_report.h"

#include "host/core/error.h"
#include "tests/report/browser.h"
#include "tests/report/folders.h"

using namespace vkdose;
using namespace vkdose::report;
using namespace vkdose::test;

namespace {

/// Two runs, of which the second has another speed and doses more.
std::vector<std::filesystem::path> twoRuns(const Sandbox& box) {
    const auto slow = writeRun(box, "why", "slow"), fast = writeRun(box, "'</script>'", "fast");
    const Case c = loadCase(VKDOSE_SOURCE_DIR "/cases/mini.toml",
                            {"coil.speed_rpm=150", "particles.mass_g=0.8", "reason='</script>'"});
    box.write("fast/case.toml", c.resolved);
    box.write("fast/doses.csv", dosesTable("1,0.1,0.0025,0.0025,9,0.002,0.002,1\n"));
    return {slow, fast};
}

}  // namespace

TEST_CASE("runs are called by their folders, or by their paths where these are the same") {
    CHECK(runLabels({"out/a", "out/b/"}) == std::vector<std::string>{"a", "b"});
    CHECK(runLabels({"x/a", "y/a"}) == std::vector<std::string>{"x/a", "y/a"});
    CHECK(runLabels({".", "a"}) == std::vector<std::string>{".", "a"});
}

TEST_CASE("cases are compared key by key, those that differ first") {
    const Json keys = comparedCases({"name = 'a'\nseed = 1\n[coil]\nspeed_rpm = 60.0\nhand = 'right'\n",
                                     "name = 'b'\nseed = 1\n[coil]\nspeed_rpm = 90.0\n[domain]\nlow = [0.0, 1, 2]\n"});
    REQUIRE(keys.size() == 4);
    CHECK(keys[0] == Json({{"key", "coil.speed_rpm"}, {"values", {"60.0", "90.0"}}, {"same", false}}));
    CHECK(keys[1] == Json({{"key", "coil.hand"}, {"values", {"\"right\"", ""}}, {"same", false}}));
    CHECK(keys[2]["key"] == "domain.low");
    CHECK(keys[2]["values"][0] == "");
    CHECK(keys[3] == Json({{"key", "seed"}, {"values", {"1", "1"}}, {"same", true}}));
}

TEST_CASE("the data of several runs are those of each, and what their cases differ in") {
    const Sandbox box;
    const auto folders = twoRuns(box);
    const Json data = runsJson(folders);
    CHECK(data["kind"] == "runs");
    CHECK(data["name"] == "slow, fast");
    REQUIRE(data["runs"].size() == 2);
    const Json single = runJson(folders[0], {});
    for (const char* key : {"facts", "doses", "series", "rotations", "filled_mass_kg"})
        CHECK(data["runs"][0][key] == single[key]);
    CHECK_FALSE(data["runs"][0].contains("case"));
    std::vector<std::string> different;
    for (const Json& k : data["keys"])
        if (!k["same"]) different.push_back(k["key"]);
    CHECK(std::count(different.begin(), different.end(), "coil.speed_rpm") == 1);
    CHECK(std::count(different.begin(), different.end(), "particles.mass_g") == 1);
    CHECK(std::count(different.begin(), different.end(), "contact.k") == 0);
    std::filesystem::remove(folders[1] / "doses.csv");
    CHECK_THROWS_AS(runsJson(folders), CaseError);
}

TEST_CASE("a browser draws the page of several runs") {
    if (browserMissing()) return;
    const Sandbox box;
    const std::string dom = drawn(box, runsJson(twoRuns(box)));
    CHECK(dom.find("data-state=\"ready\"") != std::string::npos);
    const std::string shown = dom.substr(dom.find("<main>"), dom.find("<footer>") - dom.find("<main>"));
    CHECK(count(shown, "<figure>") == 6);
    const std::size_t at = shown.find("<h3>Mass per dose");
    const std::string figure = shown.substr(at, shown.find("</figure>", at) - at);
    CHECK(count(figure, "<title>slow:") == 3);
    CHECK(count(figure, "<title>fast:") == 1);
    CHECK(figure.find("closed form, each in its colour") != std::string::npos);
    CHECK(shown.find("<td>coil.speed_rpm</td>") != std::string::npos);
    CHECK(shown.find("keys that are the same in all") != std::string::npos);
    CHECK(shown.find("NaN") == std::string::npos);
    CHECK(shown.find("&lt;/script&gt;") != std::string::npos);  // a case's text, as text
}
