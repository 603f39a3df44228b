#pragma once

#include "geometry/surface.h"

namespace vkdose::geometry {

/// Wall between two circles around an axis, without thickness and touched from both sides: a cone, a cylinder if the
/// radii are equal, a flat ring or disc if the length is zero. A radius may be zero.
struct Cone {
    Vec3 base{0};           ///< centre of the first circle
    Vec3 axis{0, 0, 1};     ///< unit
    double baseRadius = 0;  ///< [m]
    double endRadius = 0;   ///< [m]
    double length = 0;      ///< along the axis [m]

    Closest closest(const Vec3& q) const;
    ShapeForm form() const;
    void cut(Tessellator& into) const;
    ShapeRecord record() const;
};

}  // namespace vkdose::geometry
