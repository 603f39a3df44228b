#version 450
// decide: ends a step. Keeps every member's first error, says which members start the next step with new rows or new
// contact lists, and sizes the dispatches for that. One workgroup, each invocation for some of the members. Reads and
// writes the controls.
// All calls of particles come through one word (Control.call), because lavapipe runs every atomic that a pass contains,
// needed or not: with a dozen of them `move` took two thirds longer.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "pass/slack.glsl"

/// The wire of a turning coil is a helix on its way along the axis.
bool coilDrifts() {
    if (!hasCoil()) return false;
    control.drift.x += abs(member.coil.motion.x / member.coil.pitch.w) * numerics().x;
    return control.drift.x > coilSlack();
}

bool bodiesDrift() {
    if (BODIES == 0u) return false;
    control.drift.y += member.choices.w;
    return control.drift.y > bodySlack();
}

void decide(uint next) {
    uint kind = control.call.x >> kCallShift;
    if (kind < kErrors && control.error.x == kEmpty)
        control.error = uvec4(push.stepInBatch, kind, control.call.x & (kMostParticles - 1u), 0u);
    control.call.x = kEmpty;

    if (control.wanted.x != 0u) {  // rows were built in this step
        control.list.x = 0u;
        control.list.y += 1u;
    }
    bool coil = coilDrifts(), bodies = bodiesDrift(), drifts = coil || bodies, rebuild = kind == kCallRebuild,
         refresh = rebuild || drifts || kind == kCallRefresh;
    control.wanted = uvec4(rebuild ? 1u : 0u, refresh ? 1u : 0u, 0u, 0u);
    uvec2 groups = spread(push.share / gl_WorkGroupSize.x);
    if (rebuild) {
        dispatches.step[next].cells.xz = spread((push.cellMask + gl_WorkGroupSize.x) / gl_WorkGroupSize.x);
        dispatches.step[next].particles.xz = groups;
    }
    if (refresh) {
        dispatches.step[next].refresh.xz = groups;
        dispatches.step[next].settle.x = 1u;
    }
}

void main() {
    uint now = push.source, next = 1u - now;
    for (uint row = gl_LocalInvocationID.x; row < push.live; row += gl_WorkGroupSize.x) {
        openRow(row);
        decide(next);
    }
    if (gl_LocalInvocationID.x != 0u) return;
    dispatches.step[now].cells.x = 0u;
    dispatches.step[now].particles.x = 0u;
    dispatches.step[now].refresh.x = 0u;
    dispatches.step[now].settle.x = 0u;
}
