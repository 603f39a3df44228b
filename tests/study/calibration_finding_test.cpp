#include "host/study/calibration_file.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "host/core/error.h"
#include "host/study/member.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

Study twoTargets() {
    Study study;
    study.base = "cases/dose.toml";
    CalibrationAim& aim = study.calibration.emplace();
    aim.method = CalibrationAim::Method::Surrogate;
    aim.targets = {{"heap.angle_deg", 24, 0.5, 1, "cases/heap.toml", 0},
                   {kMassPerDose, 3, 0.05, 2, "cases/dose.toml", 0}};
    aim.parameters = {{"contact.friction", 0.1, 0.7}, {"contact.kc_over_k", 0, 1}};
    return study;
}

/// Friction makes the angle; nothing tells the cohesion.
SearchResult twoResults() {
    const double none = std::numeric_limits<double>::quiet_NaN();
    SearchResult r;
    r.points = {{0.2, 0.5}, {0.3, 0.25}};
    r.goals = {{{{20, 0.25}, {24.5, 0.25}}, 24.25, 0.125, {2, 0.75, 1.25, 1.5, 0.875}, {-36, 0.5}},
               {{{4, none}, {none, none}}, 3.5, 0.5, {2, 0.5, 2.5, 3, none}, {8, -0.75}}};
    r.best = 1;
    r.misfit = 0.375;
    r.met = true;
    using Verdict = Confirmed::Verdict;
    r.confirmations = {{0, {{{20.5, 0.25}, 3, Verdict::Missed}, {{none, none}, 0, Verdict::Incomplete}}},
                       {1, {{{24.25, 0.25}, 3, Verdict::Met}, {{3, 0.03125}, 3, Verdict::Met}}}};
    return r;
}

/// The angle is met, the mass per dose is not.
Posterior twoParameters(double correlation = 0.125) {
    Posterior p;
    p.draws = {{0.3, 0.75}, {0.3125, 0.5}, {0.25, 1e-7}};
    p.parameters = {{0.3125, 0.25, 0.375}, {0.5, 0.03125, 0.96875}};
    p.correlation = {{1, correlation}, {correlation, 1}};
    p.figures = {{24.25, 0.25}, {3.5, 0.125}};
    p.sampled = 2048;
    p.steps = 7;
    p.acceptance = 0.3125;
    p.rHat = 1.0625;
    p.effective = 640;
    return p;
}

CalibrationFinding twoFound(double correlation = 0.125) {
    return findingOf(twoTargets(), twoResults(), twoParameters(correlation), {4, 5, 6});
}

}  // namespace

TEST_CASE("a finding: each parameter with the target that tells most of it, and what none tells is not constrained") {
    const CalibrationFinding f = twoFound();
    REQUIRE(f.parameters.size() == 2);
    CHECK(f.parameters[0].mostlyBy == 0);  // by the size of the change, not its sign
    CHECK(f.parameters[0].constrained());
    CHECK(f.parameters[0].change == std::vector<double>{-36, 8});
    CHECK(f.parameters[0].chosen == 0.3);
    CHECK(f.parameters[1].mostlyBy == 1);
    CHECK_FALSE(f.parameters[1].constrained());  // 0.94 of a range of 1
    CHECK(f.parameters[0].fits.low == 0.25);
    CHECK(f.parameters[0].fits.high == 0.375);
    CHECK(f.parameters[1].fits.median == 0.5);
    CHECK(f.targets[0].leaveOneOut.standardised == 1.25);
    CHECK(isReached(f, 0));
    CHECK_FALSE(isReached(f, 1));  // off by 0.5, with errors of 0.05 and 0.125
    CHECK(f.targets[0].name == "heap.angle_deg");
    CHECK(f.targets[0].base == "heap.toml");
    CHECK(f.targets[1].weight == 2);
    CHECK(f.targets[1].believed == 3.5);
}

