#pragma once
// How far a place is from walls, coil and bodies as they stand at one instant.

#include <span>
#include <string>
#include <vector>

#include "geometry/motion.h"
#include "host/model/world.h"

namespace vkdose {

/// The nearest of them.
struct Obstacle {
    double distance = 0;  ///< of its surface [m]
    std::string what;     ///< "a wall", "the coil" or "body "NAME""
};

class Clearance {
  public:
    /// Of a world at `time` [s], when the coil has turned by `coilAngle` [rad] since the start. `world` must live as
    /// long as this.
    explicit Clearance(const World& world, double time = 0, double coilAngle = 0,
                       std::span<const BodyClock> clocks = {}, std::span<const FreeBody> free = {});

    /// What is nearest to `x` within `reach` [m]; at the distance `reach` and without a name if nothing is. Bodies of
    /// meshes are known as far as backends ask for them.
    Obstacle nearest(const Vec3& x, double reach) const;

  private:
    const World& world_;
    double coilAngle_;
    std::vector<geometry::Pose> poses_;  // of the bodies
};

}  // namespace vkdose
