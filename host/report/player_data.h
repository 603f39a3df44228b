#pragma once
// The frames of a run as the page's player takes them: quantised, as differences between frames, deflated, in base64.
//
// A position has 16 bits on each axis over the case's domain (error: half of size/65535), the radius 16 bits from the
// least to the largest, the height of the surface 16 bits over the domain's height. A speed has 8 bits: level 0 below
// 10 um/s, the others evenly on a logarithmic scale up to 10 m/s (2.8 % off at most). The overlap has 8 bits on the
// scale of its square root from 0 to the case's max_overlap_ratio.
//
// The stream: radii; for each frame x, y, z, speed, overlap of every particle and the heights of the surface; for each
// particle the frame in which it was no longer there. 16 bits are the low bytes of all, then the high bytes. Whatever
// belongs to a frame is the difference from the frame before (the first one's from 0), modulo 2^16 or 2^8, and with 16
// bits its sign in the lowest bit.

#include <functional>
#include <vector>

#include "host/model/case.h"
#include "host/output/frames.h"
#include "host/report/run_report.h"

namespace vkdose::report {

/// The frames of a run in order of time, and what reads one of them.
struct FrameSource {
    std::vector<FrameEntry> entries;
    std::function<Frame(const FrameEntry&)> read;
};

/// Those in a run's output folder; none if it kept none. Throws OutputError if what is there cannot be read.
FrameSource framesOf(const std::filesystem::path& run);

/// Characters that the player may take of a page, so that page and player stay below 25 MB.
inline constexpr std::size_t kMostCharacters = 22'000'000;

/// The player's data, `player` of runJson: the part that is the same in all frames, the frames' times, phases,
/// doses and coil angles, and the stream. Only every n-th frame and the last one if all of them take more than
/// `mostCharacters`, or more than the page can hold in memory or number; the page says so. `columns`: of the surface,
/// in a case with a canister.
Json playerJson(const Case& c, const FrameSource& frames, std::size_t columns,
                std::size_t mostCharacters = kMostCharacters);

}  // namespace vkdose::report
