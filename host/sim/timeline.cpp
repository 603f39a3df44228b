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

Timeline::Timeline(const Case& c) : timeStep_(c.world.timeStep), settlingLaw_(c.settlingLaw), dosingLaw_(c.dosingLaw) {
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
    end_ = hasDoses() ? endTime_ : std::min(endTime_, settle_);
    if (c.world.coil) {
        rate_ = geometry::conveyingRate(*c.world.coil, c.schedule.coilSpeed);
        sense_ = geometry::conveyingRate(*c.world.coil, 1.0) < 0 ? -1.0 : 1.0;
    } else {
        rate_ = c.schedule.coilSpeed;
    }
}

Timeline::Stretch Timeline::at(std::uint64_t step) const {
    if (step < settle_ || !hasDoses()) return {Phase::Settle, 0, std::min(settle_, end_), 0.0, &settlingLaw_};
    const std::uint64_t dose = (step - settle_) / cycle();
    const std::uint64_t start = settle_ + dose * cycle();
    const bool rotating = step - start < rotate_;
    const std::uint64_t phaseEnd = start + (rotating ? rotate_ : cycle());
    return {rotating ? Phase::Rotate : Phase::Rest, static_cast<int>(dose) + 1, std::min(phaseEnd, end_),
            rotating ? rate_ : 0.0, &dosingLaw_};
}

std::uint64_t Timeline::nextSample(std::uint64_t step) const {
    return std::min((step / sensor_ + 1) * sensor_, at(step).end);
}

bool Timeline::frameDue(std::uint64_t step) const {
    return keepsFrames() && (step % frame_ == 0 || step == settle_ || over(step));
}

std::uint64_t Timeline::stepsUntilDose(double doses) const {
    const double steps = static_cast<double>(settle_) + doses * static_cast<double>(cycle());
    return steps < static_cast<double>(end_) ? static_cast<std::uint64_t>(steps) : end_;
}

}  // namespace vkdose
