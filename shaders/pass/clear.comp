#version 450
// clear: empties the cell table. Reads nothing; writes the heads. Runs only while a rebuild is wanted.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"

void main() {
    if (gl_GlobalInvocationID.x <= push.cellMask) cells[gl_GlobalInvocationID.x] = kEmpty;
}
