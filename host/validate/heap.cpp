// The angle of repose beside the empirical equation of Zhou and others (2002) for monosized spheres,
// phi = 68.61 mu_s,pp^0.27 mu_s,pw^0.22 mu_r,pp^0.06 mu_r,pw^0.12 d^-0.2, with the lengths mu_r and d in mm. Their heap
// is a wedge in a narrow box and their rolling friction a constant couple; here it is a cone from a lifted tube, and a
// spring with a slider. So the signs of the exponents are judged, and the numbers stand beside each other.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "host/core/line_fit.h"
#include "host/validate/comparisons.h"

namespace vkdose::validate {

namespace {

/// The angle at one point of the study: mean over the fillings, and its standard error.
struct Angle {
    double friction, rolling, radius;  ///< contact.friction, contact.rolling_friction, [mm]
    double mean = 0, error = 0;        ///< [degrees]
};

std::vector<Angle> anglesOf(const std::vector<Run>& runs) {
    std::map<std::array<double, 3>, std::vector<std::array<double, 2>>> found;
    for (const Run& run : runs)
        found[{run.value("contact.friction"), run.value("contact.rolling_friction"),
               run.value("particles.size.radius_mm")}]
            .push_back({run.figure("/measures/heap/angle_deg"), run.figure("/measures/heap/angle_error_deg")});
    std::vector<Angle> angles;
    for (const auto& [at, values] : found) {
        Angle angle{at[0], at[1], at[2]};
        const double n = static_cast<double>(values.size());
        double squares = 0;
        for (const auto& [value, error] : values) {
            angle.mean += value / n;
            squares += error * error;
        }
        double spread = 0;
        for (const auto& [value, error] : values) spread += (value - angle.mean) * (value - angle.mean);
        // The quarters of a heap tell little of what another filling would be.
        const double ofQuarters = std::sqrt(squares) / n, ofFillings = n > 1 ? std::sqrt(spread / (n - 1) / n) : 0;
        angle.error = std::max(ofQuarters, ofFillings);
        angles.push_back(angle);
    }
    return angles;
}

/// The exponent of `of` in the angle over those points that share the other two values. Its error is the larger of two:
/// what follows from the errors of the angles, and what follows from how far these are off a power of `of`.
struct Exponent {
    double value = 0, error = 0;
    Curve curve;
};

constexpr std::size_t kFewest = 3;  // points: two always follow a power

Exponent exponentOf(const std::vector<Angle>& angles, const char* name, double (*of)(const Angle&),
                    bool (*along)(const Angle&)) {
    LineFit fit;
    std::vector<std::array<double, 3>> points;
    double mean = 0;
    for (const Angle& a : angles)
        if (along(a)) {
            fit.add(std::log(of(a)), std::log(a.mean));
            points.push_back({of(a), a.mean, a.error});
            mean += std::log(of(a));
        }
    const double count = static_cast<double>(points.size());
    mean /= count;
    double spread = 0, noise = 0, misfit = 0;
    for (const auto& [x, angle, error] : points) {
        const double off = std::log(x) - mean;
        spread += off * off;
        noise += std::pow(off * error / angle, 2);
        misfit += std::pow(std::log(angle) - fit.at(std::log(x)), 2);
    }
    const double ofAngles = std::sqrt(noise) / spread, ofFit = std::sqrt(misfit / (count - 2) / spread);
    return {fit.slope(), std::max(ofAngles, ofFit), {name, points, true, true}};
}

Finding trend(const char* of, const Exponent& exponent, bool grows) {
    Finding finding{fmt::format("exponent of {}", of), "-", exponent.value, exponent.error};
    finding.wanted = grows ? Wanted::Positive : Wanted::Negative;
    finding.source = grows ? "the angle grows with it" : "the angle falls with it";
    finding.remark = "the sign is judged";
    if (exponent.curve.points.size() < kFewest)
        notComparable(finding, fmt::format("{} points of at least {}", exponent.curve.points.size(), kFewest));
    return finding;
}

Finding number(const char* of, const Exponent& exponent, double published) {
    Finding finding{
        fmt::format("exponent of {}, as published", of), "-", exponent.value, exponent.error, published, published};
    finding.source = "equation of Zhou and others 2002";
    finding.remark = "theirs is a wedge in a narrow box with another law of rolling; here a cone, on one plate";
    finding.comparable = false;
    return finding;
}

}  // namespace

Evaluation heap(const std::vector<Run>& runs, const std::filesystem::path&) {
    const std::vector<Angle> angles = anglesOf(runs);
    const Exponent friction = exponentOf(
        angles, "vkdose", [](const Angle& a) { return a.friction; },
        [](const Angle& a) { return a.rolling == 0.05 && a.radius == 1; });
    const Exponent rolling = exponentOf(
        angles, "vkdose", [](const Angle& a) { return a.rolling; },
        [](const Angle& a) { return a.friction == 0.4 && a.radius == 1; });
    const Exponent size = exponentOf(
        angles, "vkdose", [](const Angle& a) { return 2 * a.radius; },
        // With the size the coefficient changes so that the length of the lever stays.
        [](const Angle& a) { return a.friction == 0.4 && std::abs(a.rolling * a.radius - 0.05) < 1e-3; });
    Evaluation result;
    result.findings = {trend("sliding friction", friction, true), number("sliding friction", friction, 0.27),
                       trend("rolling friction", rolling, true),  number("rolling friction", rolling, 0.06),
                       trend("the diameter", size, false),        number("the diameter", size, -0.2)};
    const char* note = "Bars: standard error, from the quarters of each heap or from the fillings.";
    result.charts = {{"Angle of repose over sliding friction", note, "sliding friction", "degrees", {friction.curve}},
                     {"Angle of repose over rolling friction", note, "rolling friction", "degrees", {rolling.curve}},
                     {"Angle of repose over size", note, "diameter [mm]", "degrees", {size.curve}}};
    return result;
}

}  // namespace vkdose::validate
