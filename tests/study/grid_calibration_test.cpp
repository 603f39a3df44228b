// The calibration on a grid: crossings, their errors, and the choice among them, from made-up tables.
#include "host/study/grid_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "host/study/member_result.h"
#include "host/study/seed_scatter.h"
#include "tests/support/catch.h"

using namespace vkdose;

namespace {

const std::vector<std::string> kKeys{"contact.friction", "contact.kc_over_k"};

CalibrationAim aimAt(double target, double tolerance = 0) {
    CalibrationAim aim;
    aim.target = target;
    aim.tolerance = tolerance;
    aim.along = "contact.kc_over_k";
    return aim;
}

/// A table of members, filled row by row.
struct Members {
    Table table;
    Members() {
        Row names{"member", "seed", kKeys[0], kKeys[1]};
        names.insert(names.end(), kOutputColumns.begin(), kOutputColumns.end());
        table = Table(names);
    }
    void add(const char* friction, double kc, double beta, double rsd = 0.2, const char* status = "ok",
             double betaError = 1e-4) {
        Row row(table.names().size());
        const auto set = [&](const char* column, const std::string& text) {
            row.at(std::size_t(std::find(table.names().begin(), table.names().end(), column) - table.names().begin())) =
                text;
        };
        set("contact.friction", friction);
        set("contact.kc_over_k", fmt::format("{}", kc));
        set("status", status);
        set("beta_kg_per_dose", std::isnan(beta) ? "" : fmt::format("{:.17g}", beta));
        set("beta_standard_error_kg_per_dose", fmt::format("{:.17g}", betaError));
        set("rsd", std::isnan(rsd) ? "" : fmt::format("{:.17g}", rsd));
        set("doses", "9");
        table.add(row);
    }
};

}  // namespace

TEST_CASE("a straight curve crosses the target where it does") {
    Members m;
    for (const double kc : {1.0, 0.0, 0.5}) m.add("0.5", kc, 5e-3 - 2e-3 * kc);  // in any order
    const GridCalibration grid = calibrateGrid(m.table, kKeys, aimAt(3.7e-3));
    REQUIRE(grid.curves.size() == 1);
    CHECK(grid.keys == std::vector<std::string>{"contact.friction"});
    CHECK(grid.curves[0].values == Row{"0.5"});
    REQUIRE(grid.curves[0].crossings.size() == 1);
    CHECK(grid.curves[0].crossings[0].along == Approx(0.65).epsilon(1e-12));  // rounding
    CHECK(grid.choice == 0U);
}

TEST_CASE("points on the target count once, and a curve that turns back has two crossings") {
    Members m;
    const double betas[] = {4e-3, 3e-3, 2e-3, 3.5e-3};
    for (int i = 0; i < 4; ++i) m.add("0.5", i, betas[i]);
    const auto crossingsAt = [&](double target) {
        std::vector<double> at;
        const GridCalibration grid = calibrateGrid(m.table, kKeys, aimAt(target));
        for (const Crossing& c : grid.curves[0].crossings) at.push_back(c.along);
        return at;
    };
    CHECK(crossingsAt(3e-3).size() == 2);
    CHECK(crossingsAt(3e-3)[0] == 1.0);
    CHECK(crossingsAt(3e-3)[1] == Approx(2 + 2.0 / 3).epsilon(1e-12));
    CHECK(crossingsAt(4e-3) == std::vector<double>{0.0});
    CHECK(crossingsAt(4.1e-3).empty());
    CHECK(crossingsAt(1.9e-3).empty());
    Members falling;
    falling.add("0.5", 0, 4e-3);
    falling.add("0.5", 1, 3e-3);
    CHECK(calibrateGrid(falling.table, kKeys, aimAt(3e-3)).curves[0].crossings.size() == 1);
}

