// The table of bodies, `geometry`, seen by both sides: C++ (host/backend/vulkan/pack_bodies.cpp writes it) and GLSL
// (law/features.glsl reads it). It is a table of uvec4; floats stand in it as bits. Places in it count vectors from its
// beginning. Nothing in it changes while a body moves: lengths are in metres, in the frame of the body.
//
// First come the bodies, kBodyVectors each, in their order. Then for each body its shapes, kShapeVectors each, and
// behind them what its meshes and screws need.
//
//   body    0: first shape, number of shapes        1: a sphere around it: centre, radius
//   shape   0: kind, first tag, for a mesh: heads, lists        1: a sphere around it: centre, radius
//           2 to 7: by kind, see law/shape.glsl, law/flight.glsl and law/mesh.glsl
//
// A tag is a number of a place where a body is touched: the tags of a shape start at its first tag, so that tags order
// places as shape and key do (geometry/features.h).
#ifndef VKDOSE_SHARED_GEOMETRY_H
#define VKDOSE_SHARED_GEOMETRY_H

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace vkdose::gpu {
using glm::uint;
using glm::uvec4;
using glm::vec4;
#define SHARED_CONST inline constexpr uint
#define SHARED_REAL inline constexpr float
#else
#define SHARED_CONST const uint
#define SHARED_REAL const float
#endif

SHARED_CONST kBodyVectors = 2u;
SHARED_CONST kShapeVectors = 8u;
SHARED_CONST kMaxBodyFeatures = 8u;  // geometry::kMaxFeatures
SHARED_CONST kFewPlaces = 4u;        // of one body, that law/places.glsl keeps in its short list
SHARED_REAL kEverywhere = 1e15f;     // radius of the sphere around a shape without an end [m]

// Kinds of shapes. The first four are those of the fixed surfaces (layout.h: kPlane, kTrough, kTube, kFront).
#define SHAPE(number, Name, kind, overlap) SHARED_CONST kind = (number);
#include "shapes.h"
SHARED_CONST kShapeRoom = 7u;
SHARED_CONST kShapeWire = 8u;
SHARED_CONST kShapeMesh = 9u;
SHARED_CONST kShapeFlight = 10u;
SHARED_CONST kSortedSlots = 1u << 29u;  // a bit beside those of the kinds: slots are sorted (pass/parts.comp)
SHARED_CONST kNoShape = 30u;
SHARED_CONST kFreeBodies = 1u << 31u;  // a bit beside those of the kinds: a body moves freely

// Vectors of the parts of a mesh.
SHARED_CONST kTriangleVectors = 7u;
SHARED_CONST kEdgeVectors = 5u;
SHARED_CONST kVertexVectors = 2u;
// Most triangles in one cell of a mesh's grid, and most edges at one of its vertices: software devices end loops.
SHARED_CONST kMostInCell = 4096u;
SHARED_CONST kMostAtVertex = 4096u;
SHARED_CONST kMostFlightTurns = 64u;  // of a screw that one sphere reaches

SHARED_CONST kNearbyWords = 32u;               // of a body slot in the table `nearby`: how many, entries ...
SHARED_CONST kSortedWord = kNearbyWords - 1u;  // ... and a place of the sorted slots
// Of a mesh. An entry of `nearby` keeps a triangle's number above the bits of its seven parts.
SHARED_CONST kMostTriangles = 1u << 25;

/// The wire of a shape of that kind, but for the angle of its start.
struct CoilParams {
    vec4 radius;  // x, y: centre-line radius high, low; z: wire radius; w: length [m]
    vec4 pitch;   // x: pitch; y: its leading 16 bits; z: the rest [m]; w: hand * 2 pi / pitch [rad/m]
    vec4 reach;   // x: largest angle off the wire at which a sphere can touch it [rad]; y: turns to try on each side;
                  // z, w: zStart high, low [m]
};

/// Where a body is and how it moves at one time.
struct BodyMotion {
    vec4 toBodyHigh[3];  // xyz: rows of the rotation from the world to the body; w: origin of the body in the world [m]
    vec4 toBodyLow[3];   // what is left of each number
    vec4 velocity;       // xyz [m/s]; w: material
    vec4 spin;           // xyz [rad/s]; w: 1 if contacts see the motion of its surface
    vec4 centre;         // xyz: a point x fixed to the body has velocity + spin x (x - centre) [m]; w: radius of its
                         // surface, which a* counts [m]; 0: flat
    // Of a body that moves freely (pass/free_bodies.comp):
    vec4 free;  // xyz: what is left of its velocity [m/s]; w: one over its mass [1/kg], 0 if it does not move freely;
                // on a hinge: x: what is left of its rate [rad/s]; w: one over its moment of inertia [1/(kg m2)]
    vec4 line;  // xyz: direction of the line that it keeps to, or of its hinge; 0 if it has neither; w: for how much of
                // the step the forces act on it [s]; 0: it stands
    vec4 way;   // x: how far it may still go before the contact lists must be made anew [m]; y: of the first body: the
                // longest way of a driven body of the canister in this step [m]
    vec4 held;  // x: acceleration along the line by what drives it [m/s2]; y: share of its velocity that damping takes
                // in this step, if it is small; z, w: the stops, as places on the line through the world's origin [m];
                // on a hinge: the same about it [rad/s2], [rad]
    // Of any body:
    vec4 pivot;  // xyz: the point about which its torque is told [m]
    // Of a body on a hinge:
    vec4 hinge;  // x, y: by how much it has turned, high and low part [rad]; z: its rate [rad/s]; w: no point of it is
                 // farther from the axis [m]; 0: it has no hinge
    vec4 axisLow;   // xyz: what is left of `line`; w: by its weight it accelerates by this times the cosine of its turn
    vec4 pivotLow;  // xyz: what is left of `pivot` [m]; w: and this times the sine [rad/s2]
};
SHARED_CONST kMotionVectors = 17u;

#ifdef __cplusplus
#undef SHARED_CONST
#undef SHARED_REAL
}  // namespace vkdose::gpu
#endif
#endif
