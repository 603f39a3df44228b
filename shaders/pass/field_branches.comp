#version 450
// field_branches: the branch of every contact that touched in the last step, one contact per invocation.
// Reads the state before that step (the half that is not the source), entries, forces,
// history, and bodies as they stood in the last step. Writes the branches (pass/field.glsl).
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "law/surface.glsl"
#ifdef WITH_BODIES
#include "pass/bodies.glsl"
#endif
#include "pass/field.glsl"

Sphere sphereBefore(uint i) {
    uint side = 1u - source;
    vec4 position = state[stateIndex(side, kPosition, i)];
    return Sphere(position.xyz, state[stateIndex(side, kResidue, i)].xyz, position.w);
}

#ifdef WITH_BODIES
vec4 fromBody(float radius, Place at, uint body) {
    float depth = forces[at.contact].w;
    vec3 normal = directionToWorld(motionOf(body), history[placeHistoryIndex(at.slot, at.part, 2u)].xyz);
    return depth != 0.0 ? vec4((radius - depth) * normal, 1.0) : vec4(0.0);
}
#endif

void main() {
    openMember();
    --stepInBatch;  // the last one
    uint k = invocation();
    Place at = memberContact(k);
    if (at.contact == kEmpty) return;
    uvec2 who = entries[at.slot];
    Sphere a = sphereBefore(who.x);
    vec4 branch = vec4(vec3(0.0), 1.0);
    if (forces[at.slot].w == 0.0) {
        branch.w = 0.0;
    } else if (ofPair(at.slot)) {
        Sphere b = sphereBefore(who.y);
        branch.xyz = (a.high - b.high) + (a.low - b.low);
    } else if (at.slot < springSlotCount()) {
        SurfaceParams p = readSurface(surfaceOf(who.y));
        Overlap o = surfaceOverlap(KIND_SET, uint(p.pointHigh.w), p, a);
        branch.xyz = (a.radius - o.depth) * o.normal;
    } else {
#ifdef WITH_BODIES
        branch = fromBody(a.radius, at, who.y);
#endif
    }
    branches[at.contact] = branch;
}
