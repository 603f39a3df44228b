#pragma once
// The bodies of a case as they are drawn, and which of them are seen through.

#include <vector>

#include "host/model/case.h"
#include "host/model/skin.h"
#include "host/sim/frame.h"

namespace vkdose {

/// A body of the case. Its skin is in its own frame.
struct DrawnBody {
    std::size_t index = 0;  ///< in World::bodies
    Skin skin;              ///< of the shapes that have an end
    bool seeThrough = false;
    std::size_t looked = 0, hidden = 0;  ///< particles that were looked for, and those behind the body
};
std::vector<DrawnBody> bodiesOf(const Case& c);

/// The shapes without an end, cut off at a box of the world.
Skin endlessSkin(const RigidBody& body, const geometry::Pose& pose, const Box& content);

/// Counts how much of the powder each body hides from a viewer, and makes those see-through that have hidden more than
/// half of it in all frames so far. So a picture shows the powder, whatever holds it.
void lookThrough(std::vector<DrawnBody>& bodies, const Case& c, const Frame& frame, const Vec3& towards,
                 const Box& content);

geometry::Pose poseOf(const DrawnBody& body, const Case& c, const Frame& frame);

}  // namespace vkdose
