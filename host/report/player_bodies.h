#pragma once
// The bodies of a case as the page's player takes them.

#include <vector>

#include "host/model/case.h"
#include "host/report/run_report.h"
#include "host/sim/frame.h"

namespace vkdose::report {

/// A body of more triangles is shown by its edges alone, so that the page stays small.
inline constexpr std::size_t kMostTriangles = 100'000;

/// For each body its name, its triangles and edges in its own frame, whether it is drawn as a pane, and its place in
/// each of `frames`, whose particles and contacts are not looked at. Numbers are single precision in base64, with the
/// lowest byte first: `points` three for each corner [m], `triangles` three 32-bit numbers of corners each, `edges` six
/// each [m], `poses` the quaternion w, x, y, z and the origin [m]. Bodies without an end are cut off a little beyond
/// powder and other bodies. `settled` is the frame by which is judged what a body hides.
Json bodiesJson(const Case& c, const std::vector<Frame>& frames, const Frame& settled);

/// The device alone in each of `frames`: `time_s`, `phase`, `dose`, `coil_angle_rad`, and `poses` of each body as
/// above. Null if nothing of it moves.
Json motionJson(const Case& c, const std::vector<Frame>& frames);

}  // namespace vkdose::report
