// Closest points on the fixed surfaces (geometry/surface.h), as overlap and normal for a sphere. Distances come from
// differences of squares in two-float arithmetic where a plain subtraction would cost the overlap its digits.
#ifndef VKDOSE_LAW_SURFACE_GLSL
#define VKDOSE_LAW_SURFACE_GLSL

#include "law/twofloat.glsl"
#include "shared/layout.h"

struct Sphere {
    vec3 high;  // centre, high and low part [m]
    vec3 low;
    float radius;
};

struct Overlap {
    float depth;  // overlap [m]; <= 0: not touching
    vec3 normal;  // unit, from the surface to the sphere's centre
};

Overlap sphereOverlap(Sphere a, Sphere b) {
    Two3 d = twoDifference(a.high, a.low, b.high, b.low);
    vec2 s = twoSum(a.radius, b.radius);
    float distance = length(d.high);
    return Overlap(differenceOfSquares(s, d) / (s.x + distance), d.high / distance);
}

Overlap planeOverlap(SurfaceParams p, Sphere a) {
    Two3 d = twoDifference(a.high, a.low, p.pointHigh.xyz, p.pointLow.xyz);
    float height = dot(p.axis.xyz, d.high), rest = dot(p.axis.xyz, d.low);
    precise float depth = (a.radius - height) - rest;
    return Overlap(depth, p.axis.xyz);
}

