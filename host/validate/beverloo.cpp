// Beverloo's law W = C rho_b sqrt(g) (D - k d)^(5/2): W^(2/5) is a straight line over the hole D, which C and k fit.

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "host/core/line_fit.h"
#include "host/core/worse.h"
#include "host/validate/comparisons.h"

namespace vkdose::validate {

namespace {

constexpr double kGravity = 9.81;   // [m/s2], as the case has it
constexpr double kDiameter = 2e-3;  // of the spheres [m], as the case has it
constexpr double kSmall = 0.02;     // of W^(2/5), how far off the line it may be

constexpr std::size_t kFewest = 3;  // holes: two always lie on a straight line

struct Point {
    double hole;             ///< diameter [m]
    double root, rootError;  ///< W^(2/5)
};

/// C and k of a line through W^(2/5).
struct Law {
    double constant, gap;
};

Law lawOf(double slope, double zero, double density) {
    return {std::pow(slope, 2.5) / (density * std::sqrt(kGravity)), zero / kDiameter};
}

/// The line through all points but those of one hole; none is left out if no point has it.
LineFit lineThrough(const std::vector<Point>& points, double leftOut) {
    LineFit fit;
    for (const Point& p : points)
        if (p.hole != leftOut) fit.add(p.hole, p.root);
    return fit;
}

Law lawOf(const LineFit& fit, double density) {
    return lawOf(fit.slope(), -fit.at(0) / fit.slope(), density);
}

}  // namespace

Evaluation beverloo(const std::vector<Run>& runs, const std::filesystem::path&) {
    std::vector<Point> points;
    double density = 0;
    for (const Run& run : runs) {
        const double rate = run.figure("/measures/discharge/rate_kg_s");
        const double error = run.figure("/measures/discharge/rate_error_kg_s");
        const double root = std::pow(rate, 0.4);
        points.push_back({2e-3 * run.value("body.floor.hole_radius_mm"), root, 0.4 * root * error / rate});
        density += run.figure("/measures/settled/density_kg_m3") / static_cast<double>(runs.size());
    }
    const LineFit fit = lineThrough(points, 0);
    const Law law = lawOf(fit, density);
    // The error of C and k by leaving out one hole at a time, with all of its fillings (jackknife).
    std::set<double> holes;
    for (const Point& p : points) holes.insert(p.hole);
    Law error{0, 0};
    const double n = static_cast<double>(holes.size());
    for (const double hole : holes) {
        const Law other = lawOf(lineThrough(points, hole), density);
        error.constant += (n - 1) / n * std::pow(other.constant - law.constant, 2);
        error.gap += (n - 1) / n * std::pow(other.gap - law.gap, 2);
    }
    double off = 0, largest = 0;
    for (const Point& p : points) {
        off = worse(off, std::abs(p.root - fit.at(p.hole)));
        largest = std::max(largest, p.root);
    }

    Evaluation result;
    const char* source = "Beverloo and others 1961 found 0.58 and 1.4; 0.55 to 0.65 is usual";
    result.findings = {
        {"C", "-", law.constant, std::sqrt(error.constant), 0.55, 0.65, source,
         fmt::format("fit with the bulk density at rest, {:.0f} kg/m3", density), true},
        {"k", "-", law.gap, std::sqrt(error.gap), 1.0, 2.1, "1 to 2.1 for spheres in the literature",
         "grains by which the hole is narrower than it is", true},
        {"W^(2/5) off a straight line over D, at most", "-", off / largest, 0, 0, kSmall, "the law's own shape",
         "in units of the largest W^(2/5)", true},
    };
    if (holes.size() < kFewest)
        for (Finding& f : result.findings)
            notComparable(f, fmt::format("{} holes of at least {}", holes.size(), kFewest));
    Curve found{"vkdose", {}, false, true}, fitted{"fit", {}, true, false},
        published{"C = 0.58, k = 1.4", {}, true, false};
    for (const Point& p : points) {
        found.points.push_back({1e3 * p.hole, p.root, p.rootError});
        fitted.points.push_back({1e3 * p.hole, fit.at(p.hole), 0});
        const double open = p.hole - 1.4 * kDiameter;
        published.points.push_back(
            {1e3 * p.hole, std::pow(0.58 * density * std::sqrt(kGravity) * std::pow(open, 2.5), 0.4), 0});
    }
    result.charts.push_back({"Beverloo's law",
                             "Bars: standard error of the rate over the quarters of its time.",
                             "diameter of the hole D [mm]",
                             "W^(2/5) [(kg/s)^(2/5)]",
                             {found, fitted, published}});
    return result;
}

}  // namespace vkdose::validate
