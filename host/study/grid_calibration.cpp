#include "host/study/grid_calibration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "host/analysis/beta.h"
#include "host/study/seed_scatter.h"

namespace vkdose {

namespace {

/// The results of the members of a point, a value for each seed.
struct Found {
    std::vector<double> beta, betaError, rsd, doses;
};

/// From seed to seed, over all points.
struct Scatter {
    SeedScatter beta, rsd;
};

Scatter scatterOf(const std::map<Row, std::map<double, Found>>& curves) {
    std::vector<std::vector<double>> beta, rsd;
    for (const auto& [others, points] : curves) {
        for (const auto& [along, found] : points) {
            beta.push_back(found.beta);
            rsd.push_back(found.rsd);
        }
    }
    return {scatterOfSeeds(beta), scatterOfSeeds(rsd)};
}

CurvePoint pointOf(double along, const Found& found, const Scatter& scatter) {
    CurvePoint point;
    point.along = along;
    const Estimate beta = estimateOf(found.beta), rsd = estimateOf(found.rsd);
    point.beta = beta.mean;
    point.seeds = beta.count;
    point.betaError = scatter.beta.freedom > 0 ? scatter.beta.errorOfMean(beta.count) : found.betaError.front();
    // A seed that dosed nothing has no RSD. Were it left out of the mean, the point would pass for a steady one.
    if (rsd.count < beta.count) {
        point.rsd = point.rsdError = std::numeric_limits<double>::quiet_NaN();
        return point;
    }
    point.rsd = rsd.mean;
    // A standard deviation of n doses, and so the RSD, is known to one part in sqrt(2 (n - 1)).
    const double single = rsd.mean / std::sqrt(2 * (found.doses.front() - 1));
    point.rsdError = scatter.rsd.freedom > 0 ? scatter.rsd.errorOfMean(rsd.count) : single;
    return point;
}

Crossing between(const CurvePoint& a, const CurvePoint& b, const CalibrationAim& aim) {
    const double w = (aim.target - a.beta) / (b.beta - a.beta);
    const auto blend = [w](double x, double y) { return (1 - w) * x + w * y; };
    const auto blendErrors = [w](double x, double y) { return std::hypot((1 - w) * x, w * y); };
    Crossing crossing;
    crossing.along = blend(a.along, b.along);
    const double perMass = std::abs((b.along - a.along) / (b.beta - a.beta));
    crossing.alongError = perMass * std::hypot(blendErrors(a.betaError, b.betaError), aim.tolerance);
    crossing.rsd = blend(a.rsd, b.rsd);
    crossing.rsdError = blendErrors(a.rsdError, b.rsdError);
    return crossing;
}

void findCrossings(Curve& curve, const CalibrationAim& aim) {
    for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {
        const CurvePoint &a = curve.points[i], &b = curve.points[i + 1];
        // The interval is half open, so that a point on the target counts once. The last point has no interval after
        // it.
        const bool endsOnIt = i + 2 == curve.points.size() && a.beta > aim.target && b.beta == aim.target;
        if ((a.beta >= aim.target) != (b.beta >= aim.target) || endsOnIt) curve.crossings.push_back(between(a, b, aim));
    }
}

/// A curve that only comes near the target meets it at its nearest point, if that is within the tolerance.
void findNearest(Curve& curve, const CalibrationAim& aim) {
    const auto off = [&](const CurvePoint& p) { return std::abs(p.beta - aim.target); };
    const auto nearest = std::min_element(curve.points.begin(), curve.points.end(),
                                          [&](const CurvePoint& a, const CurvePoint& b) { return off(a) < off(b); });
    if (nearest == curve.points.end() || off(*nearest) > aim.tolerance) return;
    // Without a crossing there is no slope through the target, and so no error of the place.
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    curve.crossings.push_back({nearest->along, kUnknown, nearest->rsd, nearest->rsdError, nearest->beta - aim.target});
}

/// A crossing beside a point with a seed that dosed nothing has no RSD. It can be chosen only where no other has one
/// either.
std::optional<std::size_t> choose(const std::vector<Curve>& curves) {
    std::optional<std::size_t> steadiest, choice;
    const auto lowest = [&](std::size_t i) -> const Crossing& { return curves[i].crossings.front(); };
    const auto hasRsd = [&](std::size_t i) { return !curves[i].crossings.empty() && std::isfinite(lowest(i).rsd); };
    bool known = false;
    for (std::size_t i = 0; i < curves.size(); ++i) known = known || hasRsd(i);
    const auto may = [&](std::size_t i) { return known ? hasRsd(i) : !curves[i].crossings.empty(); };
    for (std::size_t i = 0; i < curves.size(); ++i)
        if (may(i) && (!steadiest || lowest(i).rsd < lowest(*steadiest).rsd)) steadiest = i;
    for (std::size_t i = 0; steadiest && i < curves.size(); ++i) {
        if (!may(i)) continue;
        const double more = lowest(i).rsd - lowest(*steadiest).rsd;
        const bool asSteady = i == *steadiest || more <= std::hypot(lowest(i).rsdError, lowest(*steadiest).rsdError);
        if (asSteady && (!choice || lowest(i).along < lowest(*choice).along)) choice = i;
    }
    return choice;
}

}  // namespace

GridCalibration calibrateGrid(const Table& members, const std::vector<std::string>& keys, const CalibrationAim& aim) {
    GridCalibration result;
    for (const std::string& key : keys)
        if (key != aim.along) result.keys.push_back(key);
    std::vector<Row> order;  // of the first member of each curve
    std::map<Row, std::map<double, Found>> curves;
    for (std::size_t row = 0; row < members.rows(); ++row) {
        Row others;
        for (const std::string& key : result.keys) others.push_back(members.text(row, key));
        if (!curves.contains(others)) order.push_back(others);
        auto& curve = curves[others];
        const auto number = [&](const std::string& column) { return numberIn(members.text(row, column)); };
        const double along = number(aim.along), beta = number("beta_kg_per_dose");
        if (members.text(row, "status") != "ok" || std::isnan(along) || std::isnan(beta)) {
            ++result.leftOut;
            continue;
        }
        Found& found = curve[along];
        found.beta.push_back(beta);
        found.betaError.push_back(number("beta_standard_error_kg_per_dose"));
        found.rsd.push_back(number("rsd"));
        found.doses.push_back(number("doses"));
    }
    const Scatter scatter = scatterOf(curves);
    for (const Row& others : order) {
        Curve curve{others, {}, {}};
        for (const auto& [along, found] : curves[others]) {
            curve.points.push_back(pointOf(along, found, scatter));
            result.betas.push_back(found.beta);
        }
        findCrossings(curve, aim);
        if (curve.crossings.empty()) findNearest(curve, aim);
        result.curves.push_back(std::move(curve));
    }
    result.choice = choose(result.curves);
    return result;
}

}  // namespace vkdose
