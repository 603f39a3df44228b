#include "host/analysis/shear.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/analysis/line_fit.h"
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

}  // namespace vkdose
