// In which distinct features does a body touch a sphere? The twin of `touched` in geometry/shape.h.
//
// The including file defines, before it includes this one:
//
//   uvec4 geometryAt(uint i)    vector i of the table `geometry` (shared/geometry.h), of the member at work
//   uint nearbyAt(uint i)       a triangle near the sphere (law/mesh.glsl); not called unless nearbyCount is set
//   SHAPE_KINDS                 a constant with a bit for each kind of shape that there is (packBodies tells which).
//                               If it is a specialisation constant, kinds that are absent cost nothing.
//   MOST_PLACES                 a constant: the most places in which a sphere touches a body at once, at most
//   kFewPlaces
//                               (packBodies tells it as well). Nothing is computed for more places than that.
//
// and calls, with `body` the number of the body and `centre` in the body's frame (law/pose.glsl):
//
//   bool mayTouch(body, centre, reach)          a coarse test with a sphere around the body
//   bool mayBeNear(body, centre, reach)         a closer one: whether a shape may come within `reach` of the centre
//   uint touchedFeatures(body, centre, radius, beyond)
//                                               the number of features; they stand in features[0], features[1], ...
//                                               `radius` is the sphere's and the reach of its law, `beyond`, together
//
// A number above kMaxBodyFeatures is an error: some features could not be told. `reach` must not be more than that for
// which the table was packed.
#ifndef VKDOSE_LAW_FEATURES_GLSL
#define VKDOSE_LAW_FEATURES_GLSL

#include "law/flight.glsl"
#include "law/mesh.glsl"
#include "law/places.glsl"
#include "law/shape.glsl"

#define HAS_SHAPE(kind) ((SHAPE_KINDS & (1u << (kind))) != 0u)

#define SHAPE(number, Name, kind, overlap) | (1u << kind)
const uint kExactShapes = 0u
#include "shared/shapes.h"
    ;

/// Whether a point is within `reach` of the sphere in vector `at`.
bool withinSphere(uint at, vec3 centre, float reach) {
    vec4 around = realsAt(at);
    vec3 d = centre - around.xyz;
    float far = around.w + reach;
    return dot(d, d) < far * far;
}

bool mayTouch(uint body, Two3 centre, float reach) {
    return withinSphere(kBodyVectors * body + 1u, centre.high, reach);
}

ShapeData shapeData(uint shape) {
    return ShapeData(realsAt(shape + 2u), realsAt(shape + 3u), realsAt(shape + 4u), realsAt(shape + 5u),
                     realsAt(shape + 6u), realsAt(shape + 7u));
}

/// Overlap with a shape that has a single closest point.
Overlap exactOverlap(uint kind, ShapeData s, Two3 centre, float radius) {
    Overlap o = Overlap(-1.0, vec3(0.0));
#define SHAPE(number, Name, shape, overlap) \
    if (HAS_SHAPE(shape) && kind == shape) o = overlap(s, centre, radius);
#include "shared/shapes.h"
    return o;
}

void wirePlaces(ShapeData s, uint tag, Two3 centre, float radius) {
    CoilParams wire = wireOf(s);
    CoilView view = coilView(wire, s.v7.x, Sphere(centre.high, centre.low, radius));
    for (uint k = 0u; k < coilWindows(wire); ++k) {
        CoilTouch touch = coilCandidate(wire, view, k);
        if (touch.failed) placesLost = true;
        if (touch.depth > 0.0)
            addPlace(touch.depth, touch.normal, tag + uint(abs(touch.wireAngle) / kTwoPi + 0.5), kFlat);
    }
}

/// Whether any shape of the body may have a point within `reach` of the centre. Never wrongly false.
bool mayBeNear(uint body, Two3 centre, float reach) {
    uvec2 shapes = geometryAt(kBodyVectors * body).xy;
    bool near = false;
    uint n = 0u;
    for (; n < shapes.y && !near; ++n) {
        uint shape = shapes.x + kShapeVectors * n;
        uvec4 head = geometryAt(shape);
        if (!withinSphere(shape + 1u, centre.high, reach)) continue;
        if (HAS_SHAPE(kShapeMesh) && head.x == kShapeMesh) near = mayTouchMesh(shape, head, centre.high, reach);
        if (HAS_SHAPE(kShapeFlight) && head.x == kShapeFlight) near = mayTouchFlight(shape, centre, reach);
        if (HAS_SHAPE(kShapeWire) && head.x == kShapeWire) {
            ShapeData s = shapeData(shape);
            near = nearCoil(wireOf(s), s.v7.x, Sphere(centre.high, centre.low, reach), 0.0);
        }
        if (HAS_SHAPE(kShapeRoom) && head.x == kShapeRoom) {
            ShapeData s = shapeData(shape);
            for (uint wall = 0u; wall < 6u; ++wall) near = near || roomWall(s, wall, centre, reach).depth > 0.0;
        }
        if ((SHAPE_KINDS & kExactShapes) != 0u)
            near = near || exactOverlap(head.x, shapeData(shape), centre, reach).depth > 0.0;
    }
    return near || n < shapes.y;
}

uint touchedFeatures(uint body, Two3 centre, float radius, float beyond) {
    uvec2 shapes = geometryAt(kBodyVectors * body).xy;
    clearPlaces();
    uint n = 0u;
    for (; n < shapes.y; ++n) {
        uint shape = shapes.x + kShapeVectors * n;
        uvec4 head = geometryAt(shape);
        if (!withinSphere(shape + 1u, centre.high, radius)) head.x = kNoShape;
        if (HAS_SHAPE(kShapeMesh) && head.x == kShapeMesh) meshPlaces(shape, head, centre, radius);
        if (HAS_SHAPE(kShapeFlight) && head.x == kShapeFlight) flightPlaces(shape, head.y, centre, radius);
        if (HAS_SHAPE(kShapeWire) && head.x == kShapeWire) wirePlaces(shapeData(shape), head.y, centre, radius);
        if (HAS_SHAPE(kShapeRoom) && head.x == kShapeRoom) {
            ShapeData s = shapeData(shape);
            for (uint wall = 0u; wall < 6u; ++wall) {
                Overlap o = roomWall(s, wall, centre, radius);
                if (o.depth > 0.0) addPlace(o.depth, o.normal, head.y + wall, kFlat);
            }
        }
        if ((SHAPE_KINDS & kExactShapes) != 0u) {
            Overlap o = exactOverlap(head.x, shapeData(shape), centre, radius);
            if (o.depth > 0.0) addPlace(o.depth, o.normal, head.y, kFlat);
        }
        if (n + 1u >= shapes.y) break;  // at the end: shaders/README.md, Drivers
    }
    if (n + 1u < shapes.y) placesLost = true;
    return distinctFeatures(radius, beyond);
}

#endif
