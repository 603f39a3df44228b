// Figures and verdicts of the comparisons of steady flows, a sheared layer, ring shear and screws, from runs whose
// results are made up so that the answer is known.

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "host/validate/comparisons.h"
#include "tests/support/catch.h"
#include "tests/support/folder.h"

using namespace vkdose;
using namespace vkdose::validate;

namespace {

/// A layer that flows with this ratio of stresses and share of the volume at an inertial number, as its field tells it:
/// 1 kPa on spheres of 1 mm and 2500 kg/m3. Belt and lid spoil what is near them, and the first half of the run is not
/// steady.
Run layerRun(const test::Folder& folder, double inertial, double ratio, double fraction) {
    const double rate = inertial / 1e-3 * std::sqrt(1000.0 / 2500), shear = ratio * 1000;
    std::string rows =
        "time_s,y_m,volume_fraction,velocity_x_m_s,kinetic_stress_xx_Pa,kinetic_stress_yy_Pa,kinetic_stress_zz_Pa,"
        "kinetic_stress_xy_Pa,contact_stress_xx_Pa,contact_stress_yy_Pa,contact_stress_zz_Pa,contact_stress_xy_Pa,"
        "contact_stress_yx_Pa\n";
    for (int t = 1; t <= 20; ++t)
        for (int k = 0; k < 20; ++k) {
            const double y = (k + 0.5) * 1e-3, noise = t % 2 == 0 ? 0.98 : 1.02;
            const bool spoilt = t <= 10 || y < 5e-3 || y > 15e-3;
            rows += fmt::format("{},{},{},{},10,20,30,{},1040,980,920,{},{}\n", 0.1 * t, y, spoilt ? 0.1 : fraction,
                                spoilt ? 0 : 1 - rate * y, -0.1 * shear * noise, spoilt ? 0 : -0.8 * shear * noise,
                                spoilt ? 0 : -shear * noise);
        }
    std::filesystem::create_directories(folder.path() / "fields");
    folder.write("fields/profile.csv", rows);
    Run run;
    run.folder = folder.path();
    return run;
}

}  // namespace

TEST_CASE("a sheared layer is judged by the middle of its second half, between the points of another program") {
    const test::Folder folder;
    const Evaluation alone = planeShear({layerRun(folder, 0.1, 0.44, 0.57)}, folder.path());
    REQUIRE(alone.findings.size() == 3);
    CHECK(alone.findings[0].figure == "stress ratio at I = 0.1");
    CHECK(alone.findings[0].got == Approx(0.44));
    CHECK(alone.findings[0].error == Approx(0.44 * 0.02 / 3).epsilon(1e-3));  // ten values
    CHECK(alone.findings[1].low == Approx(0.95 * (0.38 + 0.26 / 3.79)));
    CHECK(alone.findings[1].verdict() == Verdict::Agrees);
    CHECK(alone.findings[2].got == Approx(0.57));
    for (const std::size_t i : {0, 2}) CHECK(alone.findings[i].verdict() == Verdict::NotComparable);
    CHECK(planeShear({layerRun(folder, 0.1, 0.48, 0.57)}, folder.path()).findings[1].verdict() == Verdict::Differs);
    const Run run = layerRun(folder, 0.1, 0.44, 0.57);

    const test::Folder slow;
    const Evaluation slowly = planeShear({layerRun(slow, 0.01, 0.39, 0.59)}, slow.path());
    REQUIRE(slowly.findings.size() == 4);
    CHECK(slowly.findings[3].low == Approx(0.95 * 0.382));
    CHECK(slowly.findings[3].verdict() == Verdict::Agrees);
    CHECK(planeShear({layerRun(slow, 0.01, 0.41, 0.59)}, slow.path()).findings[3].verdict() == Verdict::Differs);

    const auto peers = [&](const char* rows) {
        folder.write("plane-shear-peers.csv",
                     std::string("program,inertial_number,stress_ratio,volume_fraction\n") + rows);
        return planeShear({run}, folder.path());
    };
    // At 0.1 halfway between 0.01 and 1.
    const Evaluation good = peers("A,0.01,0.38,0.59\nA,1,0.48,0.55\n");
    CHECK(good.findings[0].low == Approx(0.95 * 0.43));
    CHECK(good.findings[2].high == Approx(1.01 * 0.57));
    for (const std::size_t i : {0, 2}) CHECK(good.findings[i].verdict() == Verdict::Agrees);
    CHECK(good.charts[0].curves.size() == 3);
    CHECK(good.charts[1].curves.size() == 2);
    const Evaluation other = peers("A,0.01,0.46,0.60\nA,1,0.50,0.57\n");
    for (const std::size_t i : {0, 2}) CHECK(other.findings[i].verdict() == Verdict::Differs);
    for (const std::size_t i : {0, 2})
        CHECK(peers("A,0.2,0.4,0.59\nA,1,0.48,0.55\n").findings[i].verdict() == Verdict::NotComparable);
}

