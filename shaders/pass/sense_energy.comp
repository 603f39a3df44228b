#version 450
// sense_energy: sums the energy book, one record per workgroup (shared/layout.h, EnergyRecord), with the energies of
// motion and gravity at the full step before the last kick. Reads both halves of the state; the last step started from
// the half that is not the source. Reads the books of the contacts and push.opening, which says that the last step was
// the opening one.
// Writes the records and empties the books of the particles.
#extension GL_GOOGLE_include_directive : require
#define ENERGY_BOOK
#include "shared/buffers.glsl"
#include "law/mass.glsl"

shared EnergyRecord record[gl_WorkGroupSize.x];

void main() {
    openMember();
    uint i = firstParticle() + invocation(), lane = gl_LocalInvocationID.x;
    uint before = 1u - source;
    vec4 gravity = member.gravity;
    vec4 position = state[stateIndex(source, kPosition, i)];
    vec3 velocity = state[stateIndex(source, kVelocity, i)].xyz;
    vec4 spin = state[stateIndex(source, kSpin, i)];
    vec3 start = state[stateIndex(before, kPosition, i)].xyz;
    if (PERIODS == 1u) {
        Period p = period();
        vec2 kept = vec2(anchors[speedLowIndex(i, 0u)].w, anchors[speedLowIndex(i, 1u)].w);
        start = position.xyz + wayGone(kept, p) + shortest(start - position.xyz, p);
    }
    vec3 oldVelocity = state[stateIndex(before, kVelocity, i)].xyz;
    vec3 oldSpin = state[stateIndex(before, kSpin, i)].xyz;
    if (push.opening == 1u) {  // half a kick: as in pass/books.glsl
        oldVelocity = 2.0 * oldVelocity - velocity;
        oldSpin = 2.0 * oldSpin - spin.xyz;
    }
    float r = abs(position.w);
    bool moving = uint(spin.w) == kStatusActive;
    float m = moving ? sphereMass(densityOf(materialOf(i), gravity.w), r) : 0.0;
    float inertia = 0.4 * m * r * r;

    uvec4 range = rangesAt(rowRangeIndex(i));
    vec4 elastic = vec4(0.0);
    for (uint k = 0u; k < range.w; ++k) {
        uint link = rowsAt(linkIndex(range.z + k));
        if ((link & 1u) == 0u) elastic += books[slotBookIndex(kBookElastic, link >> 1u)];
    }
    vec4 flow = books[bookIndex(kBookFlow, i)];
    record[lane] =
        EnergyRecord(books[bookIndex(kBookNormal, i)], books[bookIndex(kBookSliders, i)],
                     vec4(flow.xy, 0.5 * m * dot(oldVelocity, velocity), 0.5 * inertia * dot(oldSpin, spin.xyz)),
                     elastic, vec4(m * velocity, -m * dot(gravity.xyz, start)),
                     vec4(m * cross(position.xyz, velocity) + inertia * spin.xyz, flow.w));
    books[bookIndex(kBookNormal, i)] = vec4(0.0);
    books[bookIndex(kBookSliders, i)] = vec4(0.0);
    books[bookIndex(kBookFlow, i)] = vec4(0.0);

    for (uint width = gl_WorkGroupSize.x / 2u; width > 0u; width /= 2u) {
        barrier();
        if (lane < width) {
            EnergyRecord other = record[lane + width];
            record[lane].normal += other.normal;
            record[lane].sliders += other.sliders;
            record[lane].flow += other.flow;
            record[lane].elastic += other.elastic;
            record[lane].momentum += other.momentum;
            record[lane].angular += other.angular;
        }
    }
    if (lane == 0u) records[i / gl_WorkGroupSize.x].energy = record[0];
}
