// Closest points on the exact shapes of bodies (geometry/shape.h, surface.h), as overlap and normal for a sphere, in
// the frame of the body. Distances are formed in two-float arithmetic from the nearest point of the shape, so that an
// overlap has the relative error of a single float, however large the shape is.
//
// What vectors 2 to 7 of a shape's record hold (geometry::ShapeRecord). Vectors 3 and 5 are the low parts of 2 and 4;
// in 6 and 7 each number stands with its low part.
//
//   plane        2: point   4: normal   7: 1 if it ends, at the z of its point
//   trough       2: -, -, z of its end   6: half width   7: 1 if it ends
//   tube         2: base, length   4: axis   6: radius   7: 1 if touched from inside; 1 if endless
//   front        2: -, -, z, length of the throat   6: radius of the hole
//   cone         2: base, length of its wall   4: axis   6: radius; radius at the end   7: its wall in the half plane:
//                across; along
//   ball         2: centre   6: radius
//   block, room  2: low corner   4: high corner
//   wire         2 to 4: CoilParams (shared/geometry.h); 7: the angle of its start in turns
#ifndef VKDOSE_LAW_SHAPE_GLSL
#define VKDOSE_LAW_SHAPE_GLSL

#include "law/coil.glsl"
#include "law/twoproduct.glsl"
#include "shared/geometry.h"

/// The vectors of an exact shape.
struct ShapeData {
    vec4 v2, v3, v4, v5, v6, v7;
};

/// Overlap with a point at the offset (x, y) in a half plane, both as two floats, and the unit direction from it there.
vec3 overlapInPlane(vec2 x, vec2 y, float radius, vec2 fallback) {
    Two3 off = Two3(vec3(x.x, y.x, 0.0), vec3(x.y, y.y, 0.0));
    float away = length(off.high);
    float depth = differenceOfSquares(vec2(radius, 0.0), off) / (radius + away);
    return vec3(depth, away > 0.0 ? off.high.xy / away : fallback);
}

/// A point seen from an axis.
struct AxisView {
    vec2 along;  // from the axis' origin, two floats [m]
    vec2 rho;    // distance from the axis, two floats [m]
    vec3 outward;
};

AxisView axisView(ShapeData s, Two3 centre) {
    Two3 axis = Two3(s.v4.xyz, s.v5.xyz);
    Two3 d = twoDifference(centre.high, centre.low, s.v2.xyz, s.v3.xyz);
    AxisView view;
    view.along = twoDot(d, axis);
    Two3 off = twoLess(d, view.along, axis);
    view.rho = twoLength(off);
    view.outward = view.rho.x > 0.0 ? off.high / view.rho.x : anyNormal(axis.high);
    return view;
}

Overlap tubeShape(ShapeData s, Two3 centre, float radius) {
    AxisView view = axisView(s, centre);
    vec2 off = twoAdd(view.rho, -s.v6.xy);
    vec2 beyond = twoAdd(view.along, -vec2(s.v2.w, s.v3.w));
    if (view.along.x < 0.0) beyond = view.along;
    bool endless = s.v7.z != 0.0;
    if (!endless && (view.along.x < 0.0 || beyond.x > 0.0)) {
        vec3 rim = overlapInPlane(off, beyond, radius, vec2(0.0, 1.0));
        return Overlap(rim.x, view.outward * rim.y + s.v4.xyz * rim.z);
    }
    float side = s.v7.x == 0.0 ? -1.0 : 1.0;  // 1: from inside
    precise float depth = (radius + side * off.x) + side * off.y;
    return Overlap(depth, -side * view.outward);
}

/// In the half plane of the centre the wall of a cone is a segment.
Overlap coneShape(ShapeData s, Two3 centre, float radius) {
    AxisView view = axisView(s, centre);
    Two3 wall = Two3(vec3(s.v7.xz, 0.0), vec3(s.v7.yw, 0.0));
    vec2 off = twoAdd(view.rho, -s.v6.xy);
    Two3 d = Two3(vec3(off.x, view.along.x, 0.0), vec3(off.y, view.along.y, 0.0));
    vec2 past = twoDot(d, wall), size = vec2(s.v2.w, s.v3.w);
    vec2 beyond = twoAdd(past, -size);
    if (past.x < 0.0) past = vec2(0.0);
    if (beyond.x > 0.0) past = size;
    Two3 left = twoLess(d, past, wall);
    vec3 o = overlapInPlane(vec2(left.high.x, left.low.x), vec2(left.high.y, left.low.y), radius,
                            vec2(wall.high.y, -wall.high.x));
    return Overlap(o.x, view.outward * o.y + s.v4.xyz * o.z);
}

Overlap ballShape(ShapeData s, Two3 centre, float radius) {
    Two3 d = twoDifference(centre.high, centre.low, s.v2.xyz, s.v3.xyz);
    vec2 sum = twoSum(s.v6.x, radius);
    sum.y += s.v6.y;
    float away = length(d.high);
    return Overlap(differenceOfSquares(sum, d) / (sum.x + away), away > 0.0 ? d.high / away : vec3(0.0, 0.0, 1.0));
}

