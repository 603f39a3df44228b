#version 450
// field_branches: the branch of every contact that touched in the last step, one slot per invocation.
// Reads the state of before that step (the half that is not the source), entries, forces, the coil as it stood in step
// stepInBatch of the last batch; writes the branches (pass/field.glsl). A sphere that touches the coil twice has one slot
// for both contacts: its branch is that of the deeper one.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "law/coil.glsl"
#include "pass/field.glsl"

Sphere sphereBefore(uint i) {
    uint side = 1u - push.source;
    vec4 position = state[stateIndex(side, kPosition, i)];
    return Sphere(position.xyz, state[stateIndex(side, kResidue, i)].xyz, position.w);
}

vec3 fromCoil(Sphere a) {
    CoilParams coil = member.coil;
    CoilView view = coilView(coil, coilTurn(coil.phase, push.stepInBatch), a);
    uint trips = coilCandidates(coil, view);
    float deepest = 0.0;
    vec3 branch = vec3(0.0);
    for (uint k = 0u; k < trips; ++k) {
        CoilTouch touch = coilCandidate(coil, view, k);
        if (touch.depth <= deepest) continue;
        deepest = touch.depth;
        branch = (a.radius - touch.depth) * touch.normal;
    }
    return branch;
}

void main() {
    openMember();
    uint k = invocation();
    if (k >= push.pairSlots + push.surfaceSlots + push.coilSlots) return;
    uint slot = memberSlot(k);
    if (slot == kEmpty) return;
    uvec2 who = entries[slot];
    Sphere a = sphereBefore(who.x);
    vec3 branch = vec3(0.0);
    if (ofPair(slot)) {
        Sphere b = sphereBefore(who.y);
        branch = (a.high - b.high) + (a.low - b.low);
    } else if (slot < springSlots()) {
        SurfaceParams p = readSurface(who.y);
        Overlap o = surfaceOverlap(KIND_SET, uint(p.pointHigh.w), p, a);
        branch = (a.radius - o.depth) * o.normal;
    } else {
        branch = fromCoil(a);
    }
    torques[branchIndex(slot)] = vec4(branch, forces[slot].w > 0.0 ? 1.0 : 0.0);
}
