#pragma once
// Bodies in the device's layout (shaders/shared/geometry.h).

#include <cstdint>
#include <vector>

#include "host/model/rigid_body.h"
#include "shaders/shared/geometry.h"

namespace vkdose {

struct PackedBodies {
    std::vector<gpu::uvec4> table;  ///< never empty
    std::uint32_t kinds = 0;        ///< a bit for each kind of shape that there is (gpu::kShapePlane ...)
};

/// The table `geometry`. `reach` [m] is the largest distance from a centre at which a pass asks for shapes: the largest
/// radius and the slack. A mesh made for a smaller reach is made anew for this one, which takes its time. Throws
/// RunError, naming the body, for a shape that the device cannot compute with.
PackedBodies packBodies(const std::vector<RigidBody>& bodies, double reach);

gpu::BodyMotion packMotion(const geometry::Pose& pose, const geometry::Moving& moving);

}  // namespace vkdose
