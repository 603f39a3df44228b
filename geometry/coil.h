#pragma once
// The dosing coil: a round wire wound on a helix around the z axis, closed by round caps, turning as a rigid body.

#include <vector>

#include "geometry/features.h"
#include "host/core/vec.h"

namespace vkdose::geometry {

/// Centre line at wire coordinate s in [0, length], with the coil turned by `angle` (about +z) from its start:
///   x = radius cos(psi), y = radius sin(psi), z = zStart + s,  psi = angle + startAngle + hand * 2 pi s / pitch.
struct Coil {
    double radius = 0;      ///< of the wire's centre line [m]
    double pitch = 0;       ///< [m per turn]
    double wireRadius = 0;  ///< [m]
    double length = 0;      ///< of the centre line along z [m]
    double zStart = 0;
    double startAngle = 0;  ///< [rad]
    int hand = 1;           ///< +1 right-handed, -1 left-handed

    /// As it is at the angle 0. A turn is a feature of its own; its key is its number from the start of the wire.
    std::vector<Feature> places(const Vec3& centre, double reach) const;
    ShapeForm form() const;
    void cut(Tessellator& into) const;
};

/// A local minimum of the distance to the wire. There is one per turn in reach. `wireAngle` = hand * 2 pi s / pitch
/// identifies the turn: it changes continuously as the contact moves, and differs by about 2 pi between two turns.
struct CoilTouch : Closest {
    double wireAngle = 0;
};

/// Every local minimum of the distance from `q` to the wire surface that is less than `reach`, ends included, in
/// order of increasing s. `angle` is the coil's rotation about +z [rad]. The iteration is capped and safeguarded;
/// throws std::logic_error if it does not converge.
std::vector<CoilTouch> touches(const Coil& coil, double angle, const Vec3& q, double reach);

/// Closest point of the whole wire, at any distance.
CoilTouch closestPoint(const Coil& coil, double angle, const Vec3& q);

/// Upper bound on how many turns a sphere of radius `a` can touch at once.
int maxTouches(const Coil& coil, double a);

/// Rotation rate about +z [rad/s] that conveys towards +z at `speed` >= 0 [rad/s]: a right-handed coil must turn
/// clockwise seen from +z.
double conveyingRate(const Coil& coil, double speed);

}  // namespace vkdose::geometry
