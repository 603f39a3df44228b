#pragma once
// The blade of a screw: a solid wound around the z axis, cut by every half plane through the axis in a rectangle.

#include <vector>

#include "geometry/features.h"

namespace vkdose::geometry {

/// At blade angle theta in [0, angle] the blade fills, in the half plane through z at azimuth startAngle + hand theta,
/// the radii from innerRadius to outerRadius and the heights within thickness/2 of
///   z = zStart + (pitchStart theta + (pitchEnd - pitchStart) theta^2 / (2 angle)) / (2 pi).
/// The shaft is a shape of its own: a cylinder of the inner radius.
struct Flight {
    double innerRadius = 0;  ///< [m]
    double outerRadius = 0;
    double thickness = 0;   ///< along z [m]
    double pitchStart = 0;  ///< [m per turn], positive; it changes evenly with the angle
    double pitchEnd = 0;
    double angle = 0;  ///< from end to end [rad]
    double zStart = 0;
    double startAngle = 0;  ///< [rad]
    int hand = 1;           ///< +1 right-handed, -1 left-handed

    double height(double theta) const;  ///< z of the blade's middle [m]
    double slope(double theta) const;   ///< its derivative [m/rad]

    /// The key of a place is the number of its turn.
    std::vector<Feature> places(const Vec3& centre, double radius) const;
    ShapeForm form() const;
    /// A solid with all its faces, without the shaft.
    void cut(Tessellator& into) const;
};

/// A local minimum of the distance to the blade, at blade angle `theta`: one per turn in reach.
struct FlightTouch : Closest {
    double theta = 0;
};

/// Every local minimum of the distance from `q` that is less than `reach`, by theta. For a centre inside the blade the
/// distance is that to the nearer face, negative. Minima less than half a degree apart may be taken for one.
std::vector<FlightTouch> touches(const Flight& flight, const Vec3& q, double reach);

}  // namespace vkdose::geometry
