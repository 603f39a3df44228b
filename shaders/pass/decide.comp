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

#ifdef WITH_BODIES
#include "shared/geometry.h"
#define TABLE(number, name, element, count, title) \
    const uint name##Binding = number;             \
    layout(std430, set = 0, binding = number) readonly buffer name##Buffer { element name[]; };
#include "shared/body_tables.h"

/// The longest way of a driven body in a step of the batch [m]. `made`: steps before it (Control.steps).
float bodyWay(uint made) {
    uvec4 bodies = member.bodies;
    return bodies.x > 0u ? motions[bodies.z + (made - member.roster.y) * bodies.w].way.y : 0.0;
}
#else
float bodyWay(uint made) { return 0.0; }
#endif

const uint kRebuild = 1u, kRefresh = 2u;
shared uint wished, nearBodies;

// Where strides and refreshes fall must follow from the number of the step and the state, not from where the host ends
// a batch. So a stride ends where the number of the step is a multiple of kStride, a refresh that need not be made at
// once waits for that, and ways are added up one by one, so that the sum has the same bits in any parts.

/// The stride that was at work is over.
void account() {
    uint call = min(control.call.x, control.call.y), made = control.steps.z;
    if (call < kCallWaits) {
        uint kind = call >> kCallShift, step = control.steps.x + made - 1u - member.roster.y;
        if (kind < kErrors && control.error.x == kEmpty)
            control.error = uvec4(step, kind, call & (kMostParticles - 1u), 0u);
        if (kind == kCallRebuild) control.wanted.z = 1u;
    }
    if (call < kCallWaits) control.wanted.w = 1u;
    if (call == kCallSoon) control.listed.w = 1u;
    control.call = uvec4(kEmpty);
    if (BODIES > 0u)
        for (uint n = 0u; n < made; ++n)
            control.drift.x = wayAfter(control.drift.x, bodyWay(control.steps.x + n));
    control.steps.xz = uvec2(control.steps.x + made, 0u);

    if (control.wanted.x != 0u) {  // rows were built in this stride
        control.list.x = 0u;
        control.list.y += 1u;
    }
    control.wanted.xy = uvec2(0u);
}

/// How many of the next steps, `most` or fewer, are made before a body has gone farther than the lists allow for. At
/// least one, because the lists are new if need be.
uint stepsWithin(float drift, uint most) {
    if (BODIES == 0u) return most;
    uint steps = 1u;
    for (; steps < most; ++steps) {
        drift = wayAfter(drift, bodyWay(control.steps.x + steps - 1u));
        if (drift > control.drift.y) break;
    }
    return steps;
}

/// Returns the wishes of the member.
uint plan() {
    uint made = control.steps.x, left = control.error.x == kEmpty ? member.roster.z - made : 0u;
    uvec2 wanted = control.wanted.xy | control.wanted.zw;
    if (left == 0u) {  // it starts no stride, and keeps its wishes for the next batch
        control.wanted = uvec4(0u, 0u, wanted);
        control.steps.y = 0u;
        return 0u;
    }
    uint late = made % kStride;
    float way = bodyWay(made), drift = control.drift.x, ahead = late == 0u ? float(kStride - 1u) * way : 0.0;
    bool drifts = drift + ahead > control.drift.y, soon = late == 0u && control.listed.w != 0u;
    wanted.y |= wanted.x | (drifts || soon ? 1u : 0u);
    if (wanted.y != 0u) {
        drift = 0.0;
        control.drift.y = bodySlack(way);
        control.sorted = uvec4(0u);
    }
    control.steps.y = stepsWithin(drift, min(left, kStride - late));
    control.wanted = uvec4(wanted, 0u, 0u);
    return (wanted.x != 0u ? kRebuild : 0u) | (wanted.y != 0u ? kRefresh : 0u);
}

void main() {
    if (gl_LocalInvocationID.x == 0u) wished = nearBodies = 0u;
    barrier();
    for (uint row = gl_LocalInvocationID.x; row < push.live; row += gl_WorkGroupSize.x) {
        openRow(row);
        if (push.stepInStride > 0u) account();
        atomicOr(wished, plan());
        if (BODIES > 0u) atomicMax(nearBodies, control.listed.z);
    }
    barrier();
    if (gl_LocalInvocationID.x != 0u) return;
    bool rebuild = (wished & kRebuild) != 0u, refresh = (wished & kRefresh) != 0u;
    uvec2 none = uvec2(0u, 1u), groups = spread(push.share / gl_WorkGroupSize.x);
    dispatches.heads.xz = rebuild ? spread((push.cellMask + gl_WorkGroupSize.x) / gl_WorkGroupSize.x) : none;
    dispatches.particles.xz = rebuild ? groups : none;
    dispatches.refresh.xz = refresh ? groups : none;
    dispatches.parts.xz = refresh ? spread(nearBodies / gl_WorkGroupSize.x + 1u) : none;
    dispatches.settle.x = refresh ? 1u : 0u;
}
