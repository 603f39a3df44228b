// The suite's comparator, and what it makes of cases that check nothing or break off.

#include "host/verify/finding.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "host/core/error.h"
#include "host/verify/findings_table.h"
#include "host/verify/suite.h"
#include "tests/sim/fake_backend.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::verify;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Check checkOf(double expected, double got, double share, double scale = 0) {
    return {"family/case", "quantity", "m", expected, got, {share, "a reason", scale}};
}

}  // namespace

TEST_CASE("a check passes within its tolerance and fails beyond") {
    CHECK(checkOf(2, 2.0199, 0.01).passes());
    CHECK_FALSE(checkOf(2, 2.0201, 0.01).passes());
    CHECK_FALSE(checkOf(-2, 2, 0.01).passes());
    CHECK(checkOf(0, 1e-9, 1e-3, 1e-6).passes());
    CHECK_FALSE(checkOf(0, 1.1e-9, 1e-3, 1e-6).passes());
    CHECK(checkOf(1, 1, 0).passes());
    CHECK_FALSE(checkOf(1, std::nextafter(1.0, 2.0), 0).passes());
}

TEST_CASE("the worst of several checks is one that is not a number, wherever it stands") {
    const Check good = checkOf(2, 2.002, 0.01), exact = checkOf(2, 2, 0), bad = checkOf(2, kNan, 0.01);
    CHECK(worstShare({good, exact, checkOf(2, 2.01, 0.01)}) == Approx(0.5));
    CHECK(worstShare({exact}) == 0);
    for (const std::vector<Check>& checks : {std::vector{bad, good}, {good, bad, good}, {good, bad}})
        CHECK(worstShare(checks) == kInfinity);
    CHECK(worstShare({checkOf(2, 3, 0)}) == kInfinity);
}

TEST_CASE("what is not a number never passes") {
    for (const double bad : {kNan, kInfinity, -kInfinity}) {
        CHECK_FALSE(checkOf(1, bad, 10).passes());
        CHECK_FALSE(checkOf(bad, 1, 10).passes());
        CHECK_FALSE(checkOf(bad, bad, 10).passes());
        CHECK_FALSE(checkOf(1, 1, bad).passes());
        CHECK_FALSE(checkOf(1, 1, 10, bad).passes());
    }
    CHECK_FALSE(checkOf(0, 0, 1).passes());      // an expected zero has no scale of its own
    CHECK_FALSE(checkOf(1, 1, 1, -1).passes());  // nor is there a negative one
}

TEST_CASE("a case that checks nothing fails, and so does one that breaks off") {
    test::FakeBackend backend;
    const std::vector<Check> nothing = play({"a/b", "", [](Stage&) {}}, backend);
    REQUIRE(nothing.size() == 1);
    CHECK_FALSE(nothing[0].passes());

    const std::vector<Check> broken = play({"a/b", "",
                                            [](Stage& stage) {
                                                stage.check("q", "-", 1, 1, {0, "same"});
                                                throw RunError("particle 3 is gone");
                                            }},
                                           backend);
    REQUIRE(broken.size() == 2);
    CHECK(broken[0].passes());
    CHECK_FALSE(broken[1].passes());
    CHECK(broken[1].tolerance.reason == "particle 3 is gone");
}

TEST_CASE("case names are distinct and can be chosen by a part") {
    std::set<std::string> names;
    for (const Scene& scene : scenes()) CHECK(names.insert(scene.name).second);
    CHECK(scenesNamed("").size() == names.size());
    CHECK(scenesNamed("coil/").size() == 3);
    CHECK(scenesNamed("bed/heap").size() == 1);
    CHECK(scenesNamed("nothing of the kind").empty());
}

TEST_CASE("the tables count failures and say null for what is not a number") {
    const std::vector<Check> checks{checkOf(1, 1, 0.1), checkOf(1, kNan, 0.1), checkOf(1, 2, 0.1)};
    CHECK(failures(checks) == 2);
    const auto json = nlohmann::json::parse(jsonTable(checks, {"a device", 1.5}));
    CHECK(json["backend"] == "a device");
    CHECK(json["checks"] == 3);
    CHECK(json["failures"] == 2);
    CHECK(json["results"][0]["passes"] == true);
    CHECK(json["results"][1]["got"].is_null());
    CHECK(json["results"][1]["passes"] == false);
    const std::string text = markdownTable(checks, {"a device", 1.5});
    CHECK(text.find("1 of 3 known answers met on a device") != std::string::npos);
    CHECK(text.find("FAIL") != std::string::npos);
    CHECK(tableLine(checks[2]).find("FAIL") != std::string::npos);
    CHECK(tableLine(checks[0]).find("a reason") != std::string::npos);
}

TEST_CASE("what is only plausible is counted apart from known answers, and fails like them") {
    test::FakeBackend backend;
    const std::vector<Check> checks = play({"a/b", "",
                                            [](Stage& stage) {
                                                stage.check("known", "-", 1, 1, {0, "same"});
                                                stage.plausible("fair", "-", 1, 1.4, {0.5, "about one"});
                                                stage.plausible("wild", "-", 1, 1.6, {0.5, "about one"});
                                            }},
                                           backend);
    REQUIRE(checks.size() == 3);
    CHECK(failures(checks) == 1);
    CHECK(tally(checks) == "1 of 1 known answers met, 1 of 2 other figures plausible");
    CHECK(tally({checks[0]}) == "1 of 1 known answers met");
    CHECK(tableLine(checks[0]).find(" pass ") != std::string::npos);
    CHECK(tableLine(checks[1]).find(" plausible ") != std::string::npos);
    CHECK(tableLine(checks[2]).find(" FAIL ") != std::string::npos);
    const auto json = nlohmann::json::parse(jsonTable(checks, {"a device", 1.5}));
    CHECK(json["known_answers"] == 1);
    CHECK(json["plausible_figures"] == 2);
    CHECK(json["results"][1]["kind"] == "plausible");
}
