#pragma once
// The edges of canister, tubes and planes, to be drawn as lines.

#include <vector>

#include "host/model/case.h"
#include "host/render/camera.h"

namespace vkdose::render {

using Line = std::vector<Vec3>;  ///< points of a polyline [m]

/// Of a canister the profile of its ends, what joins them, the hole in front and the throat; of round ones the two
/// sides seen from `towards`. Of other surfaces what lies in `content`. In a cut, what is taken away is left out.
std::vector<Line> outlineOf(const Case& c, const Vec3& towards, const Box& content, const std::optional<CutPlane>& cut);

}  // namespace vkdose::render