/// Some unit vector square to a unit vector: geometry/surface.h, anyNormal.
vec3 anyNormal(vec3 axis) {
    vec3 other = abs(axis.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    return normalize(other - axis * dot(axis, other));
}

/// Cylinder of radius `r` (high, low): `d` is the offset from its axis, perpendicular to it.
/// `side` = 1: touched from inside; -1: from outside.
Overlap cylinderOverlap(vec2 r, Two3 d, vec3 axis, float side, float radius) {
    float rho = length(d.high);
    vec2 contact = twoSum(r.x, -side * radius);  // distance from the axis at which the sphere just touches
    contact.y += r.y;
    float depth = -side * differenceOfSquares(contact, d) / (contact.x + rho);
    vec3 outward = rho > 0.0 ? d.high / rho : anyNormal(axis);
    return Overlap(depth, -side * outward);
}

/// Circular edge of radius r: `d` perpendicular offset from the axis, `along` the offset from the edge's plane.
Overlap edgeOverlap(vec2 r, Two3 d, vec3 axis, float along, float radius) {
    float rho = length(d.high);
    float off = -differenceOfSquares(r, d) / (r.x + rho);  // rho - r
    vec3 outward = rho > 0.0 ? d.high / rho : anyNormal(axis);
    vec3 e = outward * off + axis * along;
    float distance = length(e);
    return Overlap(radius - distance, distance > 0.0 ? e / distance : axis);
}

Overlap troughOverlap(SurfaceParams p, Sphere a) {
    if (a.high.y >= 0.0) {
        float side = a.high.x >= 0.0 ? 1.0 : -1.0;
        precise float depth = a.radius - ((p.radius.x - side * a.high.x) + (p.radius.y - side * a.low.x));
        return Overlap(depth, vec3(-side, 0.0, 0.0));
    }
    Two3 d = Two3(vec3(a.high.xy, 0.0), vec3(a.low.xy, 0.0));
    return cylinderOverlap(p.radius.xy, d, vec3(0.0, 0.0, 1.0), 1.0, a.radius);
}

Overlap tubeOverlap(SurfaceParams p, Sphere a) {
    vec3 axis = p.axis.xyz;
    Two3 d = twoDifference(a.high, a.low, p.pointHigh.xyz, p.pointLow.xyz);
    float along = dot(axis, d.high) + dot(axis, d.low);
    d.low -= axis * dot(axis, d.low);
    d.high -= axis * dot(axis, d.high);
    bool endless = p.axis.w > 1e29;
    float beyond = along < 0.0 ? along : max(along - p.axis.w, 0.0);
    if (beyond != 0.0 && !endless) return edgeOverlap(p.radius.xy, d, axis, beyond, a.radius);
    return cylinderOverlap(p.radius.xy, d, axis, p.pointLow.w, a.radius);
}

/// A wall along z that ends at `p.pointHigh.z`. Beyond the end, its closest point lies on the edge of that end.
/// `endless` is the overlap with the same wall without an end.
Overlap upToEnd(SurfaceParams p, Sphere a, Overlap endless) {
    precise float past = (a.high.z - p.pointHigh.z) + (a.low.z - p.pointLow.z);
    if (p.pointLow.w == 0.0 || past <= 0.0) return endless;
    vec3 e = (a.radius - endless.depth) * endless.normal + vec3(0.0, 0.0, past);
    float distance = length(e);
    return Overlap(a.radius - distance, e / distance);
}

Overlap frontOverlap(SurfaceParams p, Sphere a) {
    Two3 d = Two3(vec3(a.high.xy, 0.0), vec3(a.low.xy, 0.0));
    precise float before = (p.pointHigh.z - a.high.z) + (p.pointLow.z - a.low.z);  // > 0: inside the canister
    vec3 z = vec3(0.0, 0.0, 1.0);
    float rho = length(a.high.xy);
    if (before > 0.0) {
        if (rho >= p.radius.x) return Overlap(a.radius - before, -z);
        return edgeOverlap(p.radius.xy, d, z, -before, a.radius);
    }
    float beyond = -before - p.axis.w;
    if (beyond > 0.0) return edgeOverlap(p.radius.xy, d, z, beyond, a.radius);
    Overlap throat = cylinderOverlap(p.radius.xy, d, z, 1.0, a.radius);
    // A centre inside the wall leaves by the nearer face.
    if (rho > p.radius.x && a.radius - before < throat.depth) return Overlap(a.radius - before, -z);
    return throat;
}

const uint kApart = 0u;        // two contacts
const uint kWallCounts = 1u;   // one, that with the wall
const uint kFrontCounts = 2u;  // one, that with the front wall, its rim or its throat

/// Whether a sphere that overlaps the front wall and a wall that ends there has two contacts or one, and which one:
/// geometry/surface.h, jointContact.
uint jointContact(Overlap wall, Overlap front, float radius) {
    bool wallDeeper = wall.depth >= front.depth;
    float most = max(wall.depth, front.depth), least = min(wall.depth, front.depth);
    float cosine = dot(wall.normal, front.normal);
    float height = (radius - most) - (radius - least) * cosine;
    if (cosine < 0.9397 && height >= most) return kApart;
    return wallDeeper ? kWallCounts : kFrontCounts;
}

/// Distance from the sphere's surface to the wall to plain float accuracy (about 1e-8 m), for ruling contacts out.
float surfaceGap(uint kind, SurfaceParams p, Sphere a) {
    if (kind == kTube) return -1.0;  // two ends and a side: let the accurate form decide
    float rho = length(a.high.xy);
    float plane = dot(p.axis.xyz, a.high - p.pointHigh.xyz);
    float trough = p.radius.x - (a.high.y >= 0.0 ? abs(a.high.x) : rho);
    float before = p.pointHigh.z - a.high.z;
    float off = p.radius.x - rho;
    float front = before > 0.0 ? (off > 0.0 ? sqrt(off * off + before * before) : before) : off;
    float gap = (kind == kPlane ? plane : kind == kTrough ? trough : front) - a.radius;
    // Past its end a wall is at least as far away as that end.
    return (kind == kPlane || kind == kTrough) && p.pointLow.w != 0.0 ? max(gap, -before - a.radius) : gap;
}

/// `kinds` has a bit for each kind of surface that there is. It is a constant when the pipeline is made, so that kinds
/// that are absent cost nothing.
Overlap surfaceOverlap(uint kinds, uint kind, SurfaceParams p, Sphere a) {
    bool ends = (kinds & kEndingWalls) != 0u;
    if ((kinds & (1u << kPlane)) != 0u && kind == kPlane)
        return ends ? upToEnd(p, a, planeOverlap(p, a)) : planeOverlap(p, a);
    if ((kinds & (1u << kTrough)) != 0u && kind == kTrough)
        return ends ? upToEnd(p, a, troughOverlap(p, a)) : troughOverlap(p, a);
    if ((kinds & (1u << kTube)) != 0u && kind == kTube) return tubeOverlap(p, a);
    if ((kinds & (1u << kFront)) != 0u) return frontOverlap(p, a);
    return Overlap(-1.0, vec3(0.0));
}

#endif
