#version 450
// step: one time step of one particle per invocation. Built with and without TEXEL_READS (shared/buffers.glsl) and
// ENERGY_BOOK (pass/step_energy.glsl).
// Reads the source half of the state, rows, marks, histories; writes the destination half, marks, histories; asks for a
// rebuild of the rows when the particle has moved half the skin.
//
// Both particles of a pair compute it, always as (smaller index, larger index) from the same bits by the same
// instructions, so action = - reaction to the last bit and each side keeps an identical copy of the history. That costs
// every contact twice, and needs one dispatch and no atomics per step. The sum over a row runs in ascending index.
//
// Shape of the code: software devices execute every branch under a mask and only loops without a lane left are skipped;
// so candidates are marked by cheap straight code first, and the contact law stands in loops over what touches. The
// member's parameters are read before any branch, where all lanes share one load.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "law/contact.glsl"
#include "law/surface.glsl"
#include "law/coil.glsl"
#ifdef ENERGY_BOOK
#include "law/energy.glsl"
#endif

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
ContactParams pairLaw, wallLaw, coilLaw;
CoilParams coil;
uvec4 choices;
float springDt;

Body readBody(uint j) {
    vec4 position = readState(push.source, kPosition, j);
    return Body(Sphere(position.xyz, readState(push.source, kResidue, j).xyz, position.w),
                readState(push.source, kVelocity, j).xyz, readState(push.source, kSpin, j).xyz);
}

#ifdef ENERGY_BOOK
#include "pass/step_energy.glsl"
#endif
#include "pass/step_pairs.glsl"
#include "pass/step_surfaces.glsl"
#include "pass/step_coil.glsl"

bool finite(vec3 v) { return !(any(isnan(v)) || any(isinf(v))); }

void requestRebuild() {
    atomicMax(control.cells.x, (push.cellMask + gl_WorkGroupSize.x) / gl_WorkGroupSize.x);
    atomicMax(control.particles.x, gl_NumWorkGroups.x);
    atomicMax(control.single.x, 1u);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    member = memberOfGroup();
    pairLaw = members[member].contact[kParticleParticle];
    wallLaw = members[member].contact[kParticleWall];
    coilLaw = members[member].contact[kParticleCoil];
    coil = members[member].coil;
    choices = members[member].choices;
    vec4 gravity = members[member].gravity, numerics = members[member].numerics;
    vec4 bottom = members[member].domainLow, top = members[member].domainHigh;
    uint list = control.list.x;

    vec4 position = readState(push.source, kPosition, i);
    vec4 residue = readState(push.source, kResidue, i);
    vec4 velocity4 = readState(push.source, kVelocity, i);
    vec4 spin4 = readState(push.source, kSpin, i);
    uvec4 mark = marks[i];
    vec3 anchor = anchors[i].xyz;
    uint status = uint(spin4.w);
    bool moving = status == kActive;
    Body me = Body(Sphere(position.xyz, residue.xyz, position.w), velocity4.xyz, spin4.xyz);
    float dt = numerics.x;
    springDt = push.opening == 1u ? 0.0 : dt;

    // A particle out of the motion has an empty row and a negative radius, so that all it does is copy itself.
    Sum sum = Sum(vec3(0.0), vec3(0.0), 0.0, 0.0);
#ifdef ENERGY_BOOK
    openBook(i);
#endif
    uvec2 touched = touchPairs(i, me, list, mark, sum);
    uint met = touchSurfaces(i, me, mark.z, sum);
    if (coil.motion.z != 0.0) met |= touchCoil(i, me, mark.z, sum);
#ifdef ENERGY_BOOK
    partWalls(i, me, mark.z, met);
#endif
    mark.xyz = uvec3(touched, met);

    // Leapfrog. The loaded velocity belongs to t = 0, so the opening kick is half a step.
    float r = abs(position.w);
    float mass = gravity.w * (4.0 / 3.0 * 3.14159265358979) * r * r * r;
    float kick = push.opening == 1u ? 0.5 * dt : dt;
    vec3 velocity = me.velocity + kick * (sum.force / mass + gravity.xyz);
    vec3 spin = me.spin + kick / (0.4 * mass * r * r) * sum.torque;

    vec3 advance = dt * velocity + residue.xyz;
    precise vec3 high = position.xyz + advance;
    precise vec3 taken = high - position.xyz;
    precise vec3 low = (position.xyz - (high - taken)) + (advance - taken);

    bool sound = finite(high) && finite(velocity) && finite(spin);
    bool outside = any(lessThan(high, bottom.xyz)) || any(greaterThan(high, top.xyz));
    if (moving && !sound) report(kErrorNan, i);
    if (moving && sound && outside && high.z <= top.w) report(kErrorLost, i);
    if (moving && sum.overlap > numerics.w) report(kErrorOverlap, i);
    uint now = !sound ? kLost : high.z > top.w ? kDosed : outside ? kLost : kActive;
    bool leaves = moving && now != kActive;
    vec3 moved = high - anchor;
    if (moving && dot(moved, moved) > 0.25 * numerics.y * numerics.y || leaves) requestRebuild();

#ifdef ENERGY_BOOK
    if (moving) closeBook(i, me, velocity, spin, mass, gravity.xyz, sum.coilTorque, leaves);
#endif

    uint to = 1u - push.source;
    float radius = leaves ? -position.w : position.w;  // a negative radius touches nothing
    marks[i] = leaves ? uvec4(0u) : mark;
    state[stateIndex(to, kPosition, i)] = moving ? vec4(high, radius) : position;
    state[stateIndex(to, kResidue, i)] = moving ? vec4(low, residue.w + sum.coilTorque) : residue;
    state[stateIndex(to, kVelocity, i)] = moving ? vec4(velocity, max(velocity4.w, sum.overlap)) : velocity4;
    state[stateIndex(to, kSpin, i)] = moving ? vec4(spin, float(now)) : spin4;
}
