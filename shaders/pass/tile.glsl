// A workgroup adds up a tile of the grid, one point per invocation. First its invocations find out together which
// particles of a slice can reach the tile. Then each adds these to its own point in ascending order, so that sums do
// not depend on timing. A slice is short because software devices end an invocation's loops after 65,535 trips.
#ifndef VKDOSE_PASS_TILE_GLSL
#define VKDOSE_PASS_TILE_GLSL

#include "pass/field.glsl"

shared uint inReach[4];  // a bit for each particle of the slice

vec3 here;  // the point of this invocation, as an offset from the lower corner
uint pointIndex;
bool onGrid;  // whether the point is one of the grid

/// Adds particle i to the sums of this invocation; the pass defines it.
void add(uint i);

/// False for workgroups beyond the last tile.
bool openTile(out vec3 low, out vec3 high) {
    uint n = gl_WorkGroupID.z * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uvec3 tiles = field.tiles.xyz, tile = field.tile.xyz, points = field.points.xyz;
    uvec3 corner = uvec3(n % tiles.x, n / tiles.x % tiles.y, n / (tiles.x * tiles.y)) * tile;
    uint lane = gl_LocalInvocationID.x;
    uvec3 cell = corner + uvec3(lane % tile.x, lane / tile.x % tile.y, lane / (tile.x * tile.y));
    onGrid = all(lessThan(cell, points)) && lane < tile.x * tile.y * tile.z;
    here = pointAt(cell);
    pointIndex = (cell.z * points.y + cell.y) * points.x + cell.x;
    low = pointAt(corner);
    high = pointAt(min(corner + tile, points) - 1u);
    return n < tiles.x * tiles.y * tiles.z;
}

/// Whether the kernel around a place of the grid, no further than `margin` from particle i, may reach the tile.
bool reaches(uint i, vec3 low, vec3 high, float margin) {
    vec3 offset = offsetOf(source, i);
    vec3 outside = max(-offset, offset - field.size.xyz);
    vec3 away = field.along.xyz * max(max(low - offset, offset - high), vec3(0.0));
    if (PERIODS == 1u)
        away = field.along.xyz * max(abs(shortest(offset - 0.5 * (low + high), period())) - 0.5 * (high - low), 0.0);
    float reach = field.low.w + margin;
    return uint(state[stateIndex(source, kSpin, i)].w) == kStatusActive && all(lessThanEqual(outside, vec3(margin))) &&
           dot(away, away) < reach * reach;
}

/// Adds those of the slice (at most 128) that can reach the tile.
void addSlice(vec3 low, vec3 high, float margin) {
    uint lane = gl_LocalInvocationID.x, count = min(field.tiles.w, push.share - push.slice);
    uint first = firstParticle() + push.slice;
    if (lane < 4u) inReach[lane] = 0u;
    barrier();
    for (uint k = lane; k < count; k += gl_WorkGroupSize.x)
        if (reaches(first + k, low, high, margin)) atomicOr(inReach[k / 32u], 1u << (k % 32u));
    barrier();
    for (uint word = 0u; word < 4u; ++word)
        for (uint bits = inReach[word]; bits != 0u; bits &= bits - 1u) add(first + 32u * word + uint(findLSB(bits)));
}

#endif
