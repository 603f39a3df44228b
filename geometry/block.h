#pragma once

#include <vector>

#include "geometry/features.h"

namespace vkdose::geometry {

/// A box with its edges along the axes: a solid one, or the walls of a room if spheres live inside.
struct Block {
    Vec3 low{0}, high{0};
    bool inside = false;

    /// The walls of a room are six planes. A solid block is convex and touches once.
    std::vector<Feature> places(const Vec3& centre, double radius) const;
    ShapeForm form() const;
    void cut(Tessellator& into) const;
    ShapeRecord record() const;
};

}  // namespace vkdose::geometry
