// The bodies of the member at work: their shapes and where they are in this step.
#ifndef VKDOSE_PASS_BODIES_GLSL
#define VKDOSE_PASS_BODIES_GLSL

#include "shared/geometry.h"

#define TABLE(number, name, element, count, title) \
    const uint name##Binding = number;             \
    layout(std430, set = 0, binding = number) readonly buffer name##Buffer { element name[]; };
#define WRITTEN(number, name, element, count, title) \
    layout(std430, set = 0, binding = number) buffer name##Buffer { element name[]; };
#include "shared/body_tables.h"

/// Where the triangles near a body slot begin in `nearby`, and whether there is room for them.
uint nearbyStart;
bool openNearby(uint slot) {
    nearbyStart = kNearbyWords * (slot - springSlotCount());
    return (SHAPE_KINDS & (1u << kShapeMesh)) != 0u && nearbyStart + kNearbyWords <= uint(nearby.length());
}
/// Place `k` of the member's sorted slots, counted from its first body slot: those near one face come first, the others
/// from behind.
uint sortedWord(uint k) { return kNearbyWords * (firstBodySlot() - springSlotCount() + k) + kSortedWord; }
bool sortsSlots() { return (SHAPE_KINDS & kSortedSlots) != 0u; }
uint nearbyAt(uint i) { return nearby[nearbyStart + 1u + i]; }
#ifdef KEEPS_NEARBY
void keepNearby(uint i, uint entry) { nearby[nearbyStart + 1u + i] = entry; }
#endif

// Where the member's shapes and the motions of this step begin.
uint geometryBegin, motionsBegin;
/// Call it before shapes or motions are asked for, and before any branch.
void openBodies() {
    uvec4 bodies = member.bodies;
    geometryBegin = bodies.y;
    motionsBegin = bodies.z + stepInBatch * bodies.w;
}
#ifdef TEXEL_READS
layout(set = 0, binding = kFirstView + geometryBinding) uniform utextureBuffer geometryView;
uvec4 geometryAt(uint i) { return texelFetch(geometryView, int(geometryBegin + i)); }
#else
uvec4 geometryAt(uint i) { return geometry[geometryBegin + i]; }
#endif

#include "law/features.glsl"
#include "law/pose.glsl"

#ifdef TEXEL_READS
layout(set = 0, binding = kFirstView + motionsBinding) uniform textureBuffer motionsView;
BodyMotion motionOf(uint body) {
    int at = int(kMotionVectors * (motionsBegin + body));
    BodyMotion m;
    for (int row = 0; row < 3; ++row) {
        m.toBodyHigh[row] = texelFetch(motionsView, at + row);
        m.toBodyLow[row] = texelFetch(motionsView, at + 3 + row);
    }
    m.velocity = texelFetch(motionsView, at + 6);
    m.spin = texelFetch(motionsView, at + 7);
    m.centre = texelFetch(motionsView, at + 8);
    m.free = texelFetch(motionsView, at + 9);
    m.line = texelFetch(motionsView, at + 10);
    m.way = texelFetch(motionsView, at + 11);
    m.held = texelFetch(motionsView, at + 12);
    m.pivot = texelFetch(motionsView, at + 13);
    m.hinge = texelFetch(motionsView, at + 14);
    m.axisLow = texelFetch(motionsView, at + 15);
    m.pivotLow = texelFetch(motionsView, at + 16);
    return m;
}
#else
BodyMotion motionOf(uint body) { return motions[motionsBegin + body]; }
#endif

#endif
