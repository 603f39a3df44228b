#include "host/analysis/turning_flow.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vkdose {

namespace {

/// So much of the last part may be missing: whole turns are given in rounded seconds, and made in whole steps.
constexpr double kAlmost = 0.01;

}  // namespace

std::optional<double> countedFrom(const Case& c) {
    if (c.schedule.rotateTime > 0) return {};
    double from = std::numeric_limits<double>::infinity();
    for (const RigidBody& body : c.world.bodies) {
        if (body.rests()) continue;
        const auto& intervals = body.course.schedule.intervals;
        from = std::min(from, body.clock == Clock::Time && !intervals.empty() ? intervals.front().from : 0.0);
    }
    return std::isfinite(from) ? from : 0.0;
}

TurningFlow::TurningFlow(const std::vector<FlowSample>& samples, By by, std::optional<double> from) {
    FlowSample before;
    if (from && (samples.empty() || samples.back().dosed == 0)) return;
    for (const FlowSample& s : samples) {
        const bool empty = &s != &samples.front() && before.inside == 0;
        const bool counted = from && before.time >= *from * (1 - 1e-9);
        if ((s.turning || counted) && !empty) add(before, s, by);
        before = s;
    }
}

std::vector<TurningFlow::Part> TurningFlow::parts(double length) const {
    std::vector<Part> list;
    if (lines_.empty()) return list;
    std::size_t line = 0;
    Place from = at(0, 0);
    for (int k = 1; k * length <= this->length() + kAlmost * length; ++k) {
        const double begin = (k - 1) * length, end = std::min(k * length, this->length());
        // A part in 10^9 is rounding of the sum of lines.
        while (line + 1 < lines_.size() && lines_[line].turned < end * (1 - 1e-9)) ++line;
        const Place to = within(line, end);
        list.push_back({from.time, to.time, end - begin, to.mass - from.mass, from.left});
        const bool atEnd = lines_[line].turned <= end * (1 + 1e-9);
        from = atEnd && line + 1 < lines_.size() ? at(line + 1, 0) : to;
    }
    return list;
}

void TurningFlow::add(const FlowSample& before, const FlowSample& s, By by) {
    const double own = by == By::Time ? s.time - before.time : std::abs(s.angle - before.angle);
    const double mass = s.dosed - before.dosed;
    const Line last = lines_.empty() ? Line{} : lines_.back();
    if (own > 0) {
        lines_.push_back({before.time, s.time, last.turned + own, own, last.mass + mass, mass, s.inside});
    } else if (!lines_.empty()) {  // a drive at the speed 0: what falls counts to the angle before
        lines_.back().mass += mass;
        lines_.back().ownMass += mass;
        lines_.back().left = s.inside;
    }
}

TurningFlow::Place TurningFlow::at(std::size_t line, double share) const {
    const Line& l = lines_[line];
    const double rest = (1 - share) * l.ownMass;
    return {l.from + share * (l.to - l.from), l.mass - rest, l.left + rest};
}

TurningFlow::Place TurningFlow::within(std::size_t line, double turned) const {
    const Line& l = lines_[line];
    return at(line, std::min(1.0, 1 - (l.turned - turned) / l.own));
}

}  // namespace vkdose
