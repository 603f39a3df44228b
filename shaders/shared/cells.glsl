// Cells of the neighbour search: a hash of integer coordinates, so that no domain bounds the grid.
#ifndef VKDOSE_SHARED_CELLS_GLSL
#define VKDOSE_SHARED_CELLS_GLSL

ivec3 cellOf(vec3 position, float size) { return ivec3(floor(position / size)); }

uint cellSlot(ivec3 cell) {
    uvec3 c = uvec3(cell) * uvec3(73856093u, 19349663u, 83492791u);
    return (c.x ^ c.y ^ c.z) & push.cellMask;
}

#endif
