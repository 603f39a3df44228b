#pragma once
// The frames of a run as the page's player takes them: quantised, as differences between frames, deflated, in base64.
//
// A position has 16 bits on each axis over the case's domain (error: half of size/65535), the radius 16 bits from the
// least to the largest, the height of the surface 16 bits over the domain's height. A speed has 8 bits: level 0 below
// 10 um/s, the others evenly on a logarithmic scale up to 10 m/s (2.8 % off at most). The overlap has 8 bits on the
// scale of its square root from 0 to the case's max_overlap_ratio. A property that a user's law gives particles has 8
// bits from its least to its largest value in the frame.
//
// The stream holds the radii; where there are several powders, a byte for each particle, the number of its powder; then
// for each frame x, y, z, speed, overlap and the properties of every particle and the heights of the surface; then for
// each particle the first frame without it. Values of 16 bits are stored as the low bytes of all, then the high bytes.
// Values of a frame are differences from the frame before (the first one's from 0), modulo 2^16 or 2^8. A difference of
// 16 bits has its sign in the lowest bit.

#include <functional>
#include <vector>

#include "host/model/case.h"
#include "host/output/frames.h"
#include "host/report/run_report.h"

namespace vkdose::report {

/// The frames of a run in order of time, and a function that reads one of them.
struct FrameSource {
    std::vector<FrameEntry> entries;
    std::function<Frame(const FrameEntry&)> read;
};

/// The frames in a run's output folder. Throws OutputError if they cannot be read.
FrameSource framesOf(const std::filesystem::path& run);

/// Characters that the player may take of a page, so that page and player stay below 25 MB.
inline constexpr std::size_t kMostCharacters = 22'000'000;

/// The player's data, `player` of runJson: the part that is the same in all frames, the frames' times, phases, doses
/// and coil angles, the bodies (player_bodies.h), and the stream. If all frames take more than `mostCharacters`, or
/// more than the page can hold in memory or number, only every n-th frame and the last one are taken, and the page says
/// so. `columns`: of the surface, in a case with a canister.
Json playerJson(const Case& c, const FrameSource& frames, std::size_t columns,
                std::size_t mostCharacters = kMostCharacters);

}  // namespace vkdose::report
