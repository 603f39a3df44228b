#include "host/sim/planned_motion.h"

#include <algorithm>
#include <cmath>

#include "host/sim/body_clocks.h"

namespace vkdose {

namespace {

constexpr double kLongest = 10;                    // [s]
constexpr double kBetween = 0.04;                  // from frame to frame [s]
constexpr double kFewFrames = 100, kFrames = 250;  // a short motion is shown slowly

}  // namespace

std::vector<Frame> plannedMotion(const Case& c) {
    const Timeline timeline(c);
    BodyClocks clocks(c.world);
    const double step = c.world.timeStep;
    const std::uint64_t begin = timeline.hasDoses() ? timeline.settleSteps() : 0;
    const std::uint64_t planned = timeline.hasDoses() ? timeline.stepsUntilDose(1) : timeline.settleSteps();
    const std::uint64_t end = std::min(planned, begin + static_cast<std::uint64_t>(kLongest / step));
    std::vector<Frame> frames;
    if (end <= begin) return frames;
    const double time = static_cast<double>(end - begin) * step;
    const auto count = static_cast<std::uint64_t>(std::clamp(std::round(time / kBetween), kFewFrames, kFrames));
    double angle = 0;
    Phase phase = Phase::Settle;  // before the next frame
    int dose = 0;
    for (std::uint64_t now = 0; !timeline.over(now) && frames.size() <= count;) {
        const Timeline::Stretch stretch = timeline.at(now);
        const std::uint64_t next = begin + (end - begin) * frames.size() / count;
        if (now == next) {
            Frame& frame = frames.emplace_back();
            frame.step = now;
            frame.time = timeline.time(now);
            frame.phase = phase;
            frame.dose = dose;
            frame.coilAngle = angle;
            for (const double t : clocks.times()) frame.bodiesMoved.emplace_back(t);
            continue;
        }
        const std::uint64_t steps = std::min(stretch.pieceEnd, next) - now;
        phase = stretch.phase;
        dose = stretch.dose;
        clocks.enter(phase, dose);
        clocks.count(steps);
        angle += stretch.rate * static_cast<double>(steps) * step;
        now += steps;
    }
    return frames;
}

}  // namespace vkdose
