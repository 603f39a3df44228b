// A workgroup adds up a tile of the grid, one point per invocation: together its invocations look which particles of a
// slice can reach the tile, then each adds these to its own point, in ascending order, so that sums do not depend on timing.
// A slice is short because software devices end an invocation's loops after 65,535 trips.
#ifndef VKDOSE_PASS_TILE_GLSL
#define VKDOSE_PASS_TILE_GLSL

#include "pass/field.glsl"

shared uint inReach[4];  // a bit for each invocation of the workgroup, at most 128

vec3 here;     // the point of this invocation, as an offset from the lower corner
uint pointIndex;
bool onGrid;   // whether the point is one of the grid

/// Adds particle i to what this invocation keeps; the pass defines it.
void add(uint i);

/// False for workgroups beyond the last tile.
bool openTile(out vec3 low, out vec3 high) {
    uint n = gl_WorkGroupID.z * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uvec3 tiles = field.tiles.xyz, tile = field.tile.xyz, cells = field.cells.xyz;
    uvec3 corner = uvec3(n % tiles.x, n / tiles.x % tiles.y, n / (tiles.x * tiles.y)) * tile;
    uint lane = gl_LocalInvocationID.x;
    uvec3 cell = corner + uvec3(lane % tile.x, lane / tile.x % tile.y, lane / (tile.x * tile.y));
    onGrid = all(lessThan(cell, cells)) && lane < tile.x * tile.y * tile.z;
    here = pointAt(cell);
    pointIndex = (cell.z * cells.y + cell.y) * cells.x + cell.x;
    low = pointAt(corner);
    high = pointAt(min(corner + tile, cells) - 1u);
    return n < tiles.x * tiles.y * tiles.z;
}

bool reaches(uint i, vec3 low, vec3 high, float reach) {
    vec3 offset = offsetOf(push.source, i);
    vec3 away = field.along.xyz * max(max(low - offset, offset - high), vec3(0.0));
    return uint(state[stateIndex(push.source, kSpin, i)].w) == kActive && dot(away, away) < reach * reach;
}

void addSlice(vec3 low, vec3 high, float reach) {
    uint lane = gl_LocalInvocationID.x, end = min(push.slice + field.tiles.w, push.share);
    for (uint first = push.slice; first < end; first += gl_WorkGroupSize.x) {
        barrier();
        if (lane < 4u) inReach[lane] = 0u;
        barrier();
        uint i = firstParticle() + first + lane;
        if (first + lane < end && reaches(i, low, high, reach)) atomicOr(inReach[lane / 32u], 1u << (lane % 32u));
        barrier();
        for (uint word = 0u; word < (gl_WorkGroupSize.x + 31u) / 32u; ++word)
            for (uint bits = inReach[word]; bits != 0u; bits &= bits - 1u)
                add(firstParticle() + first + 32u * word + uint(findLSB(bits)));
    }
}

#endif
