#version 450
// field_branches: the branch of every contact that touched in the last step, one contact per invocation. If the fields
// are of one material, it is the part of the branch that lies in particles of that material.
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

/// A branch between two particles is divided by the contact point, half of the overlap inside each.
vec4 wantedPart(vec3 branch, uvec2 who, Sphere a, Sphere b) {
    bool first = isWanted(who.x), second = isWanted(who.y);
    if (first && second) return vec4(branch, 0.0);
    float share = clamp(0.5 + 0.5 * (a.radius - b.radius) / length(branch), 0.0, 1.0);  // of the first
    if (first) return vec4(share * branch, 0.0);
    if (!second || share == 1.0) return kNoBranch;
    return vec4((1.0 - share) * branch, share / (1.0 - share));
}

#ifdef WITH_BODIES
vec4 fromBody(float radius, ContactPlace at, uint body) {
    float depth = forces[at.contact].w;
    vec3 normal = directionToWorld(motionOf(body), history[placeHistoryIndex(at.slot, at.part, 2u)].xyz);
    return depth != 0.0 ? vec4((radius - depth) * normal, 0.0) : kNoBranch;
}
#endif

void main() {
    openMember();
    --stepInBatch;  // the last one
#ifdef WITH_BODIES
    openBodies();
#endif
    uint k = invocation();
    ContactPlace at = memberContact(k);
    if (at.contact == kEmpty) return;
    uvec2 who = entries[at.slot];
    Sphere a = sphereBefore(who.x);
    vec4 branch = kNoBranch;
    if (forces[at.slot].w == 0.0) {
        // apart
    } else if (ofPair(at.slot)) {
        Sphere b = sphereBefore(who.y);
        vec3 apart = (a.high - b.high) + (a.low - b.low);
        if (PERIODS == 1u) apart = shortest(apart, period());
        branch = wantedPart(apart, who, a, b);
    } else if (!isWanted(who.x)) {
        // at a wall or a body the whole branch is the particle's
    } else if (at.slot < springSlotCount()) {
        SurfaceParams p = readSurface(surfaceOf(who.y));
        Overlap o = surfaceOverlap(KIND_SET, uint(p.pointHigh.w), p, a);
        branch = vec4((a.radius - o.depth) * o.normal, 0.0);
    } else {
#ifdef WITH_BODIES
        branch = fromBody(a.radius, at, who.y);
#endif
    }
    branches[at.contact] = branch;
}
