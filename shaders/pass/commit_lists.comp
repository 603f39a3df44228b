#version 450
// commit_lists: ends a refresh of the contact lists: sizes the dispatch of `contacts` and withdraws the request. One
// invocation writes.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"

uint groupsOf(uint count) { return (count + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x; }

void main() {
    if (gl_GlobalInvocationID.x != 0u) return;
    // A full table is reported; until the host hears of it nothing may reach outside.
    uvec3 held = min(control.coming.xyz, uvec3(push.pairSlots, push.surfaceSlots, push.coilSlots));
    uvec3 groups = uvec3(groupsOf(held.x), groupsOf(held.y), groupsOf(held.z));
    control.listed = uvec4(held, groups.y);
    control.contacts = uvec4(groups.x + groups.y + groups.z, 1u, 1u, groups.x);
    control.coming = uvec4(0u);
    control.list.w += 1u;
    control.refresh.x = 0u;
    control.settle.x = 0u;
}
