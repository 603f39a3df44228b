// The table [calibrate]: targets, measured files, and what can be wrong with them.
#include <algorithm>
#include <cmath>

#include "host/study/trials.h"
#include "tests/study/study_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

std::string withAim(const std::string& aim) {
    return kGoodStudy + "[calibrate]\n" + aim;
}

}  // namespace

TEST_CASE("a calibration's target is given, in grams a dose") {
    const StudyFolder folder;
    const Study study = folder.study(withAim("target_g_per_dose = 3.7\ntolerance_g = 0.05\n"));
    REQUIRE(study.calibration);
    CHECK(study.calibration->method == CalibrationAim::Method::Grid);
    CHECK(study.calibration->target == Approx(3.7e-3).epsilon(1e-12));  // a unit's rounding
    CHECK(study.calibration->tolerance == Approx(0.05e-3).epsilon(1e-12));
    CHECK(study.calibration->along == "contact.kc_over_k");
    CHECK(study.keys().size() == 3);
}

TEST_CASE("a balance's file gives the target: the slope before saturation, with its error for a tolerance") {
    const StudyFolder folder;
    // Five doses of 2 g, alternately 0.1 g more and less, then next to nothing: the slope is that of the first ones.
    folder.write("mass.csv", "dose,mass_g\n1,2.1\n2,1.9\n3,2.1\n4,1.9\n5,2.0\n6,0.5\n7,0.1\n8,0.0");
    folder.write("sum.csv", "cumulative_g,dose\n2.1,1\n4.0,2\n6.1,3\n8.0,4\n10.0,5\n10.5,6\n10.6,7\n10.6,8\n");
    for (const std::string file : {"mass.csv", "sum.csv"}) {
        const Study study = folder.study(withAim("measured = \"" + file + "\"\n"));
        CAPTURE(file);
        // Four doses are below 80 % of 10.6 g: 2.1, 4.0, 6.1, 8.0; their least-squares slope is 1.98 g.
        CHECK(study.calibration->target == Approx(1.98e-3).epsilon(1e-9));  // rounding of the sums
        CHECK(study.calibration->tolerance > 0);
        CHECK(study.calibration->tolerance < 0.2e-3);
    }
    const Study study = folder.study(withAim("measured = \"mass.csv\"\ntolerance_g = 0.3\n"));
    CHECK(study.calibration->tolerance == Approx(0.3e-3).epsilon(1e-12));
    folder.write("equal.csv", "dose,mass_g\n1,0.1\n2,0.1\n3,0.1\n4,0.1\n5,0.1\n6,0.1\n7,0.1\n");
    CHECK_THROWS_WITH(folder.study(withAim("measured = \"equal.csv\"\n")), Catch::Contains("calibrate.tolerance_g"));
    CHECK_NOTHROW(folder.study(withAim("measured = \"equal.csv\"\ntolerance_g = 0.01\n")));
}

TEST_CASE("a search has free parameters for keys") {
    const StudyFolder folder;
    const Study study = folder.study(
        "base = \"good.toml\"\n[calibrate]\nmethod = \"surrogate\"\ntarget_g_per_dose = 3.7\ntolerance_g = 0.05\n"
        "max_runs = 12\n[[calibrate.parameter]]\nkey = \"contact.friction\"\nlow = 0.1\nhigh = 0.6\n");
    CHECK(study.calibration->maxRuns == 12);
    REQUIRE(study.calibration->parameters.size() == 1);
    CHECK(study.calibration->parameters[0].high == 0.6);
    CHECK(study.keys() == std::vector<std::string>{"contact.friction"});
    CHECK(study.calibration->firstPoints == 0);
}

TEST_CASE("a search may have several targets, each with its own case") {
    const StudyFolder folder;
    folder.write("heap.toml", kGoodCase);
    const Study study = folder.study(
        "base = \"good.toml\"\n[calibrate]\nmethod = \"surrogate\"\n[[calibrate.target]]\nfigure = "
        "\"mass_per_dose_g\"\nvalue = 3.7\nuncertainty = 0.05\n[[calibrate.target]]\nfigure = \"heap.angle_deg\"\n"
        "value = 33\nuncertainty = 1\nweight = 2\nbase = \"heap.toml\"\n[[calibrate.parameter]]\nkey = "
        "\"contact.friction\"\nlow = 0.1\nhigh = 0.6\n");
    const std::vector<CalibrationTarget>& targets = study.calibration->targets;
    REQUIRE(targets.size() == 2);
    CHECK(targets[0].figure == kMassPerDose);
    CHECK(targets[0].weight == 1);
    CHECK(targets[0].base.filename() == "good.toml");
    CHECK(targets[1].value == 33);
    CHECK(targets[1].weight == 2);
    CHECK(targets[1].base.filename() == "heap.toml");
    CHECK(study.calibration->bases().size() == 2);
    CHECK(study.keys() == std::vector<std::string>{"contact.friction", "base"});
    const Member member = memberAt(study, 0, std::nullopt, {}, targets[1].base);
    CHECK(member.values == std::vector<std::string>{"heap.toml"});
}

