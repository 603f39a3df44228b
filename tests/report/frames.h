#pragma once
// Frames of a run made by hand.

#include <utility>
#include <vector>

#include "host/report/player_data.h"

namespace vkdose::test {

/// A frame in which nothing has contacts; number and step follow from its place in the list.
inline Frame frameOf(double time, int dose, double coilAngle, const Particles& particles) {
    Frame frame;
    frame.time = time;
    frame.phase = dose == 0 ? Phase::Settle : Phase::Rotate;
    frame.dose = dose;
    frame.coilAngle = coilAngle;
    frame.particles = particles;
    return frame;
}

inline report::FrameSource sourceOf(std::vector<Frame> frames) {
    report::FrameSource source;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        frames[i].step = 10 * i;
        source.entries.push_back({static_cast<int>(i), frames[i].step, frames[i].time, frames[i].phase, frames[i].dose,
                                  frames[i].coilAngle});
    }
    source.read = [frames = std::move(frames)](const FrameEntry& entry) { return frames.at(entry.number); };
    return source;
}

}  // namespace vkdose::test
