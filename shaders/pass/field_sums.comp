#version 450
// field_sums: adds a slice of particles to the fields that are plain sums: density, momentum, number, touching
// neighbours, contact stress and the properties of a user's law. One point of the grid per invocation; the slices
// follow each other. Reads the source half of the state, links, entries, forces, branches, weights; writes the grid.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "law/mass.glsl"
#include "pass/tile.glsl"

vec4 carriedMass;  // density, momentum
vec2 number;       // particles, touching neighbours
mat3 stress;       // column a: row a of the stress
#ifdef OWN_PROPERTIES
vec4 ownDensity;  // of each property: its mean times the density of mass
#endif

void addBranch(uint contact, vec3 from) {
    vec4 branch = branches[contact];
    if (branch.w < 0.0) return;
    float w = 0.0;
    for (uint node = 0u; node < kFieldNodes; ++node)
        w += kShares[node] * weights[nodeWeightIndex(contact, node)] *
             kernel(here - (from - (branch.w + kNodes[node]) * branch.xyz));
    stress += outerProduct(branch.xyz * w, forces[contact].xyz);
}

/// Adds the contacts whose first body is particle i, in the order of its links.
void addBranches(uint i) {
    vec3 from = offsetOf(1u - source, i);
    uvec4 range = ranges[rowRangeIndex(i)];
    for (uint k = 0u; k < range.w; ++k) {
        uint link = rows[linkIndex(range.z + k)], slot = link >> 1u;
        if ((link & 1u) == 1u) continue;
        if (slot < springSlotCount())
            addBranch(slot, from);
        else
            for (uint place = 0u; place < kMaxBodyTouches; ++place) addBranch(forceOfPlace(slot, place), from);
    }
}

void add(uint i) {
    float r = state[stateIndex(source, kPosition, i)].w;
    float m = sphereMass(densityOf(materialOf(i), gravity().w), r);
    vec3 velocity = state[stateIndex(source, kVelocity, i)].xyz;
    float w = weights[particleWeightIndex(i)] * kernel(here - offsetOf(source, i));
    carriedMass += w * m * vec4(1.0, velocity);
    number += w * vec2(1.0, weights[touchesIndex(i)]);
#ifdef OWN_PROPERTIES
    ownDensity += w * m * forces[propertyIndex(i, 0u)];
#endif
    if (field.tile.w == 1u) addBranches(i);
}

void main() {
    openMember();
    vec3 low, high;
    if (!openTile(low, high)) return;
    uint at = pointIndex * kFieldVectors;
    bool onwards = onGrid && push.slice > 0u;
    carriedMass = onwards ? grid[at + kFieldMass] : vec4(0.0);
    number = onwards ? grid[at + kFieldNumber].xy : vec2(0.0);
    for (uint a = 0u; a < 3u; ++a) stress[a] = onwards ? grid[at + kFieldContact + a].xyz : vec3(0.0);
#ifdef OWN_PROPERTIES
    ownDensity = onwards ? grid[at + kFieldProperties] : vec4(0.0);
#endif
    addSlice(low, high, field.tile.w == 1u ? field.along.w : 0.0);
    if (!onGrid) return;
#ifdef OWN_PROPERTIES
    grid[at + kFieldProperties] = ownDensity;
#endif
    grid[at + kFieldMass] = carriedMass;
    grid[at + kFieldNumber] = vec4(number, 0.0, 0.0);
    for (uint a = 0u; a < 3u; ++a) grid[at + kFieldContact + a] = vec4(stress[a], 0.0);
}
