#version 450
// commit_lists: ends a refresh of the contact lists: sizes the dispatches over them. One invocation writes.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"

uint groupsOf(uint count) { return (count + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x; }

void main() {
    if (gl_GlobalInvocationID.x != 0u) return;
    // A full table is reported; until the host hears of it nothing may reach outside.
    uvec3 held = min(control.coming.xyz, uvec3(push.pairSlots, push.surfaceSlots, push.coilSlots));
    control.listed = uvec4(held, 0u);
    control.pairs.x = groupsOf(held.x);
    control.surfaces.x = groupsOf(held.y);
    control.coil.x = groupsOf(held.z);
    control.coming = uvec4(0u);
    control.drift = vec4(0.0);
    control.list.w += 1u;
}