/// Of a solid block. Inside it, the way out is the nearest face.
Overlap blockShape(ShapeData s, Two3 centre, float radius) {
    Two3 above = twoDifference(centre.high, centre.low, s.v2.xyz, s.v3.xyz);
    Two3 below = twoDifference(centre.high, centre.low, s.v4.xyz, s.v5.xyz);
    bvec3 under = lessThan(above.high, vec3(0.0)), over = greaterThan(below.high, vec3(0.0));
    Two3 off = Two3(mix(mix(vec3(0.0), below.high, over), above.high, under),
                    mix(mix(vec3(0.0), below.low, over), above.low, under));
    float away = length(off.high);
    if (away > 0.0) return Overlap(differenceOfSquares(vec2(radius, 0.0), off) / (radius + away), off.high / away);
    vec3 low = above.high, high = -below.high;
    float least = min(min(min(low.x, high.x), min(low.y, high.y)), min(low.z, high.z));
    vec3 normal = low.x == least    ? vec3(-1.0, 0.0, 0.0)
                  : high.x == least ? vec3(1.0, 0.0, 0.0)
                  : low.y == least  ? vec3(0.0, -1.0, 0.0)
                  : high.y == least ? vec3(0.0, 1.0, 0.0)
                  : low.z == least  ? vec3(0.0, 0.0, -1.0)
                                    : vec3(0.0, 0.0, 1.0);
    return Overlap(radius + least, normal);
}

/// Wall `n` of a room: x, y, z, each low and high.
Overlap roomWall(ShapeData s, uint n, Two3 centre, float radius) {
    bool high = (n & 1u) != 0u;
    Two3 d = high ? twoDifference(s.v4.xyz, s.v5.xyz, centre.high, centre.low)
                  : twoDifference(centre.high, centre.low, s.v2.xyz, s.v3.xyz);
    vec3 normal = vec3(n / 2u == 0u, n / 2u == 1u, n / 2u == 2u);
    precise float depth = (radius - d.high[n / 2u]) - d.low[n / 2u];
    return Overlap(depth, high ? -normal : normal);
}

/// A wall along z that may end at v2.z. `distance` is that to the same wall without an end, `normal` its normal there.
Overlap wallWithEnd(ShapeData s, Two3 centre, vec2 distance, vec3 normal, float radius) {
    vec2 past = twoAdd(vec2(centre.high.z, centre.low.z), -vec2(s.v2.z, s.v3.z));
    precise float depth = (radius - distance.x) - distance.y;
    if (s.v7.x == 0.0 || past.x <= 0.0) return Overlap(depth, normal);
    vec3 edge = overlapInPlane(distance, past, radius, vec2(0.0, 1.0));
    return Overlap(edge.x, normal * edge.y + vec3(0.0, 0.0, edge.z));
}

/// Distance from the z axis, and the direction away from it.
AxisView viewFromZ(Two3 centre) {
    vec2 rho = twoLength(Two3(vec3(centre.high.xy, 0.0), vec3(centre.low.xy, 0.0)));
    vec3 outward = rho.x > 0.0 ? vec3(centre.high.xy / rho.x, 0.0) : vec3(1.0, 0.0, 0.0);
    return AxisView(vec2(centre.high.z, centre.low.z), rho, outward);
}

Overlap planeShape(ShapeData s, Two3 centre, float radius) {
    Two3 d = twoDifference(centre.high, centre.low, s.v2.xyz, s.v3.xyz);
    vec2 height = twoDot(d, Two3(s.v4.xyz, s.v5.xyz));
    return wallWithEnd(s, centre, height, s.v4.xyz, radius);
}

Overlap troughShape(ShapeData s, Two3 centre, float radius) {
    AxisView view = viewFromZ(centre);
    float side = centre.high.x >= 0.0 ? 1.0 : -1.0;
    bool above = centre.high.y >= 0.0;
    vec2 off = above ? side * vec2(centre.high.x, centre.low.x) : view.rho;
    return wallWithEnd(s, centre, twoAdd(s.v6.xy, -off), above ? vec3(-side, 0.0, 0.0) : -view.outward, radius);
}

Overlap frontShape(ShapeData s, Two3 centre, float radius) {
    AxisView view = viewFromZ(centre);
    vec3 z = vec3(0.0, 0.0, 1.0);
    vec2 past = twoAdd(view.along, -vec2(s.v2.z, s.v3.z)), beyond = twoAdd(past, -vec2(s.v2.w, s.v3.w));
    vec2 off = twoAdd(view.rho, -s.v6.xy);
    precise float wall = (radius + past.x) + past.y;
    precise float throat = (radius + off.x) + off.y;
    if (past.x < 0.0 && off.x >= 0.0) return Overlap(wall, -z);
    if (past.x < 0.0 || beyond.x > 0.0) {
        vec3 rim = overlapInPlane(off, past.x < 0.0 ? past : beyond, radius, vec2(0.0, past.x < 0.0 ? -1.0 : 1.0));
        return Overlap(rim.x, view.outward * rim.y + z * rim.z);
    }
    // A centre inside the wall leaves by the nearer face.
    if (off.x > 0.0 && wall < throat) return Overlap(wall, -z);
    return Overlap(throat, -view.outward);
}

CoilParams wireOf(ShapeData s) { return CoilParams(s.v2, s.v3, s.v4); }

#endif
