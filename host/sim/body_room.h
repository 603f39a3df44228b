#pragma once
// The room that bodies keep from the powder. One rule for all that asks where the bed is: it keeps away from bodies as
// it does from walls and coil.

#include <cstdint>
#include <vector>

#include "geometry/motion.h"
#include "host/model/world.h"

namespace vkdose {

/// Where the bodies of a world are: of each its pose.
using BodyPoses = std::vector<geometry::Pose>;

/// `time` [s], `driveAngle` [rad]; `moved`: what neither tells, of each body, or none.
BodyPoses bodyPoses(const World& world, double time, double driveAngle, const std::vector<Moved>& moved = {});

/// Which parts of a box are too near to a body for a bed, or closed off by one. The box is cut into cubes half a mean
/// radius wide. A cube is taken if all of it is within `margin` of the surface of a body. It is taken too if no sphere
/// can come to it: nothing but taken cubes lies between it and every cube with the centre of a sphere. So the inside of
/// a closed mesh, or of a hub made of discs and a cylinder, is no room for powder, unless powder is in it.
class BodyRoom {
  public:
    /// Nothing is taken without bodies. `poses`: of World::bodies, at the start of those that it lacks. `radius`: mean
    /// radius of the particles [m].
    BodyRoom(const World& world, const BodyPoses& poses, const Particles& particles, const Box& box, double radius,
             double margin);

    /// Whether the point lies in a part that is taken.
    bool takes(const Vec3& x) const {
        if (taken_.empty()) return false;
        const Vec3 cell = (x - low_) / side_;
        if (cell.x < 0 || cell.y < 0 || cell.z < 0) return false;
        const glm::ivec3 i(cell);
        return i.x < cells_.x && i.y < cells_.y && i.z < cells_.z && taken_[index(i)] != 0;
    }

    /// Whether a part over these of x and z is taken [m].
    bool takesAnyOver(double xFrom, double xTo, double zFrom, double zTo) const;

    /// Volume of what is taken of the region for which `holds(point)` is true [m3]. Each cube is looked at in 4 x 4 x 4
    /// points.
    template <class Holds>
    double volume(const Holds& holds) const {
        constexpr int kFine = 4;
        std::size_t count = 0;
        for (int i = 0; i < cells_.x; ++i)
            for (int j = 0; j < cells_.y; ++j)
                for (int k = 0; k < cells_.z; ++k) {
                    if (taken_[index({i, j, k})] == 0) continue;
                    for (int point = 0; point < kFine * kFine * kFine; ++point) {
                        const Vec3 at(point % kFine, point / kFine % kFine, point / (kFine * kFine));
                        if (holds(low_ + side_ * (Vec3(i, j, k) + (at + 0.5) / double(kFine)))) ++count;
                    }
                }
        return static_cast<double>(count) * side_ * side_ * side_ / (kFine * kFine * kFine);
    }

  private:
    std::size_t index(const glm::ivec3& i) const {
        return (std::size_t(i.x) * std::size_t(cells_.y) + std::size_t(i.y)) * std::size_t(cells_.z) + std::size_t(i.z);
    }
    void takeNear(const RigidBody& body, const geometry::Pose& pose, double reach);
    void takeClosedOff(const Particles& particles);

    Vec3 low_{0};
    double side_ = 1;  ///< of a cube [m]
    glm::ivec3 cells_{0};
    std::vector<std::uint8_t> taken_;  ///< empty: nothing is
};

}  // namespace vkdose
