#version 450
// commit: makes the rows just built the current ones and withdraws the request. One invocation writes.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"

void main() {
    if (gl_GlobalInvocationID.x != 0u) return;
    control.list.x = 1u - control.list.x;
    control.list.y += 1u;
    control.cells.x = 0u;
    control.particles.x = 0u;
    control.single.x = 0u;
}
