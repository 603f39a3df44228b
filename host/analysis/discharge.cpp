#include "host/analysis/discharge.h"

#include <array>
#include <cmath>
#include <limits>

#include "host/core/line_fit.h"

namespace vkdose {

std::optional<Discharge> dischargeOf(const std::vector<DischargeSample>& samples, double from, double to) {
    std::vector<DischargeSample> within;
    for (const DischargeSample& s : samples)
        if (s.time >= from && s.time <= to) within.push_back(s);
    constexpr std::size_t kQuarters = 4;
    if (within.size() < 2 * kQuarters) return std::nullopt;

    LineFit whole;
    std::array<LineFit, kQuarters> quarters;
    for (std::size_t i = 0; i < within.size(); ++i) {
        whole.add(within[i].time, within[i].mass);
        quarters[i * kQuarters / within.size()].add(within[i].time, within[i].mass);
    }
    Discharge d;
    d.rate = whole.slope();
    if (!(d.rate > 0)) return std::nullopt;
    double mean = 0, squares = 0;
    for (const LineFit& q : quarters) mean += q.slope() / kQuarters;
    for (const LineFit& q : quarters) squares += (q.slope() - mean) * (q.slope() - mean);
    d.error = std::sqrt(squares / (kQuarters - 1) / kQuarters);
    return d;
}

double beverlooConstant(double rate, double bulkDensity, double gravity, double hole, double grain) {
    const double free = hole - kBeverlooGap * grain;
    if (!(free > 0)) return std::numeric_limits<double>::quiet_NaN();
    return rate / (bulkDensity * std::sqrt(gravity) * std::pow(free, 2.5));
}

}  // namespace vkdose