TEST_CASE("every fault of a calibration names its key and a remedy") {
    const StudyFolder folder;
    folder.write("short.csv", "dose,mass_g\n1,2\n2,2\n");
    folder.write("gap.csv", "dose,mass_g\n1,2\n3,2\n");
    folder.write("word.csv", "dose,mass_g\n1,2\n2,two\n");
    folder.write("head.csv", "n,m\n1,2\n");
    const std::string search =
        "method = \"surrogate\"\ntarget_g_per_dose = 3.7\ntolerance_g = 0.05\n[[calibrate.parameter]]\n";
    const std::string target = "[[calibrate.target]]\n";
    struct Fault {
        std::string aim, key, says;
    };
    for (const Fault& row : std::vector<Fault>{
             {"tolerance_g = 0.05\n", "calibrate.target_g_per_dose", "is missing"},
             {"target_g_per_dose = 3.7\n", "calibrate.tolerance_g", "is missing"},
             {"target_g_per_dose = -1\ntolerance_g = 0.05\n", "calibrate.target_g_per_dose", "is negative"},
             {"targt_g_per_dose = 3.7\ntolerance_g = 0.05\n", "calibrate.targt_g_per_dose",
              "did you mean target_g_per_dose?"},
             {"target_g_per_dose = 3.7\nmeasured = \"short.csv\"\n", "calibrate.target_g_per_dose", "not both"},
             {"measured = \"none.csv\"\n", "calibrate.measured", "there is no file"},
             {"measured = \"short.csv\"\n", "calibrate.measured", "too few doses"},
             {"measured = \"gap.csv\"\n", "calibrate.measured", "gap.csv:3: dose = 3: dose 2 should come here"},
             {"measured = \"word.csv\"\n", "calibrate.measured", "word.csv:3: mass_g = two: is not a number"},
             {"measured = \"head.csv\"\n", "calibrate.measured", "head.csv:1: the header is not"},
             {"method = \"random\"\ntarget_g_per_dose = 3.7\ntolerance_g = 0.05\n", "calibrate.method",
              "grid, surrogate"},
             {"target_g_per_dose = 3.7\ntolerance_g = 0.05\nalong = \"coil.turns\"\n", "calibrate.along",
              "no axis has coil.turns alone"},
             {search + "key = \"contact.damping\"\nlow = 0.1\nhigh = 0.2\n", "calibrate.method",
              "a search has no axes"},
             {search + "key = \"coil.turns\"\nlow = 2\nhigh = 3\n", "calibrate.parameter[0].key",
              "coil.turns is given twice"},
             {"max_runs = 9\nfirst_points = 10\n" + search + "key = \"contact.damping\"\nlow = 0.1\nhigh = 0.2\n",
              "calibrate.first_points", "is more than max_runs"},
             {search + "key = \"contact.damping\"\nlow = 0.2\nhigh = 0.2\n", "calibrate.parameter[0].high",
              "is not above low"},
             {"method = \"surrogate\"\ntarget_g_per_dose = 3.7\ntolerance_g = 0.05\n", "calibrate.parameter",
              "one to four"},
             {target + "figure = \"mass_per_dose_g\"\nvalue = 3.7\nuncertainty = 0.05\n", "calibrate.target",
              "a grid meets a mass per dose alone"},
             {"tolerance_g = 0.05\n" + target, "calibrate.tolerance_g", "stands beside [[calibrate.target]]"},
             {target + "figure = \"angle\"\n", "calibrate.target[0].figure", "is no figure of a run"},
             {target + "figure = \"heap.angle_deg\"\n", "calibrate.target[0].value", "is missing"},
             {target + "uncertainty = 0\n", "calibrate.target[0].uncertainty", "is zero"},
             {target + "weight = -1\n", "calibrate.target[0].weight", "is negative"},
             {target + "base = \"none.toml\"\n", "calibrate.target[0].base", "there is no file"},
             {target + "axes = 1\n", "calibrate.target[0].axes", "unknown key"},
         }) {
        const auto faults = faultsOf(folder, withAim(row.aim));
        CAPTURE(row.aim, row.says);
        const auto told = std::find_if(faults.begin(), faults.end(), [&](const Diagnostic& d) {
            return d.text().find(row.says) != std::string::npos;
        });
        REQUIRE(told != faults.end());
        CHECK(told->key == row.key);
    }
}

