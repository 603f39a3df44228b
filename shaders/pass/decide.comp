#version 450
// decide: ends a step: keeps the first error, says whether the next step starts with new rows or new contact lists.
// One invocation works. Everything that particles ask for comes through one word (Control.call), because lavapipe makes
// every atomic that a pass contains, needed or not: with a dozen of them `move` took two thirds longer.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "pass/slack.glsl"

/// The wire of a turning coil is a helix on its way along the axis.
bool coilDrifts() {
    if (member.coil.motion.z == 0.0) return false;
    control.drift.x += abs(member.coil.motion.x / member.coil.pitch.w) * member.numerics.x;
    return control.drift.x > coilSlack();
}

void main() {
    if (gl_GlobalInvocationID.x != 0u) return;
    uint kind = control.call.x >> kCallShift;
    if (kind < kErrors && control.error.x == kEmpty)
        control.error = uvec4(push.stepInBatch, kind, control.call.x & (kMostParticles - 1u), 0u);
    control.call.x = kEmpty;

    if (control.cells.x != 0u) {  // rows were built in this step
        control.list.x = 0u;
        control.list.y += 1u;
    }
    bool drifts = coilDrifts(), rebuild = kind == kCallRebuild, refresh = rebuild || drifts || kind == kCallRefresh;
    uint groups = push.particles / gl_WorkGroupSize.x;
    control.cells.x = rebuild ? (push.cellMask + gl_WorkGroupSize.x) / gl_WorkGroupSize.x : 0u;
    control.particles.x = rebuild ? groups : 0u;
    control.refresh.x = refresh ? groups : 0u;
    control.settle.x = refresh ? 1u : 0u;
}
