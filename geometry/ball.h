#pragma once

#include "geometry/surface.h"

namespace vkdose::geometry {

/// A solid sphere.
struct Ball {
    Vec3 centre{0};
    double radius = 0;  ///< [m]

    Closest closest(const Vec3& q) const;
    ShapeForm form() const;
    void cut(Tessellator& into) const;
    ShapeRecord record() const;
};

}  // namespace vkdose::geometry
