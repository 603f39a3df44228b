#include "geometry/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vkdose::geometry {

namespace {

/// A motion at its own time: turned by `angle` about a line, then shifted.
struct Displacement {
    Vec3 axis{0, 0, 1}, through{0};
    double angle = 0;         ///< [rad]
    double angleRate = 0;     ///< [rad/s]
    Vec3 shift{0}, speed{0};  ///< [m], [m/s]
};

double wave(double frequency, double phase, double t) {
    // Whole periods are dropped first, as far as a double holds them.
    return 2 * kPi * (frequency * t - std::floor(frequency * t)) + phase;
}

/// The two rows around a time; the same one twice before the first and after the last.
template <class Row>
class Between {
  public:
    Between(const std::vector<Row>& rows, double time) {
        const auto next =
            std::upper_bound(rows.begin(), rows.end(), time, [](double t, const Row& row) { return t < row.time; });
        a_ = next == rows.begin() ? &rows.front() : &next[-1];
        b_ = next == rows.end() ? &rows.back() : &*next;
        span_ = b_->time - a_->time;
        share_ = span_ > 0 ? (time - a_->time) / span_ : 0;
    }
    template <class T>
    T value(T Row::*member) const {
        return a_->*member + share_ * (b_->*member - a_->*member);
    }
    template <class T>
    T rate(T Row::*member) const {
        return span_ > 0 ? (b_->*member - a_->*member) / span_ : T(0);
    }

  private:
    const Row *a_, *b_;
    double span_ = 0, share_ = 0;
};

Displacement at(const Rest&, double) {
    return {};
}

Displacement at(const Turn& m, double t) {
    const double turns = m.rate / (2 * kPi) * t;
    return {m.axis, m.through, 2 * kPi * (turns - std::round(turns)), m.rate, Vec3(0), Vec3(0)};
}

Displacement at(const Swing& m, double t) {
    const double w = wave(m.frequency, m.phase, t);
    return {m.axis,  m.through, m.amplitude * std::sin(w), m.amplitude * 2 * kPi * m.frequency * std::cos(w),
            Vec3(0), Vec3(0)};
}

Displacement at(const Shake& m, double t) {
    const double w = wave(m.frequency, m.phase, t);
    Displacement d;
    d.shift = m.amplitude * std::sin(w) * m.direction;
    d.speed = m.amplitude * 2 * kPi * m.frequency * std::cos(w) * m.direction;
    return d;
}

Displacement at(const Slide& m, double t) {
    Displacement d;
    d.shift = t * m.velocity;
    d.speed = m.velocity;
    return d;
}

Displacement at(const Table& m, double t) {
    Displacement d;
    d.axis = m.axis;
    d.through = m.through;
    if (m.rows.empty()) return d;
    const Between<Table::Row> rows(m.rows, t);
    d.angle = rows.value(&Table::Row::angle);
    d.shift = rows.value(&Table::Row::shift);
    d.angleRate = rows.rate(&Table::Row::angle);
    d.speed = rows.rate(&Table::Row::shift);
    return d;
}

Displacement at(const Free& m, double t) {
    Displacement d;
    if (!m.line || m.rows.empty()) return d;
    const Between<Free::Row> rows(m.rows, t);
    d.axis = *m.line;
    d.through = m.through;
    d.angle = rows.value(&Free::Row::angle);
    d.angleRate = rows.rate(&Free::Row::angle);
    return d;
}

Displacement at(const Hinge& m, double) {
    Displacement d;
    d.axis = m.axis;
    d.through = m.through;
    return d;
}

Displacement displacement(const Motion& motion, double t) {
    return std::visit([&](const auto& m) { return at(m, t); }, motion);
}

/// Largest rates of angle [rad/s] and shift [m/s] between two times of the motion's own clock.
struct Rates {
    double angle = 0, shift = 0;
};

Rates largestRates(const Motion& motion, double from, double to) {
    if (const auto* turn = std::get_if<Turn>(&motion)) return {std::abs(turn->rate), 0};
    if (const auto* slide = std::get_if<Slide>(&motion)) return {0, glm::length(slide->velocity)};
    if (const auto* swing = std::get_if<Swing>(&motion))
        return {std::abs(swing->amplitude * 2 * kPi * swing->frequency), 0};
    if (const auto* shake = std::get_if<Shake>(&motion))
        return {0, std::abs(shake->amplitude * 2 * kPi * shake->frequency)};
    Rates rates;
    const auto raise = [&](const auto& rows, auto shiftOf) {
        for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
            const auto &a = rows[i], &b = rows[i + 1];
            if (b.time <= from || a.time >= to) continue;
            rates.angle = std::max(rates.angle, std::abs(b.angle - a.angle) / (b.time - a.time));
            rates.shift = std::max(rates.shift, glm::length(shiftOf(b) - shiftOf(a)) / (b.time - a.time));
        }
    };
    if (const auto* table = std::get_if<Table>(&motion))
        raise(table->rows, [](const Table::Row& row) { return row.shift; });
    if (const auto* free = std::get_if<Free>(&motion)) raise(free->rows, [](const Free::Row&) { return Vec3(0); });
    return rates;
}

