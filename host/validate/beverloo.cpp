// Beverloo's law W = C rho_b sqrt(g) (D - k d)^(5/2): W^(2/5) is a straight line over the hole D, which C and k fit.

#include <fmt/format.h>

#include <cmath>

#include "host/analysis/line_fit.h"
#include "host/validate/comparisons.h"

namespace vkdose::validate {

namespace {

constexpr double kGravity = 9.81;   // [m/s2], as the case has it
constexpr double kDiameter = 2e-3;  // of the spheres [m], as the case has it
constexpr double kSmall = 0.02;     // of W^(2/5), how far off the line it may be

struct Point {
    double hole;             ///< diameter [m]
    double rate, error;      ///< [kg/s]
    double root, rootError;  ///< W^(2/5)
};

/// C and k of a line through W^(2/5).
struct Law {
    double constant, gap;
};

Law lawOf(double slope, double zero, double density) {
    return {std::pow(slope, 2.5) / (density * std::sqrt(kGravity)), zero / kDiameter};
}

/// The line through all points but `left`; none is left out if that is no index.
LineFit lineThrough(const std::vector<Point>& points, std::size_t left) {
    LineFit fit;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (i != left) fit.add(points[i].hole, points[i].root);
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
        points.push_back({2e-3 * run.value("body.floor.hole_radius_mm"), rate, error, root, 0.4 * root * error / rate});
        density += run.figure("/measures/settled/density_kg_m3") / static_cast<double>(runs.size());
    }
    const LineFit fit = lineThrough(points, points.size());
    const Law law = lawOf(fit, density);
    // The error of C and k by leaving out one point at a time (jackknife).
    Law error{0, 0};
    const double n = static_cast<double>(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Law other = lawOf(lineThrough(points, i), density);
        error.constant += (n - 1) / n * std::pow(other.constant - law.constant, 2);
        error.gap += (n - 1) / n * std::pow(other.gap - law.gap, 2);
    }
    double off = 0, largest = 0;
    for (const Point& p : points) {
        const double distance = std::abs(p.root - fit.at(p.hole));
        if (!(distance <= off)) off = distance;  // what is not a number stays
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
