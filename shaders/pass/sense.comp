#version 450
// sense: sums the sensors of the host, one record per workgroup (shared/layout.h, SensorRecord); the host adds the
// records up in double precision. Reads the source half of the state; writes the records
// and empties an accumulator, the largest overlap in the state. A tree fixes the order of every sum.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "law/mass.glsl"

shared uvec4 count[gl_WorkGroupSize.x];
shared vec4 mass[gl_WorkGroupSize.x];
shared vec4 motion[gl_WorkGroupSize.x];
shared float overlap[gl_WorkGroupSize.x];
shared vec2 through[gl_WorkGroupSize.x];  // mass by the periods that it has gone through (law/period.glsl)

void main() {
    openMember();
    uint i = firstParticle() + invocation(), lane = gl_LocalInvocationID.x;
    vec4 position = state[stateIndex(source, kPosition, i)];
    vec4 velocity = state[stateIndex(source, kVelocity, i)];
    vec4 spin = state[stateIndex(source, kSpin, i)];
    uint status = uint(spin.w);
    float r = abs(position.w);
    float m = sphereMass(densityOf(materialOf(i), member.gravity.w), r);

    uint region = kEmpty;
    if (status == kStatusActive) region = position.z > member.domainLow.w ? kRegionThroat : kRegionCanister;
    if (status == kStatusDosed) region = kRegionDosed;
    if (status == kStatusLost) region = kRegionLost;
    uvec4 regions = uvec4(kRegionCanister, kRegionThroat, kRegionDosed, kRegionLost);
    uvec4 here = uvec4(equal(uvec4(region), regions));
    count[lane] = here;
    mass[lane] = m * vec4(here);
    float active_ = status == kStatusActive ? 1.0 : 0.0;
    motion[lane] =
        vec4(active_ * 0.5 * m * dot(velocity.xyz, velocity.xyz), active_ * 0.2 * m * r * r * dot(spin.xyz, spin.xyz),
             float(here[kRegionThroat]) * m * velocity.z, 0.0);
    overlap[lane] = velocity.w;
    through[lane] = vec2(0.0);
    if (PERIODS == 1u) through[lane] = m * vec2(anchors[speedLowIndex(i, 0u)].w, anchors[speedLowIndex(i, 1u)].w);
    if (status != kStatusAbsent) {
        state[stateIndex(source, kVelocity, i)] = vec4(velocity.xyz, 0.0);
    }

    for (uint width = gl_WorkGroupSize.x / 2u; width > 0u; width /= 2u) {
        barrier();
        if (lane < width) {
            count[lane] += count[lane + width];
            mass[lane] += mass[lane + width];
            motion[lane] += motion[lane + width];
            overlap[lane] = max(overlap[lane], overlap[lane + width]);
            through[lane] += through[lane + width];
        }
    }
    if (lane == 0u)
        records[i / gl_WorkGroupSize.x].sensors =
            SensorRecord(count[0], mass[0], motion[0], vec4(overlap[0], through[0], 0.0));
}