bool finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::string axisFault(const Vec3& axis, const Vec3& through) {
    if (!finite(axis) || !finite(through)) return "an axis is not finite";
    if (std::abs(glm::length(axis) - 1) > 1e-9) return "an axis must be a unit vector";
    return "";
}

std::string fault(const Rest&) {
    return "";
}

std::string fault(const Turn& m) {
    return std::isfinite(m.rate) ? axisFault(m.axis, m.through) : "the rate is not finite";
}

std::string fault(const Slide& m) {
    return finite(m.velocity) ? "" : "the velocity is not finite";
}

/// `isFinite`: whether the numbers of a row are, beside its time.
template <class Row, class IsFinite>
std::string rowsFault(const std::vector<Row>& rows, IsFinite isFinite) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!std::isfinite(rows[i].time) || !isFinite(rows[i]))
            return fmt::format("row {} of the table is not finite", i + 1);
        if (i > 0 && rows[i].time <= rows[i - 1].time)
            return fmt::format("row {} of the table is not later than the row before", i + 1);
    }
    return "";
}

std::string fault(const Free& m) {
    if (!std::isfinite(m.mass) || !finite(m.velocity)) return "mass and velocity must be finite";
    if (m.mass <= 0) return "the mass must be positive";
    if (!(m.damping >= 0) || !std::isfinite(m.damping)) return "the damping must be finite and not negative";
    if (!m.line) return m.rows.empty() ? "" : "a force or a turn needs a line";
    if (!(m.low <= 0 && m.high >= 0)) return "the body begins beyond its stops";
    const auto isFinite = [](const Free::Row& row) { return std::isfinite(row.force) && std::isfinite(row.angle); };
    if (std::string said = rowsFault(m.rows, isFinite); !said.empty()) return said;
    if (std::string said = axisFault(*m.line, Vec3(0)); !said.empty()) return said;
    const double speed = glm::length(m.velocity);
    return glm::length(glm::cross(*m.line, m.velocity)) <= 1e-9 * speed ? "" : "the velocity leads off the line";
}

std::string fault(const Hinge& m) {
    if (!std::isfinite(m.inertia) || !std::isfinite(m.rate) || !std::isfinite(m.mass) || !finite(m.centre))
        return "inertia, rate, mass and centre must be finite";
    if (m.inertia <= 0) return "the moment of inertia must be positive";
    if (m.mass < 0) return "the mass must not be negative";
    if (!(m.damping >= 0) || !std::isfinite(m.damping)) return "the damping must be finite and not negative";
    if (!(m.low <= 0 && m.high >= 0)) return "the body begins beyond its stops";
    const auto isFinite = [](const Hinge::Row& row) { return std::isfinite(row.torque); };
    if (std::string said = rowsFault(m.rows, isFinite); !said.empty()) return said;
    return axisFault(m.axis, m.through);
}

std::string waveFault(double amplitude, double frequency, double phase) {
    if (!std::isfinite(amplitude) || !std::isfinite(frequency) || !std::isfinite(phase))
        return "amplitude, frequency and phase must be finite";
    return frequency < 0 ? "the frequency must not be negative" : "";
}

std::string fault(const Swing& m) {
    const std::string said = waveFault(m.amplitude, m.frequency, m.phase);
    return said.empty() ? axisFault(m.axis, m.through) : said;
}

std::string fault(const Shake& m) {
    const std::string said = waveFault(m.amplitude, m.frequency, m.phase);
    return said.empty() ? axisFault(m.direction, Vec3(0)) : said;
}

