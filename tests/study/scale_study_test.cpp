// Which figures depend on the size of the spheres.
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "host/study/scale_study.h"
#include "tests/study/made_up_runs.h"
#include "tests/study/study_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

using Verdict = ScaleFinding::Verdict;

class NoDisplay : public SweepObserver {};

const ScaleAim kAim{{1, 1.5, 2}, 3, 0.05};

/// A sweep of the study whose members have these means of a dose [kg], in the order of their numbers; NaN: none.
ScaleFinding findingWith(const Study& study, const Folder& folder, const std::vector<double>& doses) {
    const std::vector<Member> members = membersOf(study);
    REQUIRE(members.size() == doses.size());
    SweepFolder sweep(folder / "out", study, members);
    MadeUpRuns runs(1);
    NoDisplay display;
    REQUIRE(runMembers(sweep, members, runs, display, [] { return Halt::None; }).whole);
    for (std::size_t m = 0; m < doses.size(); ++m) {
        const nlohmann::json mean = std::isfinite(doses[m]) ? nlohmann::json(doses[m]) : nlohmann::json();
        std::ofstream(sweep.memberFolder(int(m)) / "summary.json")
            << nlohmann::json{{"dose_statistics", {{"mean_kg", mean}}}};
    }
    return scaleFinding(study, kAim, members, sweep, {{"outlet", 0.014}});
}

}  // namespace

TEST_CASE("a difference counts if it is larger than what is allowed and than the seeds explain") {
    CHECK(judgeScale(104, 100, 3, 0.05) == Verdict::Holds);
    CHECK(judgeScale(-104, -100, 3, 0.05) == Verdict::Holds);
    CHECK(judgeScale(104, 100, 6, 0.05) == Verdict::Open);
    CHECK(judgeScale(112, 100, 3, 0.05) == Verdict::Differs);
    CHECK(judgeScale(-112, -100, 3, 0.05) == Verdict::Differs);
    CHECK(judgeScale(106, 100, 4, 0.05) == Verdict::Open);
    CHECK(judgeScale(0, 0, 0, 0.05) == Verdict::Holds);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(judgeScale(nan, 100, 1, 0.05) == Verdict::Open);
    CHECK(judgeScale(100, 100, nan, 0.05) == Verdict::Open);
}

TEST_CASE("the study of a case has larger spheres of the same powder, and contacts that follow") {
    const StudyFolder folder;
    const Study study = scaleStudy(folder / "good.toml", {"stop.max_doses=1"}, kAim);
    const std::vector<Member> members = membersOf(study);
    REQUIRE(members.size() == 9);
    const Case c = loadCase(folder / "good.toml");
    for (std::size_t m = 0; m < members.size(); ++m) {
        const Case member = loadResolvedCase(members[m].caseText, folder / "good.toml");
        const double factor = kAim.factors[m % 3];
        CAPTURE(m, factor);
        CHECK(member.seed == c.seed + m / 3);
        CHECK(member.schedule.stop.maxDoses == 1);
        CHECK(member.filling.size.radiusMin == Approx(factor * c.filling.size.radiusMin));
        CHECK(member.dosingLaw.between(0, 0).k1 == Approx(factor * c.dosingLaw.between(0, 0).k1));
        CHECK(member.dosingLaw.between(0, 0).gamma == Approx(factor * factor * c.dosingLaw.between(0, 0).gamma));
    }
    // What is kept of it is a study with the same members.
    const Study again = readStudy(folder.write("record.toml", study.text));
    const std::vector<Member> same = membersOf(again);
    REQUIRE(same.size() == members.size());
    for (std::size_t m = 0; m < members.size(); ++m) CHECK(same[m].caseText == members[m].caseText);

    const Study unscaled = scaleStudy(folder / "good.toml", {"contact.scaling=none"}, kAim);
    const Case larger = loadResolvedCase(membersOf(unscaled)[2].caseText, folder / "good.toml");
    CHECK(larger.filling.size.radiusMin == Approx(2 * c.filling.size.radiusMin));
    CHECK(larger.dosingLaw.between(0, 0).k1 == Approx(c.dosingLaw.between(0, 0).k1));
}

TEST_CASE("bounds that are sizes of spheres grow with them, and so do all powders") {
    const StudyFolder folder;
    const std::string quantiles =
        "distribution = \"quantiles\"\nscale_up = 10\nd10_um = 180\nd50_um = 200\nd90_um = 230\n";
    const std::string text =
        replaced(kGoodCase, "distribution = \"uniform\"\nradius_min_mm = 0.9\nradius_max_mm = 1.3\n",
                 quantiles + "radius_min_mm = 0.9\n") +
        replaced(kSugar, "radius_mm = 1.0", "radius_mm = 0.1\nscale_up = 10");
    const Study study = scaleStudy(folder.write("two.toml", text), {}, kAim);
    CHECK(study.axes.front().keys == std::vector<std::string>{"particles.size.scale_up", "particles.size.radius_min_mm",
                                                              "powder.sugar.size.scale_up"});
    const Case larger = loadResolvedCase(membersOf(study)[2].caseText, folder / "two.toml");
    CHECK(larger.filling.size.scaleUp == Approx(20));
    CHECK(larger.filling.size.radiusMin == Approx(1.8e-3));
    CHECK(larger.furtherPowders[0].filling.size.radius == Approx(2e-3));
}

TEST_CASE("a case with a list of particles has no sizes to vary") {
    const StudyFolder folder;
    folder.write("two.csv", "x,y,z,r\n0,0,0,0.00125\n0,0.0025000001,0,0.00125\n");
    CHECK_THROWS_WITH(scaleStudy(folder.write("list.toml", kFreeCase), {}, kAim),
                      Catch::Contains("particles.list") && Catch::Contains("do not grow"));
}

TEST_CASE("a figure holds up to the largest size at which it and all smaller sizes agree with the smallest") {
    const StudyFolder folder;
    const Study study = scaleStudy(folder / "good.toml", {}, kAim);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    // 1.5 is as 1 is; 2 is not.
    const ScaleFinding f = findingWith(study, folder, {1.00, 1.01, 1.30, 1.01, 1.00, 1.31, 0.99, 1.02, nan});
    const auto figure =
        std::find_if(f.figures.begin(), f.figures.end(), [](const auto& one) { return one.name == "dose.mean_kg"; });
    REQUIRE(figure != f.figures.end());
    CHECK(f.figures.size() == 1);  // what no run has is not told
    CHECK(figure->at[0].value == Approx(1.0));
    CHECK(figure->at[2].value == Approx(1.305));
    CHECK(figure->verdicts == std::vector{Verdict::Holds, Verdict::Holds, Verdict::Differs});
    CHECK(figure->holds == 1);
    REQUIRE(f.sizes.size() == 3);
    CHECK(f.sizes[1].diameter == Approx(1.5 * 2.2e-3));
    CHECK(f.sizes[1].widths[0] == Approx(0.014 / 3.3e-3));
    CHECK(f.sizes[2].timeStep == Approx(2 * f.sizes[0].timeStep).epsilon(0.01));
    CHECK(f.sizes[2].particles < f.sizes[0].particles / 7);
    const auto json = scaleJson(f);
    CHECK(json["figures"][0]["holds_to_factor"] == 1.5);
    CHECK(json["figures"][0]["at"][2]["verdict"] == "differs");
    CHECK(json["sizes"][1]["widths_in_diameters"]["outlet"].get<double>() == Approx(0.014 / 3.3e-3));
}
