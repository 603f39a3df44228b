#version 450
// commit_lists: ends a refresh of the contact lists. Notes how many contacts the lists of each member hold, and sizes
// the dispatches over them for the member that has most. One workgroup, each invocation for some of the members. Reads
// and writes the controls.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "shared/geometry.h"

shared uvec4 most[gl_WorkGroupSize.x];  // of pairs, surfaces, bodies, faces

void commit() {
    // A full table is reported; until the host hears of it nothing may reach outside.
    control.listed = uvec4(min(control.coming.xyz, uvec3(push.pairSlots, push.surfaceSlots, push.bodySlots)), 0u);
    control.coming = uvec4(0u);
    control.drift.x = 0.0;
    control.list.w += 1u;
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    most[lane] = uvec4(0u);
    for (uint row = lane; row < push.live; row += gl_WorkGroupSize.x) {
        openRow(row);
        if (control.wanted.y != 0u) commit();
        bool sorts = (SHAPE_KINDS & kSortedSlots) != 0u;
        uvec2 bodies = sorts ? control.sorted.yx : uvec2(control.listed.z, 0u);
        most[lane] = max(most[lane], uvec4(control.listed.xy, bodies));
    }
    barrier();
    if (lane != 0u) return;
    for (uint other = 1u; other < gl_WorkGroupSize.x; ++other) most[0] = max(most[0], most[other]);
    uvec4 groups = (most[0] + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
    dispatches.pairs.xz = spread(groups.x);
    dispatches.surfaces.xz = spread(groups.y);
    dispatches.bodies.xz = spread(groups.z);
    dispatches.faces.xz = spread(groups.w);
}