TEST_CASE("the error of a crossing is that of many repeated experiments") {
    // Two points, measured with known errors, and an uncertain target, again and again.
    const double slopeError = 0.4e-4, targetError = 0.3e-4;
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    double sum = 0, squares = 0;
    constexpr int kTimes = 20000;
    for (int i = 0; i < kTimes; ++i) {
        Members m;
        m.add("0.5", 0.4, 4.5e-3 + slopeError * normal(random));
        m.add("0.5", 0.8, 3.5e-3 + 2 * slopeError * normal(random));
        const auto grid = calibrateGrid(m.table, kKeys, aimAt(3.8e-3 + targetError * normal(random)));
        // Without a bracket nothing is reported; with these errors that is one in some thousands.
        if (grid.curves[0].crossings.empty()) continue;
        const double x = grid.curves[0].crossings[0].along - 0.68;
        sum += x;
        squares += x * x;
    }
    const double spread = std::sqrt(squares / kTimes - std::pow(sum / kTimes, 2));
    Members m;
    m.add("0.5", 0.4, 4.5e-3, 0.2, "ok", slopeError);
    m.add("0.5", 0.8, 3.5e-3, 0.2, "ok", 2 * slopeError);
    const auto grid = calibrateGrid(m.table, kKeys, aimAt(3.8e-3, targetError));
    // First-order propagation: the neglected terms are of the order of (error / difference)^2, a tenth here.
    CHECK(grid.curves[0].crossings[0].alongError == Approx(spread).epsilon(0.1));
}

TEST_CASE("several seeds give the mean and its error, a single one the error of its slope") {
    Members m;
    for (const double beta : {4.4e-3, 4.6e-3, 4.5e-3}) m.add("0.5", 0, beta, 0.1 + beta);
    m.add("0.5", 1, 3e-3);
    const GridCalibration grid = calibrateGrid(m.table, kKeys, aimAt(4e-3));
    const std::vector<CurvePoint>& points = grid.curves[0].points;
    REQUIRE(points.size() == 2);
    CHECK(points[0].seeds == 3);
    CHECK(points[0].beta == Approx(4.5e-3).epsilon(1e-12));
    const SeedScatter scatter{1e-4, 2};  // s = 0.1 g of three
    CHECK(points[0].betaError == Approx(scatter.errorOfMean(3)).epsilon(1e-9));
    CHECK(points[1].betaError == Approx(scatter.errorOfMean(1)).epsilon(1e-9));
    CHECK(points[1].rsdError == Approx(scatter.errorOfMean(1)).epsilon(1e-9));

    Members single;
    single.add("0.5", 0, 4.5e-3, 0.2, "ok", 3e-4);
    const GridCalibration alone = calibrateGrid(single.table, kKeys, aimAt(4e-3));
    CHECK(alone.curves[0].points[0].betaError == 3e-4);
    CHECK(alone.curves[0].points[0].rsdError == Approx(0.2 / 4).epsilon(1e-12));  // nine doses: 1/sqrt(2 * 8)
}

TEST_CASE("chosen is the steadiest crossing, and of equally steady ones that with the least adhesion") {
    const auto choiceOf = [](double first, double second, double third) {
        Members m;
        const double rsd[] = {first, second, third};
        const char* frictions[] = {"0.2", "0.5", "0.65"};
        const double shift[] = {1.0e-3, 0.0, -0.5e-3};  // the more friction, the earlier the crossing
        for (int i = 0; i < 3; ++i)
            for (const double kc : {0.0, 1.0}) m.add(frictions[i], kc, 4.6e-3 + shift[i] - 2e-3 * kc, rsd[i]);
        const auto grid = calibrateGrid(m.table, kKeys, aimAt(3.8e-3));
        return grid.choice ? grid.curves[*grid.choice].values[0] : std::string("none");
    };
    CHECK(choiceOf(0.1, 0.3, 0.3) == "0.2");
    CHECK(choiceOf(0.3, 0.1, 0.3) == "0.5");
    // 0.20 and 0.21 of nine doses each cannot be told apart: the lower adhesion, at the greatest friction, is taken.
    CHECK(choiceOf(0.5, 0.20, 0.21) == "0.65");
    CHECK(choiceOf(0.5, 0.21, 0.20) == "0.65");
    CHECK(choiceOf(0.20, 0.21, 0.9) == "0.5");
}

