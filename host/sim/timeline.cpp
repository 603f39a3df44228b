#include "host/sim/timeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/error.h"

namespace vkdose {

namespace {

[[noreturn]] void refuse(const char* key, double value, std::string problem, std::string remedy) {
    throw CaseError({Diagnostic{"schedule", 0, key, fmt::format("{}", value), std::move(problem), std::move(remedy)}});
}

/// Nearest whole number of steps. Refuses a duration too short for one step, because it would silently vanish.
std::uint64_t wholeSteps(const char* key, double duration, double timeStep) {
    if (!(duration >= 0)) refuse(key, duration, "is not a duration", "give a time >= 0 in seconds");
    const double steps = std::round(duration / timeStep);
    if (duration > 0 && steps < 1) {
        refuse(key, duration, "is shorter than half a time step", fmt::format("use 0 or at least {} s", timeStep));
    }
    if (!(steps < 9e15)) refuse(key, duration, "is more steps than can be counted", "shorten it");
    return static_cast<std::uint64_t>(steps);
}

}  // namespace

Timeline::Timeline(const Case& c)
    : timeStep_(c.world.timeStep),
      firstSpeed_(c.schedule.stages.empty() ? c.schedule.coilSpeed : c.schedule.stages.front().speed),
      reverseSpeed_(c.schedule.coilSpeed),
      coil_(c.world.coil),
      settlingLaw_(c.settlingLaw),
      dosingLaw_(c.dosingLaw),
      settlingGravity_(c.settlingGravity()),
      dosingGravity_(c.world.gravity) {
    if (!(timeStep_ > 0)) refuse("time_step", timeStep_, "is not positive", "give a time step > 0 in seconds");
    if (!(c.sensorInterval > 0)) refuse("sensor_interval", c.sensorInterval, "is not positive", "give a time > 0");
    settle_ = wholeSteps("settle_time", c.schedule.settleTime, timeStep_);
    rotate_ = wholeSteps("rotate_time", c.schedule.rotateTime, timeStep_);
    rest_ = wholeSteps("rest_time", c.schedule.restTime, timeStep_);
    sensor_ = wholeSteps("sensor_interval", c.sensorInterval, timeStep_);
    if (c.schedule.stop.endTime < std::numeric_limits<double>::infinity()) {
        endTime_ = wholeSteps("end_time", c.schedule.stop.endTime, timeStep_);
    }
    if (c.frames.interval > 0)
        frame_ = sensor_ * std::max<std::uint64_t>(1, wholeSteps("frame_interval", c.frames.interval,
                                                                 static_cast<double>(sensor_) * timeStep_));
    if (hasDoses()) ramp_ = wholeSteps("ramp_time", c.schedule.rampTime, timeStep_);
    if (hasDoses() && c.schedule.reverseTurns > 0)
        reverse_ = wholeSteps("reverse_time", c.schedule.reverseTime(), timeStep_);
    endSettling(settle_);
    if (coil_)
        sense_ = geometry::conveyingRate(*c.world.coil, 1.0) < 0 ? -1.0 : 1.0;
    else if (followsDrive(c.world.bodies))
        sense_ = 1;
}

void Timeline::endSettling(std::uint64_t step) {
    settle_ = step;
    end_ = hasDoses() ? endTime_ : std::min(endTime_, settle_);
    dose_ = planned(1, settle_);
}

Timeline::DosePlan Timeline::planned(int dose, std::uint64_t start) const {
    DosePlan plan{dose, start, 0, 0, 0, 0, {0, firstSpeed_, start}};
    return stopped(plan, start + rotate_ - std::min(ramp_, rotate_));
}

Timeline::DosePlan Timeline::stopped(DosePlan dose, std::uint64_t stop) const {
    dose.stop = stop;
    dose.turned = stop + ramp_;
    dose.reversed = dose.turned + reverse_;
    dose.end = dose.reversed + rest_;
    return dose;
}

Timeline::DosePlan Timeline::doseAt(std::uint64_t step) const {
    if (step < dose_.end || !hasDoses()) return dose_;
    const std::uint64_t later = (step - dose_.end) / cycle();
    return planned(dose_.dose + 1 + static_cast<int>(later), dose_.end + later * cycle());
}

double Timeline::speedAt(const Change& change, std::uint64_t step) const {
    if (step >= change.since + ramp_) return change.to;
    return change.from +
           (change.to - change.from) * static_cast<double>(step - change.since) / static_cast<double>(ramp_);
}

/// Each piece has the mean speed of its part of the ramp, so that the coil turns as far as on the ramp itself.
Timeline::Piece Timeline::pieceAt(const Change& change, std::uint64_t step) const {
    if (step >= change.since + ramp_) return {change.to, kNever};
    const std::uint64_t pieces = std::min(ramp_, kRampPieces);
    const std::uint64_t piece = ((step - change.since + 1) * pieces - 1) / ramp_;
    const std::uint64_t begin = piece * ramp_ / pieces, end = (piece + 1) * ramp_ / pieces;
    const double middle = static_cast<double>(begin + end) / static_cast<double>(2 * ramp_);
    return {change.from + (change.to - change.from) * middle, change.since + end};
}

double Timeline::rateOf(double speed) const {
    return coil_ ? geometry::conveyingRate(*coil_, speed) : speed;  // of bodies that follow the drive
}

Timeline::Stretch Timeline::at(std::uint64_t step) const {
    if (step < settle_ || !hasDoses()) {
        const std::uint64_t end = std::min(settle_, end_);
        return {Phase::Settle, 0, end, 0.0, &settlingLaw_, settlingGravity_, end};
    }
    const DosePlan d = doseAt(step);
    Stretch s{Phase::Rest, d.dose, d.end, 0.0, &dosingLaw_, dosingGravity_, kNever};
    if (step < d.turned) {
        s.phase = Phase::Rotate;
        s.end = d.turned;
        s.stop = d.stop;
        const bool told = step >= d.stop;
        const Piece piece = pieceAt(told ? Change{speedAt(d.speed, d.stop), 0, d.stop} : d.speed, step);
        s.rate = rateOf(piece.speed);
        s.pieceEnd = told ? piece.end : std::min(piece.end, d.stop);
    } else if (step < d.reversed) {
        s.phase = Phase::Reverse;
        s.end = d.reversed;
        const std::uint64_t stop = d.reversed - ramp_;
        const bool slows = step >= stop;
        const Piece piece =
            pieceAt(slows ? Change{-reverseSpeed_, 0, stop} : Change{0, -reverseSpeed_, d.turned}, step);
        s.rate = rateOf(piece.speed);
        s.pieceEnd = slows ? piece.end : std::min(piece.end, stop);
    }
    s.closesDose = s.end == d.end;
    if (s.end > end_) s.closesDose = false;
    s.end = std::min(s.end, end_);
    s.pieceEnd = std::min(s.pieceEnd, s.end);
    return s;
}

void Timeline::changeSpeed(std::uint64_t step, double speed) {
    dose_ = doseAt(step);
    dose_.speed = {speedAt(dose_.speed, step), speed, step};
}

void Timeline::stopTurning(std::uint64_t step) {
    // A step that ends a phase belongs to the phase before it: the coil turned until then.
    dose_ = stopped(doseAt(step - 1), step);
}

void Timeline::save(Record& record) const {
    const DosePlan& d = dose_;
    record.put("schedule", std::vector<std::uint64_t>{settle_, static_cast<std::uint64_t>(d.dose), d.start, d.stop,
                                                      d.turned, d.reversed, d.end, d.speed.since});
    record.put("schedule_speeds", std::vector<double>{d.speed.from, d.speed.to});
}

void Timeline::restore(const Record& record) {
    const auto& steps = record.get<std::uint64_t>("schedule", 8);
    const auto& speeds = record.get<double>("schedule_speeds", 2);
    endSettling(steps[0]);
    dose_ = {static_cast<int>(steps[1]),      steps[2], steps[3], steps[4], steps[5], steps[6],
             {speeds[0], speeds[1], steps[7]}};
}

std::uint64_t Timeline::nextSample(std::uint64_t step) const {
    const Stretch s = at(step);
    const std::uint64_t next = std::min((step / sensor_ + 1) * sensor_, s.end);
    return s.phase == Phase::Rotate && step < s.stop ? std::min(next, s.stop) : next;
}

bool Timeline::frameDue(std::uint64_t step) const {
    return keepsFrames() && (step % frame_ == 0 || step == settle_ || over(step));
}

std::uint64_t Timeline::stepsUntilDose(double doses) const {
    const double steps = static_cast<double>(dose_.end) + (doses - dose_.dose) * static_cast<double>(cycle());
    return steps < static_cast<double>(end_) ? static_cast<std::uint64_t>(steps) : end_;
}

}  // namespace vkdose
