#version 450
// field_weights: adds up the kernel around a place over the grid, one place per invocation. The places are the member's
// particles, whose touching neighbours are counted as well; then, if contact stress is wanted, the nodes of the
// branches of its contacts. Reads the source half of the state (of a branch the other), entries, links, forces,
// branches; writes weights.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "pass/field.glsl"

float weightAt(vec3 offset) {
    if (any(lessThan(offset, vec3(0.0))) || any(greaterThan(offset, field.size.xyz))) return 0.0;
    vec3 most = vec3(field.points.xyz) - 1.0, middle = offset / field.cell.xyz - 0.5;
    vec3 span = field.low.w / field.cell.xyz * field.along.xyz + (1.0 - field.along.xyz);
    uvec3 first = uvec3(clamp(floor(middle - span), vec3(0.0), most));
    uvec3 last = uvec3(clamp(ceil(middle + span), vec3(0.0), most));
    if (PERIODS == 1u) {  // across an end of the domain the kernel reaches points at the other end
        uvec3 repeats = uvec3(greaterThan(period().high, vec3(0.0)));
        first *= 1u - repeats;
        last += repeats * (uvec3(most) - last);
    }
    float sum = 0.0;  // of planes, of rows: fewer roundings than in one long sum
    for (uint z = first.z; z <= last.z; ++z) {
        float plane = 0.0;
        for (uint y = first.y; y <= last.y; ++y) {
            float row = 0.0;
            for (uint x = first.x; x <= last.x; ++x) row += kernel(pointAt(uvec3(x, y, z)) - offset);
            plane += row;
        }
        sum += plane;
    }
    return sum > 0.0 ? 1.0 / (sum * field.cell.w) : 0.0;
}

/// The number of other particles that touched particle i in the last step.
float touching(uint i) {
    uvec4 range = ranges[rowRangeIndex(i)];
    float count = 0.0;
    for (uint k = 0u; k < range.w; ++k) {
        uint slot = rows[linkIndex(range.z + k)] >> 1u;
        if (ofPair(slot) && forces[slot].w != 0.0) count += 1.0;
    }
    return count;
}

void main() {
    openMember();
    uint k = invocation();
    if (k < push.share) {
        uint i = firstParticle() + k;
        bool active_ = uint(state[stateIndex(source, kSpin, i)].w) == kStatusActive && isWanted(i);
        weights[particleWeightIndex(i)] = active_ ? weightAt(offsetOf(source, i)) : 0.0;
        weights[touchesIndex(i)] = active_ ? touching(i) : 0.0;
        return;
    }
    k -= push.share;
    uint node = k % kFieldNodes;
    k /= kFieldNodes;
    if (field.tile.w == 0u) return;
    ContactPlace at = memberContact(k);
    if (at.contact == kEmpty) return;
    vec4 branch = branches[at.contact];
    vec3 from = offsetOf(1u - source, entries[at.slot].x);
    float away = branch.w + kNodes[node];
    weights[nodeWeightIndex(at.contact, node)] = branch.w >= 0.0 ? weightAt(overGrid(from - away * branch.xyz)) : 0.0;
}