TEST_CASE("a design has goals, each with a wish or a bound") {
    const StudyFolder folder;
    const std::string free = "[[design.parameter]]\nkey = \"coil.pitch_mm\"\nlow = 2\nhigh = 4\n";
    const std::string goals =
        "base = \"good.toml\"\n[design]\nmax_runs = 12\n[[design.goal]]\nfigure = \"dose.mean_kg\"\nwish = "
        "\"largest\"\n"
        "[[design.goal]]\nfigure = \"coil.largest_torque_Nm\"\nat_most = 0.1\n";
    const Study study = folder.study(goals + free);
    REQUIRE(study.calibration);
    const CalibrationAim& aim = *study.calibration;
    CHECK(aim.method == CalibrationAim::Method::Design);
    CHECK(aim.maxRuns == 12);
    CHECK(aim.confirmingSeeds == 3);
    REQUIRE(aim.targets.size() == 2);
    CHECK(aim.targets[0].wish == CalibrationTarget::Wish::Largest);
    CHECK(std::isinf(aim.targets[0].atMost));
    CHECK(aim.targets[1].wish == CalibrationTarget::Wish::None);
    CHECK(aim.targets[1].atMost == 0.1);
    CHECK(study.keys() == std::vector<std::string>{"coil.pitch_mm"});

    const auto refused = [&](const std::string& text, const std::string& said) {
        CAPTURE(text);
        CHECK_THROWS_WITH(folder.study(text), Catch::Contains(said));
    };
    const auto with = [&](const std::string& part, const std::string& by) {
        std::string text = goals + free;
        return text.replace(text.find(part), part.size(), by);
    };
    refused(goals, "design.parameter");
    refused(with("wish = \"largest\"\n", "at_least = 1\n"), "wishes at least one");
    refused(with("at_most = 0.1\n", ""), "design.goal[1].wish");
    refused(with("at_most = 0.1", "at_most = 0.1\nat_least = 0.2"), "is below at_least");
    refused(with("\"largest\"", "\"most\""), "design.goal[0].wish");
    refused(with("\"dose.mean_kg\"", "\"mean\""), "is no figure of a run");
    refused(goals + free + "[[axis]]\nkey = \"contact.friction\"\nvalues = [0.1, 0.2]\n", "a search has no axes");
    refused(goals + free + "[calibrate]\ntarget_g_per_dose = 1\ntolerance_g = 1\n", "stands beside [calibrate]");
    refused(with("\"coil.pitch_mm\"", "\"seed\""), "design.parameter[0].key");
}

TEST_CASE("a target may name each figure that the run of its case has") {
    const std::vector<std::string> ring = figureNames(loadCase(VKDOSE_SOURCE_DIR "/cases/elements/ring-shear.toml"));
    const std::vector<std::string> mini = figureNames(loadCase(VKDOSE_SOURCE_DIR "/cases/mini.toml"));
    const auto has = [](const std::vector<std::string>& names, const std::string& name) {
        return std::count(names.begin(), names.end(), name) == 1;
    };
    for (const char* name : {"mass_per_dose_g", "dose.rsd", "dose.left_kg", "rate.steady_kg_s", "cycle.steady_kg",
                             "coil.largest_torque_Nm"})
        CHECK(has(mini, name));
    CHECK_FALSE(has(mini, "coil.rsd"));
    for (const char* name : {"ring-shear.friction_angle_deg", "ring-shear.ffc", "ring-shear.unconfined_strength_Pa"})
        CHECK(has(ring, name));
    const std::vector<std::string> hopper = figureNames(loadCase(VKDOSE_SOURCE_DIR "/cases/validate/slot-hopper.toml"));
    for (const char* name : {"pan.mass_kg", "pan.content_kg", "pan.largest_content_kg", "gate.largest_force_N"})
        CHECK(has(hopper, name));
    const std::vector<std::string> walls =
        figureNames(loadCase(VKDOSE_SOURCE_DIR "/cases/mini.toml", {"sensors.wall_loads=true"}));
    CHECK(has(walls, "front.largest_force_N"));
}
