// Cells of the neighbour search: a hash of integer coordinates, so that no domain bounds the grid.
#ifndef VKDOSE_SHARED_CELLS_GLSL
#define VKDOSE_SHARED_CELLS_GLSL

ivec3 cellOf(vec3 position, float size) { return ivec3(floor(position / size)); }

/// The factors are 1, 3 and 9 modulo 32, so that the 27 cells around a cell have different slots in every table of 32
/// slots or more: a search meets no particle twice. Far cells may share a slot.
uint cellSlot(ivec3 cell) {
    uvec3 c = uvec3(cell) * uvec3(1u, 0x9e3779a3u, 0xc2b2ae29u);
    return (c.x + c.y + c.z) & push.cellMask;
}

#endif
