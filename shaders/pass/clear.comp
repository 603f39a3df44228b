#version 450
// clear: empties the cell table. Reads nothing; writes the heads. Runs only while a rebuild is wanted.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"

void main() {
    openMember();
    bool mine = control.wanted.x != 0u && invocation() <= push.cellMask;
    if (mine) cells[headIndex(self, invocation())] = kEmpty;
}
