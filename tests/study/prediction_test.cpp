// Runs with draws of a powder, and the intervals of their figures.
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/core/random.h"
#include "host/core/vec.h"
#include "host/study/normal_distribution.h"
#include "host/study/posterior.h"
#include "host/study/prediction.h"
#include "host/study/seed_scatter.h"
#include "tests/study/made_up_runs.h"
#include "tests/study/study_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

const char* kDraws = "contact.friction,coil.speed_rpm\n0.31,100\n0.42,110\n0.5,120\n0.55,130\n";

/// Of the standard normal distribution (Box and Muller), the same for the same numbers.
double normal(std::uint64_t trial, std::uint64_t index) {
    const auto [u, v] = uniforms(trial, Stream::Radius, index, 0);
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * kPi * v);
}

}  // namespace

TEST_CASE("Student's factor has the values of the tables") {
    CHECK(studentFactor(0.95, 1) == Approx(12.7062).epsilon(1e-5));
    CHECK(studentFactor(0.95, 9) == Approx(2.26216).epsilon(1e-5));
    CHECK(studentFactor(0.95, 15) == Approx(2.13145).epsilon(1e-5));
    CHECK(studentFactor(0.99, 5) == Approx(4.03214).epsilon(1e-5));
    CHECK(studentFactor(0.95, 100000) == Approx(1.95996).epsilon(1e-4));
}

TEST_CASE("an interval is that of another value of the same distribution") {
    const PredictedFigure f = predictedFrom("dose", {1, 2, 3, 4, 5});
    CHECK(f.mean == Approx(3));
    CHECK(f.deviation == Approx(std::sqrt(2.5)));
    const double half = 2.77645 * std::sqrt(2.5) * std::sqrt(1.2);
    CHECK(f.low == Approx(3 - half).epsilon(1e-5));
    CHECK(f.high == Approx(3 + half).epsilon(1e-5));
    const PredictedFigure one = predictedFrom("dose", {7});
    CHECK(one.mean == 7);
    CHECK(std::isnan(one.low));

    // How often it holds one more value: 95 %, within four deviations of 4000 trials.
    constexpr int kTrials = 4000, kValues = 8;
    int held = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
        std::vector<double> values;
        for (int i = 0; i < kValues; ++i) values.push_back(10 + 2 * normal(trial, i));
        const PredictedFigure of = predictedFrom("dose", values);
        const double next = 10 + 2 * normal(trial, kValues);
        held += of.low <= next && next <= of.high ? 1 : 0;
    }
    CHECK(std::abs(held / double(kTrials) - 0.95) < 4 * std::sqrt(0.95 * 0.05 / kTrials));
}

TEST_CASE("from the laboratory's figures to the device: the interval holds the truth in 90 to 100 of 100 cases") {
    // A made-up powder of two parameters. An angle and a density are measured, with errors; the device doses otherwise.
    using Model = double (*)(const UnitPoint&);
    const Model angle = [](const UnitPoint& u) { return 15 + 20 * std::sqrt(0.1 + u[0]) + 10 * u[1]; };
    const Model density = [](const UnitPoint& u) { return 600 - 80 * u[0] * u[0] - 120 * u[1]; };
    const Model dose = [](const UnitPoint& u) { return 5 - 2 * u[0] + 1.5 * u[0] * u[1] - u[1]; };
    CalibrationAim aim;
    aim.method = CalibrationAim::Method::Surrogate;
    aim.parameters = {{"contact.friction", 0, 1}, {"contact.rolling_friction", 0, 1}};
    std::vector<UnitPoint> points;
    std::vector<Measured> angles, densities;
    for (int i = 1; i <= 16; ++i) {
        points.push_back(haltonPoint(i, 2));
        angles.push_back({angle(points.back()), 0.2});
        densities.push_back({density(points.back()), 2});
    }
    const Processes processes{GaussianProcess(points, angles), GaussianProcess(points, densities)};
    constexpr int kTrials = 20, kRuns = 16;
    constexpr double kScatter = 0.1;  // of the device from seed to seed
    int held = 0;
    double width = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
        const auto [a, b] = uniforms(7, Stream::Jitter, std::uint64_t(trial));
        const UnitPoint truth{a, b};
        const Posterior fits =
            posteriorOf(aim, {{angle(truth) + 1.5 * normal(trial, 0), 1.5}, {density(truth) + 8 * normal(trial, 1), 8}},
                        processes, kRuns, {2, 128});
        std::vector<double> doses;
        for (const Parameters& draw : fits.draws)
            doses.push_back(dose(draw) + kScatter * normal(trial, 2 + doses.size()));
        const PredictedFigure f = predictedFrom("dose", doses);
        held += f.low <= dose(truth) && dose(truth) <= f.high ? 1 : 0;
        width += (f.high - f.low) / kTrials;
    }
    CAPTURE(held, width);
    CHECK(held >= 18);
    // It is a prediction: without the laboratory the dose lies anywhere from 1.5 to 5.
    CHECK(width < 2);
}