namespace {

/// A turn of a screw with 6, 9 and 12 g in which the rate follows exponents of speed and fill and falls by `steep` of
/// itself over the slope. It is known to 1 %, and what goes through before all powder is in does not count.
std::vector<Run> screws(const test::Folder& folder, double speed, double fill, double steep, double full = 0.8) {
    std::vector<Run> runs;
    const auto add = [&](double grams, double rpm, double slope, double rate) {
        Run run;
        const double angle = slope * kPi / 180;
        run.at = {{"body.screw.motion.speed_rpm", std::to_string(-rpm)},
                  {"gravity", fmt::format("[0, {}, {}]", -9.81 * std::cos(angle), -9.81 * std::sin(angle))}};
        run.summary["ledger"]["filled_mass_kg"] = 1e-3 * grams;
        const std::string name = std::to_string(runs.size());
        run.folder = folder / name;
        std::filesystem::create_directories(run.folder);
        std::string rows = "time_s,through_z_kg\n0,0\n0.35,0\n";
        double mass = 0;
        for (int k = 0; k <= 40; ++k) {
            rows += fmt::format("{},{}\n", 0.7 + 0.01 * k, mass);
            mass += 1e-5 * rate * (1 + 0.01 * std::sqrt(3) * (k / 10 % 2 == 0 ? 1 : -1));  // four quarters
        }
        folder.write(name + "/timeseries.csv", rows);
        runs.push_back(run);
    };
    for (const double rpm : {15.0, 30.0, 60.0, 120.0}) add(6, rpm, 0, 6 * std::pow(rpm / 60, speed));
    for (const double grams : {6.0, 9.0, 12.0})
        for (const double slope : {0.0, 45.0, 90.0})
            add(grams, 600, slope, 10 * std::pow(grams, fill) * (1 - steep * slope / 90));
    add(12, 60, 0, 12 * full);
    return runs;
}

}  // namespace

TEST_CASE("a screw is judged by its exponent of the speed and by the trends of slope and fill") {
    const test::Folder folder;
    const Evaluation good = screw(screws(folder, 1, 0.9, 0.4), "");
    REQUIRE(good.findings.size() == 8);
    CHECK(good.findings[0].got == Approx(1));
    CHECK(good.findings[0].error == Approx(0.01 / std::sqrt(5) / std::log(2)).epsilon(0.02));
    CHECK(good.findings[1].got == Approx(-0.2 * 10 * std::pow(6, 0.9)).epsilon(0.01));
    for (std::size_t i = 0; i < 7; ++i) CHECK(good.findings[i].verdict() == Verdict::Agrees);
    CHECK(good.findings[7].got == Approx(0.8).epsilon(0.01));
    CHECK(good.findings[7].verdict() == Verdict::NotComparable);
    // A blade of 25.1 degrees at 9.5 mm, and a friction of 21.8 degrees.
    CHECK(good.findings[7].low == Approx(0.668).epsilon(0.01));

    CHECK(screw(screws(folder, 0.9, 0.9, 0.4), "").findings[0].verdict() == Verdict::Differs);
    const Evaluation wrong = screw(screws(folder, 1, -0.1, -0.4), "");
    for (std::size_t i = 1; i < 7; ++i) CHECK(wrong.findings[i].verdict() == Verdict::Differs);
    // A rate that falls and then grows again does not only fall; nor does one that is not known.
    std::vector<Run> bent = screws(folder, 1, 0.9, 0.4);
    std::swap(bent[5].folder, bent[6].folder);
    CHECK(screw(bent, "").findings[1].verdict() == Verdict::Differs);
    for (const char* run : {"4", "5", "6"}) {
        const std::vector<Run> unknown = screws(folder, 1, 0.9, 0.4);
        folder.write(std::string(run) + "/timeseries.csv", "time_s,through_z_kg\n0,0\n1,0\n");
        CHECK(screw(unknown, "").findings[1].verdict() == Verdict::Differs);
    }
}

TEST_CASE("beads in a ring shear cell are judged by the angle that a tester measured") {
    const auto runOf = [](double steady) {
        Run run;
        run.summary["measures"]["ring-shear"] = {{"pre_shear_stress_Pa", 2000 * std::tan(steady * kPi / 180)},
                                                 {"pre_shear_normal_stress_Pa", 2000}};
        return run;
    };
    const Evaluation good = ringShear({runOf(22), runOf(23)}, "");
    REQUIRE(good.findings.size() == 1);
    CHECK(good.findings[0].got == Approx(22.5));
    CHECK(good.findings[0].error == Approx(0.5));
    CHECK(good.findings[0].verdict() == Verdict::Agrees);
    CHECK(ringShear({runOf(21.4)}, "").findings[0].verdict() == Verdict::Differs);
    CHECK(ringShear({Run()}, "").findings[0].verdict() == Verdict::Differs);
}

TEST_CASE("a long screw is judged by one turn that repeats") {
    const test::Folder turn, end;
    const auto runOf = [](const test::Folder& folder, const char* periodic, const char* column, double rate) {
        std::string rows = fmt::format("time_s,{}\n", column);
        for (int i = 0; i <= 30; ++i)
            rows += fmt::format("{},{}\n", 0.1 * i, i < 10 ? 0.001 * i * i : 0.1 + 1e-4 * rate * (i - 10));
        folder.write("timeseries.csv", rows);
        Run run;
        run.folder = folder.path();
        run.at = {{"domain.periodic", periodic}};
        return run;
    };
    const Run slice = runOf(turn, "z", "through_z_kg", 5.5);
    const Evaluation good = longScrew({slice, runOf(end, "none", "end.mass_kg", 5.6)}, "");
    REQUIRE(good.findings.size() == 1);
    CHECK(good.findings[0].got == Approx(5.6));
    CHECK(good.findings[0].low == Approx(0.97 * 5.5));
    CHECK(good.findings[0].verdict() == Verdict::Agrees);
    CHECK(longScrew({slice, runOf(end, "none", "end.mass_kg", 5.7)}, "").findings[0].verdict() == Verdict::Differs);
    CHECK(longScrew({slice}, "").findings[0].verdict() == Verdict::Differs);  // the long one did not end
}
