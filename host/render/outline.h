#pragma once
// The edges of canister, tubes and planes, to be drawn as lines.

#include <vector>

#include "host/model/case.h"
#include "host/render/camera.h"

namespace vkdose::render {

using Line = std::vector<Vec3>;  ///< points of a polyline [m]

/// The edges to be drawn. Of a canister: the profile of its ends, the lines between them, the hole in front and the
/// throat. Of round surfaces: the two sides seen from `towards`. Of other surfaces: the part in `content`. In a cut,
/// edges in the part that is taken away are left out.
std::vector<Line> outlineOf(const Case& c, const Vec3& towards, const Box& content, const std::optional<CutPlane>& cut);

/// The parts of lines that a cut leaves; all without a cut.
std::vector<Line> left(std::vector<Line> lines, const std::optional<CutPlane>& cut);

}  // namespace vkdose::render