TEST_CASE("a finding: targets of the same figure are told apart by their cases, and beta is in grams") {
    Study study = twoTargets();
    study.calibration->targets[1].figure = "heap.angle_deg";
    CHECK(findingOf(study, twoResults(), twoParameters(), {4, 5, 6}).targets[1].name == "heap.angle_deg of dose.toml");

    study.calibration->targets.clear();
    study.calibration->target = 3e-3;
    study.calibration->tolerance = 0.125e-3;
    SearchResult r = twoResults();
    r.goals = {{{{4e-3, 0.25e-3}, {3e-3, 0.25e-3}}, 3.25e-3, 0.5e-3, {2, 0.25e-3, 1.25, 1.5, 0.875}, {8, -2}}};
    Posterior p = twoParameters();
    p.figures = {{3.125e-3, 0.0625e-3}};
    r.confirmations = {{1, {{{3e-3, 0.125e-3}, 2, Confirmed::Verdict::Met}}}};
    const CalibrationFinding f = findingOf(study, r, p, {2, 3});
    REQUIRE(f.targets.size() == 1);
    CHECK(f.targets[0].name == "beta");
    CHECK(f.targets[0].unit == "g");
    CHECK(f.targets[0].base == "dose.toml");
    CHECK(f.targets[0].value == Approx(3));
    CHECK(f.targets[0].uncertainty == Approx(0.125));
    CHECK(f.targets[0].believed == Approx(3.25));
    CHECK(f.targets[0].deviation == Approx(0.5));
    CHECK(f.points[0].values[0].value == Approx(4));
    CHECK(f.points[0].values[0].error == Approx(0.25));
    CHECK(f.confirmations[0].figures[0].found.value == Approx(3));
    CHECK(f.confirmations[0].figures[0].found.error == Approx(0.125));
    CHECK(f.targets[0].leaveOneOut.error == Approx(0.25));
    CHECK(f.targets[0].leaveOneOut.standardised == 1.25);
    CHECK(f.fit->figures[0].mean == Approx(3.125));
    CHECK(f.fit->figures[0].deviation == Approx(0.0625));
}

TEST_CASE("a finding: two parameters that only their combination is known of") {
    CHECK(compensations(twoFound(0.5)).empty());
    for (const double correlation : {-0.75, 0.875}) {
        const std::vector<Compensation> both = compensations(twoFound(correlation));
        REQUIRE(both.size() == 1);
        CHECK(both[0].first == 0);
        CHECK(both[0].second == 1);
        CHECK(both[0].correlation == correlation);
        CHECK(findingJson(twoFound(correlation)).at("fit").at("compensations") == nlohmann::json({{0, 1}}));
    }
}

TEST_CASE("a finding: what the runs with new seeds gave at each point that they confirmed or missed") {
    const CalibrationFinding f = twoFound();
    CHECK(f.confirmingSeeds == std::vector<std::uint64_t>{4, 5, 6});
    REQUIRE(f.confirmations.size() == 2);
    CHECK(f.confirmations[0].at == "contact.friction 0.2, contact.kc_over_k 0.5");
    CHECK_FALSE(f.confirmations[0].met);
    CHECK(f.confirmations[0].figures[0].found.value == 20.5);
    CHECK(f.confirmations[1].at == "contact.friction 0.3, contact.kc_over_k 0.25");
    CHECK(f.confirmations[1].met);
    CHECK(f.met);
}

TEST_CASE("a finding of a grid: the chosen point is met by what its confirming runs gave, not by the interpolation") {
    const Sandbox box;
    Study study = twoTargets();
    CalibrationAim& aim = *study.calibration;
    aim.targets.clear();
    aim.parameters.clear();
    aim.method = CalibrationAim::Method::Grid;
    aim.target = 3e-3;
    aim.tolerance = 0.125e-3;
    const std::vector<Setting> point{settingOf(study, "contact.kc_over_k", 0.35)};
    const auto finding = [&](double mean) {
        return findingOf(study, point, aim.target,
                         confirmedBy({mean, mean, mean}, 3, {1e-5, 100}, aim.target, aim.tolerance), {2, 3, 4});
    };
    const CalibrationFinding f = finding(3.5e-3);
    CHECK_FALSE(f.met);
    CHECK(f.targets[0].believed == Approx(3));
    CHECK(f.confirmations[0].at == "contact.kc_over_k 0.35");
    CHECK(f.confirmations[0].figures[0].found.value == Approx(3.5));
    CHECK(finding(3.1e-3).met);
    writeFinding(box.path(), f);
    const auto again = readFinding(box.path());
    REQUIRE(again);
    CHECK(findingJson(*again) == findingJson(f));
}

