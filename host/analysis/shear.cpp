#include "host/analysis/shear.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/core/line_fit.h"
#include "host/core/vec.h"

namespace vkdose {

void makePressurePositive(std::vector<LidSample>& samples) {
    double sum = 0;
    for (const LidSample& s : samples) sum += s.force;
    if (sum >= 0) return;
    for (LidSample& s : samples) s.force = -s.force;
}

std::optional<ShearPoint> shearPoint(const std::vector<LidSample>& samples, double from, double to, double inner,
                                     double outer) {
    const double area = kPi * (outer * outer - inner * inner);
    const double moment = 2.0 / 3 * kPi * (outer * outer * outer - inner * inner * inner);
    const auto counts = [&](const LidSample& s) { return s.time > from && s.time <= to; };
    ShearPoint p;
    double torque = 0;
    for (const LidSample& s : samples) {
        if (!counts(s)) continue;
        ++p.lines;
        p.normal += s.force / area;
        torque += s.torque / moment;
        p.peak = std::max(p.peak, std::abs(s.torque) / moment);
    }
    if (p.lines == 0) return std::nullopt;
    p.normal /= p.lines;
    torque /= p.lines;
    p.shear = std::abs(torque);
    double normal = 0, shear = 0;
    for (const LidSample& s : samples) {
        if (!counts(s)) continue;
        normal += std::pow(s.force / area - p.normal, 2);
        shear += std::pow(s.torque / moment - torque, 2);
    }
    p.normalDeviation = std::sqrt(normal / std::max(1, p.lines - 1));
    p.shearDeviation = std::sqrt(shear / std::max(1, p.lines - 1));
    return p;
}

std::optional<YieldLocus> yieldLocus(const std::vector<ShearPoint>& points) {
    if (points.empty()) return std::nullopt;
    LineFit line;
    double products = 0, squares = 0;
    for (const ShearPoint& p : points) {
        line.add(p.normal, p.shear);
        products += p.normal * p.shear;
        squares += p.normal * p.normal;
    }
    const double effective = std::atan2(products, squares);
    if (points.size() == 1) return YieldLocus{effective, std::numeric_limits<double>::quiet_NaN(), effective};
    if (!std::isfinite(line.slope())) return std::nullopt;
    return YieldLocus{std::atan(line.slope()), line.at(0), effective};
}

ShearPoint meanPreShear(const std::vector<ShearStage>& stages) {
    ShearPoint mean;
    for (const ShearStage& stage : stages) {
        mean.normal += stage.preShear.normal / static_cast<double>(stages.size());
        mean.shear += stage.preShear.shear / static_cast<double>(stages.size());
    }
    return mean;
}

std::vector<ShearPoint> prorated(const std::vector<ShearStage>& stages) {
    const double mean = meanPreShear(stages).shear;
    std::vector<ShearPoint> points;
    for (const ShearStage& stage : stages) {
        ShearPoint point = stage.failure;
        point.shear = point.peak * mean / stage.preShear.shear;
        points.push_back(point);
    }
    return points;
}

std::optional<Flowability> flowability(const YieldLocus& locus, const ShearPoint& steady) {
    const double c = locus.cohesion, sine = std::sin(locus.friction), cosine = std::cos(locus.friction);
    if (!(c > 0)) return std::nullopt;
    // The centre s of a circle of radius s sin(phi) + c cos(phi) on which the point of steady flow lies. Of the two,
    // the lower one has the point behind the place where it touches the locus.
    const double half = steady.normal + c * sine * cosine;
    const double last = steady.normal * steady.normal + steady.shear * steady.shear - c * c * cosine * cosine;
    const double root = half * half - cosine * cosine * last;
    if (!(root >= 0)) return std::nullopt;
    const double centre = (half - std::sqrt(root)) / (cosine * cosine);
    Flowability f;
    f.consolidation = centre * (1 + sine) + c * cosine;
    f.strength = 2 * c * cosine / (1 - sine);
    f.ffc = f.consolidation / f.strength;
    return f;
}

}  // namespace vkdose
