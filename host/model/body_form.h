#pragma once
// A body as triangles, for what has to be known of its form as a whole: its reach, and which way it conveys.

#include <vector>

#include "geometry/mesh_file.h"
#include "host/model/rigid_body.h"

namespace vkdose {

/// The surface of the body in the world as it stands at the start, in triangles that follow curves to some hundredths
/// of their radius. Shapes without an end (planes, troughs, endless tubes) are left out.
std::vector<geometry::Triangle> trianglesOf(const RigidBody& body);

/// What a thing reaches that turns about a line.
struct TurningReach {
    double radius = 0;         ///< the largest distance from the line [m]
    double low = 0, high = 0;  ///< along the line, from its point `through` [m]
};
TurningReach reachOf(const std::vector<geometry::Triangle>& mesh, const Vec3& axis, const Vec3& through);

/// Of a body on a hinge the largest distance of its surface from the axis, 0 for others [m].
double hingeLever(const RigidBody& body);

/// How far a thing that turns about a line carries powder along `axis` in a turn by the right hand [m], if the powder
/// slides along its blades and does not turn with them: the pitch of a left-handed screw, minus the pitch of a
/// right-handed one, zero for a paddle. It is the mean over the surface that is oblique to its motion: a surface with
/// the normal n that moves with v pushes powder along the axis with (v n) / (n axis).
double advancePerTurn(const std::vector<geometry::Triangle>& mesh, const Vec3& axis, const Vec3& through);

/// How a thing that turns about a line conveys along it, as `advancePerTurn`, part by part.
struct Conveying {
    double advance = 0;  ///< in the mean [m]
    /// At its ends, by a straight line through its parts: the low end along `axis`, and the high one [m].
    double low = 0, high = 0;
    double forwards = 0,
           backwards = 0;  ///< means of the parts that convey along the axis and against it, both >= 0 [m]
    double against = 0;    ///< share of the surface, as it is weighed, that conveys against the rest: at most one half
};
Conveying conveyingOf(const std::vector<geometry::Triangle>& mesh, const Vec3& axis, const Vec3& through);

/// The y that no point of the thing exceeds in any place of its turn [m].
double highestOfTurn(const std::vector<geometry::Triangle>& mesh, const Vec3& axis, const Vec3& through);

}  // namespace vkdose
