#version 450
// bin: chains every moving particle into its cell.
// Reads the state; writes the cells' heads and chains. The order within a chain depends on timing; `neighbours` sorts
// its rows, so that nothing after it does.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "shared/cells.glsl"

void main() {
    openMember();
    if (control.wanted.x == 0u) return;
    uint i = firstParticle() + invocation();
    vec4 p = readState(source, kPosition, i);
    if (p.w <= 0.0) return;
    uint head = headIndex(self, cellSlot(cellOf(p.xyz, numerics().z)));
    cells[nextIndex(i)] = atomicExchange(cells[head], i);
}