TEST_CASE("every draw is a run with its own parameters and its own seed") {
    const StudyFolder folder;
    const auto draws = folder.write("draws.csv", kDraws);
    const Study study = drawsStudy(folder / "good.toml", {"stop.max_doses=1"}, draws, 3);
    const std::vector<Member> members = drawsMembers(study);
    REQUIRE(members.size() == 3);
    for (std::size_t m = 0; m < members.size(); ++m) {
        CHECK(members[m].number == int(m));
        CHECK(members[m].seed == 3 + m);
        const Case c = loadResolvedCase(members[m].caseText, folder / "good.toml");
        CHECK(c.seed == 3 + m);
        CHECK(c.schedule.stop.maxDoses == 1);
        CHECK(c.dosingLaw.between(0, 0).mu == std::stod(members[m].values[0]));
    }
    CHECK(members[2].values == std::vector<std::string>{"0.5", "120"});

    SweepFolder sweep(folder / "out", study, members);
    MadeUpRuns runs(1);
    runs.codes[1] = 3;
    SweepObserver nobody;
    REQUIRE(runMembers(sweep, members, runs, nobody, [] { return Halt::None; }).whole);
    for (const int number : {0, 2})
        std::ofstream(sweep.memberFolder(number) / "summary.json")
            << nlohmann::json{{"dose_statistics", {{"mean_kg", 1e-3 * (number + 1)}}}};
    const Prediction p = predictionOf(members, sweep);
    CHECK(p.draws == 3);
    CHECK(p.failed == 1);
    REQUIRE(p.figures.size() == 1);
    CHECK(p.figures[0].name == "dose.mean_kg");
    CHECK(p.figures[0].count == 2);
    CHECK(p.figures[0].mean == Approx(2e-3));
    const auto json = predictionJson(p);
    CHECK(json["figures"][0]["mean"].get<double>() == Approx(2e-3));
    CHECK(json["chance"] == 0.95);
}

TEST_CASE("draws that are none are refused") {
    const StudyFolder folder;
    const auto study = [&](const std::string& text, int count) {
        return drawsStudy(folder / "good.toml", {}, folder.write("draws.csv", text), count);
    };
    CHECK_THROWS_WITH(study(kDraws, 5), Catch::Contains("draws.csv") && Catch::Contains("has 4 rows"));
    CHECK_THROWS_WITH(study("contact friction\n0.3\n0.4\n", 2), Catch::Contains("not the path of a key"));
    CHECK_THROWS_WITH(study("contact.friction,contact.friction\n0.3,0.3\n0.4,0.4\n", 2),
                      Catch::Contains("given twice"));
    CHECK_THROWS_WITH(drawsMembers(study("contact.frictoin\n0.3\n0.4\n", 2)),
                      Catch::Contains("did you mean friction?"));
}
