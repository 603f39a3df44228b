#version 450
// field_kinetic: adds a slice of particles to the kinetic stress, once field_sums has made the velocity from which they
// stray. One point of the grid per invocation; the slices follow each other.
// Reads the source half of the state, weights, the grid; writes the grid.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "law/mass.glsl"
#include "pass/tile.glsl"

vec3 mean;            // velocity of the field here
vec3 squares, mixed;  // xx, yy, zz; yz, zx, xy

void add(uint i) {
    float r = state[stateIndex(source, kPosition, i)].w;
    float m = sphereMass(densityOf(materialOf(i), gravity().w), r);
    vec3 stray = state[stateIndex(source, kVelocity, i)].xyz - mean;
    float w = m * weights[particleWeightIndex(i)] * kernel(here - offsetOf(source, i));
    squares += w * stray * stray;
    mixed += w * stray.yzx * stray.zxy;
}

void main() {
    openMember();
    vec3 low, high;
    if (!openTile(low, high)) return;
    uint at = pointIndex * kFieldVectors;
    vec4 mass = onGrid ? grid[at + kFieldMass] : vec4(0.0);
    vec4 number = onGrid ? grid[at + kFieldNumber] : vec4(0.0);
    vec4 rest = onGrid && push.slice > 0u ? grid[at + kFieldKinetic] : vec4(0.0);
    mean = mass.x > 0.0 ? mass.yzw / mass.x : vec3(0.0);
    squares = vec3(number.zw, rest.x);
    mixed = rest.yzw;
    addSlice(low, high, 0.0);
    if (!onGrid) return;
    grid[at + kFieldNumber] = vec4(number.xy, squares.xy);
    grid[at + kFieldKinetic] = vec4(squares.z, mixed);
}