std::string fault(const Table& m) {
    if (m.rows.size() < 2) return "a table of motion needs two rows or more";
    const auto isFinite = [](const Table::Row& row) { return std::isfinite(row.angle) && finite(row.shift); };
    if (std::string said = rowsFault(m.rows, isFinite); !said.empty()) return said;
    return axisFault(m.axis, m.through);
}

}  // namespace

std::optional<double> periodOf(const Motion& motion) {
    double frequency = 0;  // [Hz]
    if (const auto* turn = std::get_if<Turn>(&motion)) frequency = std::abs(turn->rate) / (2 * kPi);
    if (const auto* swing = std::get_if<Swing>(&motion)) frequency = swing->frequency;
    if (const auto* shake = std::get_if<Shake>(&motion)) frequency = shake->frequency;
    return frequency > 0 ? std::optional(1 / frequency) : std::nullopt;
}

double Free::force(double time) const {
    return rows.empty() ? 0 : Between<Row>(rows, time).value(&Row::force);
}

double Hinge::torque(double time) const {
    return rows.empty() ? 0 : Between<Row>(rows, time).value(&Row::torque);
}

glm::dvec2 Hinge::weight(const Vec3& gravity) const {
    const Vec3 arm = centre - through, pull = mass * gravity;
    return {glm::dot(axis, glm::cross(arm - glm::dot(arm, axis) * axis, pull)),
            glm::dot(axis, glm::cross(glm::cross(axis, arm), pull))};
}

double stoppedAt(double low, double high, double way, double speed, double timeStep) {
    const double room = speed > 0 ? high - way : way - low;
    if (std::abs(speed) * timeStep <= room) return speed;
    return room > kAtStop ? std::copysign(room / timeStep, speed) : 0;
}

double Schedule::elapsed(double time) const {
    if (intervals.empty()) return time;
    double sum = 0;
    for (const Interval& i : intervals) sum += std::max(0.0, std::min(time, i.to) - i.from);
    return sum;
}

bool Schedule::active(double time) const {
    return intervals.empty() || std::any_of(intervals.begin(), intervals.end(),
                                            [&](const Interval& i) { return time >= i.from && time < i.to; });
}

Pose Course::pose(double time) const {
    const Displacement d = displacement(motion, schedule.elapsed(time));
    Pose pose = turned(start, d.axis, d.through, d.angle);
    pose.origin += d.shift;
    return pose;
}

Moving Course::moving(double time) const {
    if (!schedule.active(time)) return {};
    const Displacement d = displacement(motion, schedule.elapsed(time));
    return {d.speed, d.angleRate * d.axis, d.through + d.shift};
}

double Course::drive(double time) const {
    if (!schedule.active(time)) return 0;
    if (const auto* free = std::get_if<Free>(&motion)) return free->force(schedule.elapsed(time));
    if (const auto* hinge = std::get_if<Hinge>(&motion)) return hinge->torque(schedule.elapsed(time));
    return 0;
}

Pose turned(const Pose& pose, const Vec3& axis, const Vec3& through, double angle) {
    const Rotation turn = glm::angleAxis(angle, axis);
    return {turn * pose.rotation, through + turn * (pose.origin - through)};
}

double wayBound(const Course& course, const Vec3& centre, double radius, double time, double duration) {
    const double from = course.schedule.elapsed(time), to = course.schedule.elapsed(time + duration);
    if (to <= from) return 0;
    const Rates rates = largestRates(course.motion, from, to);
    // The distance of a point from the axis stays what it is at the start.
    const Displacement d = displacement(course.motion, 0);
    const Vec3 from0 = course.start.toWorld(centre) - d.through;
    const double lever = glm::length(from0 - glm::dot(from0, d.axis) * d.axis) + radius;
    return (rates.angle * lever + rates.shift) * (to - from);
}

std::string motionFault(const Motion& motion) {
    return std::visit([](const auto& m) { return fault(m); }, motion);
}

std::string scheduleFault(const Schedule& schedule) {
    for (std::size_t i = 0; i < schedule.intervals.size(); ++i) {
        const Schedule::Interval& now = schedule.intervals[i];
        if (!(now.from < now.to)) return fmt::format("interval {} ends before it begins", i + 1);
        if (i > 0 && now.from < schedule.intervals[i - 1].to)
            return fmt::format("interval {} begins before the one before has ended", i + 1);
    }
    return "";
}

}  // namespace vkdose::geometry