TEST_CASE("a crossing beside a point that dosed nothing is not chosen where another has a known RSD") {
    for (const char* blocked : {"0.2", "0.9"}) {  // before the other curve, and behind it
        Members m;
        const auto add = [&](bool stuck) {
            m.add(stuck ? blocked : "0.5", 0, stuck ? 8e-5 : 7e-5, stuck ? 0.9 : 0.1);
            m.add(stuck ? blocked : "0.5", 1, stuck ? 0 : 4e-5, stuck ? std::nan("") : 0.1);
        };
        add(std::string(blocked) == "0.2");
        add(std::string(blocked) != "0.2");
        const GridCalibration grid = calibrateGrid(m.table, kKeys, aimAt(5e-5));
        REQUIRE(grid.choice);
        CHECK(grid.curves[*grid.choice].values == Row{"0.5"});
    }
    Members alone;
    alone.add("0.2", 0, 8e-5, 0.9);
    alone.add("0.2", 1, 0, std::nan(""));
    CHECK(calibrateGrid(alone.table, kKeys, aimAt(5e-5)).choice == 0U);
}

TEST_CASE("members that failed or gave nothing are left out, without a crossing there is no choice") {
    Members m;
    m.add("0.5", 0, 5e-3);
    m.add("0.5", 1, 1e-3, 0.2, "failed");
    m.add("0.5", 2, NAN);
    const GridCalibration grid = calibrateGrid(m.table, kKeys, aimAt(3.8e-3));
    CHECK(grid.leftOut == 2);
    REQUIRE(grid.curves.size() == 1);
    CHECK(grid.curves[0].points.size() == 1);
    CHECK(grid.curves[0].crossings.empty());
    CHECK_FALSE(grid.choice);
}

TEST_CASE("a curve that only comes within the tolerance of the target meets it at its nearest point") {
    Members m;
    m.add("0.5", 0, 3.0e-3);
    m.add("0.5", 1, 3.6e-3);
    m.add("0.5", 2, 3.2e-3);
    const auto crossings = [&](double tolerance) {
        return calibrateGrid(m.table, kKeys, aimAt(3.7e-3, tolerance)).curves[0].crossings;
    };
    CHECK(crossings(0.05e-3).empty());
    const std::vector<Crossing> near = crossings(0.2e-3);
    REQUIRE(near.size() == 1);
    CHECK(near[0].along == 1);
    CHECK(near[0].off == Approx(-0.1e-3));
    CHECK(std::isnan(near[0].alongError));
    CHECK(calibrateGrid(m.table, kKeys, aimAt(3.7e-3, 0.2e-3)).choice == 0U);
    // Where a curve crosses the target, a nearer point does not count.
    CHECK(calibrateGrid(m.table, kKeys, aimAt(3.3e-3, 0.2e-3)).curves[0].crossings.front().along == Approx(0.5));
}

TEST_CASE("a point with a seed that dosed nothing has no RSD, and is not chosen for that of its other seed") {
    Members m;
    for (const double beta : {8e-5, 8.2e-5}) m.add("0.2", 0, beta, 0.1);
    m.add("0.2", 1, 0, std::nan(""));
    m.add("0.2", 1, 2e-5, 0.05);  // it looks steadier than the other curve
    for (const double kc : {0.0, 1.0})
        for (const double rsd : {0.30, 0.32}) m.add("0.5", kc, 8e-5 - 6e-5 * kc, rsd);
    const GridCalibration grid = calibrateGrid(m.table, kKeys, aimAt(5e-5));
    REQUIRE(grid.curves.size() == 2);
    const CurvePoint& blocked = grid.curves[0].points.at(1);
    CHECK(blocked.seeds == 2);
    CHECK(blocked.beta == Approx(1e-5));
    CHECK(std::isfinite(blocked.betaError));
    CHECK(std::isnan(blocked.rsd));
    CHECK(std::isnan(blocked.rsdError));
    CHECK(std::isfinite(grid.curves[0].points[0].rsdError));
    REQUIRE(grid.choice);
    CHECK(grid.curves[*grid.choice].values == Row{"0.5"});
}
