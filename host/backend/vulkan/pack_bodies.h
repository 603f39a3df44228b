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
    std::uint32_t places = 0;       ///< most in which a sphere touches one of them at once, or gpu::kFewPlaces if more
};

/// The table `geometry`, for spheres of radius up to `largest` [m]. `slack` [m] is how much farther from a centre a
/// pass may ask for shapes. A mesh made for a smaller reach is made anew, which takes its time. Throws RunError, naming
/// the body, for a shape that the device cannot compute with.
PackedBodies packBodies(const std::vector<RigidBody>& bodies, double largest, double slack = 0);

gpu::BodyMotion packMotion(const RigidBody& body, const geometry::Pose& pose, const geometry::Moving& moving);

}  // namespace vkdose