TEST_CASE("calibration.json holds all of a finding, and a damaged one is refused") {
    const Sandbox box;
    CHECK_FALSE(readFinding(box.path()));
    const CalibrationFinding f = twoFound();
    writeFinding(box.path(), f);
    const auto again = readFinding(box.path());
    REQUIRE(again);
    CHECK(findingJson(*again) == findingJson(f));
    CHECK(again->points[0].values[1].value == 4);
    CHECK(std::isnan(again->points[0].values[1].error));
    CHECK(again->parameters[1].key == "contact.kc_over_k");
    CHECK(again->parameters[1].fits.high == 0.96875);
    CHECK(again->targets[0].leaveOneOut.predictiveR2 == 0.875);
    CHECK(std::isnan(again->targets[1].leaveOneOut.predictiveR2));
    CHECK(again->best == 1);
    REQUIRE(again->fit);
    CHECK(again->fit->draws == f.fit->draws);
    CHECK(again->fit->rHat == 1.0625);
    CHECK(readText(box / kDrawsName) == "contact.friction,contact.kc_over_k\n0.3,0.75\n0.3125,0.5\n0.25,1e-07\n");

    const auto refused = [&](const std::string& text) {
        box.write(kFindingName, text);
        CHECK_THROWS_AS(readFinding(box.path()), CaseError);
    };
    for (const char* bad : {"", "[]", "{", "{}", "7"}) refused(bad);
    for (const char* part :
         {"targets", "parameters", "points", "best", "misfit", "met", "fit", "confirming_seeds", "confirmations"}) {
        auto less = findingJson(f);
        less.erase(part);
        refused(less.dump());
    }
    auto other = findingJson(f);
    other["best"] = 2;  // there are two points
    refused(other.dump());
    other = findingJson(f);
    other["parameters"][0]["mostly_by"] = 2;  // and two targets
    refused(other.dump());
    other = findingJson(f);
    other["parameters"][1]["change_in_uncertainties"].erase(0);
    refused(other.dump());
    other = findingJson(f);
    other["points"][1]["at"].push_back(1);
    refused(other.dump());
    other = findingJson(f);
    other["confirmations"][0]["figures"].erase(0);
    refused(other.dump());
    other = findingJson(f);
    other["fit"] = nullptr;  // a search has one
    refused(other.dump());
    other = findingJson(f);
    other["fit"]["correlation"][1].erase(0);
    refused(other.dump());
    other = findingJson(f);
    other["fit"]["figures"].erase(0);
    refused(other.dump());
    const std::string good = findingJson(f).dump(), draws = readText(box / kDrawsName);
    box.write(kFindingName, good);
    CHECK_NOTHROW(readFinding(box.path()));
    for (const char* bad : {"", "contact.friction\n0.3\n", "contact.friction,contact.kc_over_k\n0.3,\n",
                            "contact.friction,contact.kc_over_k\n0.3,much\n"}) {
        box.write(kDrawsName, bad);
        CHECK_THROWS_AS(readFinding(box.path()), CaseError);
    }
    std::filesystem::remove(box / kDrawsName);
    CHECK_THROWS_AS(readFinding(box.path()), CaseError);
    box.write(kDrawsName, draws);

    forgetFinding(box.path());
    CHECK_FALSE(readFinding(box.path()));
    CHECK_FALSE(std::filesystem::exists(box / kDrawsName));
    forgetFinding(box.path());  // nothing to forget is no fault
}
