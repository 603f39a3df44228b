#version 450
// step: one time step of one particle per invocation. TEXEL_READS (built twice, see shared/buffers.glsl).
// Reads the source half of the state, rows, marks, histories; writes the destination half, marks, histories; asks for a
// rebuild of the rows when the particle has moved half the skin.
//
// Both particles of a pair compute it, always as (smaller index, larger index) from the same bits by the same
// instructions, so action = - reaction to the last bit and each side keeps an identical copy of the history. That costs
// every contact twice, and needs one dispatch and no atomics per step. The sum over a row runs in ascending index.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "law/contact.glsl"
#include "law/surface.glsl"
#include "law/coil.glsl"

struct Body {
    Sphere sphere;
    vec3 velocity;
    vec3 spin;
};

struct Sum {
    vec3 force;
    vec3 torque;
    float coilTorque;  // about +z, on the coil
    float overlap;     // largest, over the smaller radius
};

uint member;
float springDt;

#include "pass/step_pairs.glsl"
#include "pass/step_walls.glsl"

uint finite(vec3 v) { return any(isnan(v)) || any(isinf(v)) ? 0u : 1u; }

void copyState(uint i) {
    for (uint f = 0u; f < kFields; ++f) state[stateIndex(1u - push.source, f, i)] = readState(push.source, f, i);
}

void requestRebuild() {
    uint groups = gl_NumWorkGroups.x;
    atomicMax(control.cells.x, (push.cellMask + gl_WorkGroupSize.x) / gl_WorkGroupSize.x);
    atomicMax(control.particles.x, groups);
    atomicMax(control.single.x, 1u);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    member = memberOfGroup();
    vec4 spin4 = readState(push.source, kSpin, i);
    if (uint(spin4.w) != kActive) {
        copyState(i);
        return;
    }
    vec4 position = readState(push.source, kPosition, i);
    vec4 residue = readState(push.source, kResidue, i);
    vec4 velocity4 = readState(push.source, kVelocity, i);
    Body me = Body(Sphere(position.xyz, residue.xyz, position.w), velocity4.xyz, spin4.xyz);
    vec4 numerics = members[member].numerics;
    float dt = numerics.x;
    springDt = push.opening == 1u ? 0.0 : dt;

    Sum sum = Sum(vec3(0.0), vec3(0.0), 0.0, 0.0);
    uvec4 mark = marks[i];
    mark.xy = touchPairs(i, me, mark, sum);
    mark.z = touchWalls(i, me, mark.z, sum);
    marks[i] = mark;
    if (sum.overlap > numerics.w) report(kErrorOverlap, i);

    // Leapfrog. The loaded velocity belongs to t = 0, so the opening kick is half a step.
    vec4 gravity = members[member].gravity;
    float mass = gravity.w * (4.0 / 3.0 * 3.14159265358979) * position.w * position.w * position.w;
    float kick = push.opening == 1u ? 0.5 * dt : dt;
    vec3 velocity = me.velocity + kick * (sum.force / mass + gravity.xyz);
    vec3 spin = me.spin + kick / (0.4 * mass * position.w * position.w) * sum.torque;

    vec3 step_ = dt * velocity + residue.xyz;
    precise vec3 high = position.xyz + step_;
    precise vec3 taken = high - position.xyz;
    precise vec3 low = (position.xyz - (high - taken)) + (step_ - taken);

    vec4 bottom = members[member].domainLow, top = members[member].domainHigh;
    uint status = kActive;
    if (finite(high) * finite(velocity) * finite(spin) == 0u) {
        report(kErrorNan, i);
        status = kLost;
    } else if (high.z > top.w) {
        status = kDosed;
    } else if (any(lessThan(high, bottom.xyz)) || any(greaterThan(high, top.xyz))) {
        report(kErrorLost, i);
        status = kLost;
    }
    if (status != kActive) {
        marks[i] = uvec4(0u);
        requestRebuild();
    }
    vec3 moved = high - anchors[i].xyz;
    float allowed = 0.5 * numerics.y;
    if (dot(moved, moved) > allowed * allowed) requestRebuild();

    float radius = status == kActive ? position.w : -position.w;  // a negative radius touches nothing
    uint to = 1u - push.source;
    state[stateIndex(to, kPosition, i)] = vec4(high, radius);
    state[stateIndex(to, kResidue, i)] = vec4(low, residue.w + sum.coilTorque);
    state[stateIndex(to, kVelocity, i)] = vec4(velocity, max(velocity4.w, sum.overlap));
    state[stateIndex(to, kSpin, i)] = vec4(spin, float(status));
}
