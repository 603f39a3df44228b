#version 450
// decide: ends a stride and begins the next one. Says how many of its steps each member made and keeps the member's
// first error. Then says which members start the next stride with new rows or new contact lists and how long it may be,
// and sizes the dispatches for that. One workgroup, each invocation for some of the members. Reads and writes the
// controls.
// All calls of particles come through one word (Control.call), because lavapipe runs every atomic that a pass contains,
// needed or not: with a dozen of them `move` took two thirds longer.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "pass/slack.glsl"

const uint kRebuild = 1u, kRefresh = 2u;
shared uint wished;

/// The longest way of a body in a step [m].
float bodyWay() { return BODIES > 0u ? member.choices.w : 0.0; }

/// The stride that was at work is over.
void account() {
    uint call = min(control.call.x, control.call.y), made = control.steps.z;
    if (call < kCallWaits) {
        uint kind = call >> kCallShift, step = control.steps.x + made - 1u - member.roster.y;
        if (kind < kErrors && control.error.x == kEmpty)
            control.error = uvec4(step, kind, call & (kMostParticles - 1u), 0u);
        if (kind == kCallRebuild) control.wanted.z = 1u;
    }
    if (call != kEmpty) control.wanted.w = 1u;
    control.call = uvec4(kEmpty);
    control.steps.xz = uvec2(control.steps.x + made, 0u);
    control.drift.x += float(made) * bodyWay();

    if (control.wanted.x != 0u) {  // rows were built in this stride
        control.list.x = 0u;
        control.list.y += 1u;
    }
    control.wanted.xy = uvec2(0u);
}

/// Returns the wishes of the member.
uint plan() {
    uint left = control.error.x == kEmpty ? member.roster.z - control.steps.x : 0u;
    float way = bodyWay(), drift = control.drift.x;
    bool drifts = drift + float(kStride - 1u) * way > control.drift.y;
    uvec2 wanted = control.wanted.xy | control.wanted.zw | uvec2(0u, drifts ? 1u : 0u);
    wanted.y |= wanted.x;
    if (wanted.y != 0u) {
        drift = 0.0;
        control.drift.y = bodySlack(way);
    }
    float slack = control.drift.y;
    // The steps in which all is within its slack; at least one, because the lists are new if need be.
    float within = min((slack - drift) / max(way, 1e-30), float(kStride));
    control.steps.y = min(left, min(kStride, 1u + uint(max(0.0, within))));
    // A member that has made all its steps starts none. It keeps its wishes for the next batch.
    control.wanted = left > 0u ? uvec4(wanted, 0u, 0u) : uvec4(0u, 0u, wanted);
    return left == 0u ? 0u : (wanted.x != 0u ? kRebuild : 0u) | (wanted.y != 0u ? kRefresh : 0u);
}

void main() {
    if (gl_LocalInvocationID.x == 0u) wished = 0u;
    barrier();
    for (uint row = gl_LocalInvocationID.x; row < push.live; row += gl_WorkGroupSize.x) {
        openRow(row);
        if (push.stepInStride > 0u) account();
        atomicOr(wished, plan());
    }
    barrier();
    if (gl_LocalInvocationID.x != 0u) return;
    bool rebuild = (wished & kRebuild) != 0u, refresh = (wished & kRefresh) != 0u;
    uvec2 none = uvec2(0u, 1u), groups = spread(push.share / gl_WorkGroupSize.x);
    dispatches.heads.xz = rebuild ? spread((push.cellMask + gl_WorkGroupSize.x) / gl_WorkGroupSize.x) : none;
    dispatches.particles.xz = rebuild ? groups : none;
    dispatches.refresh.xz = refresh ? groups : none;
    dispatches.settle.x = refresh ? 1u : 0u;
}
