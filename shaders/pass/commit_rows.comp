#version 450
// commit_rows: ends a rebuild of the rows: withdraws the request. One invocation writes.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"

void main() {
    if (gl_GlobalInvocationID.x != 0u) return;
    control.list.x = 0u;
    control.list.y += 1u;
    control.cells.x = 0u;
    control.particles.x = 0u;
    control.single.x = 0u;
}
