#version 450
// free_bodies: moves a body that moves freely by a time step, one body per workgroup. Reads the forces of the body's
// slots, entries, controls, on a hinge torques and the source half of the state too, and where the body is in this
// step; writes where it is in the next one. Calls for a refresh of the contact lists when the body has gone as far as
// they allow for.
//
// The order of the slots depends on timing. So the forces are added up in whole numbers of 64 bits, whose sum does not
// depend on the order.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "shared/geometry.h"
#include "law/pose.glsl"
#include "law/twoangle.glsl"
#include "pass/slack.glsl"

#define TABLE(number, name, element, count, title) \
    const uint name##Binding = number;             \
    layout(std430, set = 0, binding = number) buffer name##Buffer { element name[]; };
#include "shared/body_tables.h"

/// Of an acceleration: how many to one m/s2, and the most that one contact may give [m/s2]. Each then takes 52 bits,
/// and 2048 contacts that push as hard as they may still fit.
const float kFine = 1073741824.0;  // 2^30
const float kHardest = 4194304.0;  // 2^22
const float kWord = 4294967296.0;  // 2^32

/// A whole number of 64 bits, the low word first.
uvec2 added(uvec2 a, uvec2 b) {
    uint carry;
    uint low = uaddCarry(a.x, b.x, carry);
    return uvec2(low, a.y + b.y + carry);
}
uvec2 negated(uvec2 a) { return added(~a, uvec2(1u, 0u)); }

uvec2 wholeOf(float acceleration) {
    precise float size = abs(acceleration) * kFine;
    precise float high = floor(size * (1.0 / kWord));  // exact, unlike a division
    precise float low = floor(size - high * kWord);
    uvec2 whole = uvec2(uint(low), uint(high));
    return acceleration < 0.0 ? negated(whole) : whole;
}

float realOf(uvec2 whole) {
    bool below = (whole.y & 0x80000000u) != 0u;
    uvec2 size = below ? negated(whole) : whole;
    precise float real = float(size.y) * (kWord / kFine) + float(size.x) / kFine;
    return below ? -real : real;
}

shared uvec4 sumsXY[gl_WorkGroupSize.x];
shared uvec2 sumsZ[gl_WorkGroupSize.x];

/// How the particle of a slot would accelerate with the body's mass. On a hinge x alone: the rim of the body, were the
/// moment of the force on the particle its own [m/s2].
vec3 pushOf(uint slot, uint i, BodyMotion m) {
    vec3 force = forces[forceIndex(slot)].xyz;
    if (m.hinge.w == 0.0) return force * m.free.w;
    vec3 arm = readState(source, kPosition, i).xyz - m.pivot.xyz;
    vec3 moment = cross(arm, force) + torques[torqueIndex(slot, 0u)].xyz;
    return vec3(dot(m.line.xyz, moment) * (m.hinge.w * m.free.w), 0.0, 0.0);
}

/// Their sum. Complete in the first invocation.
vec3 reaction(uint b, BodyMotion m) {
    uint lane = gl_LocalInvocationID.x, first = firstBodySlot();
    uvec2 x = uvec2(0u), y = uvec2(0u), z = uvec2(0u);
    for (uint k = lane; k < control.listed.z; k += gl_WorkGroupSize.x) {
        uvec2 who = entries[entryIndex(first + k)];
        if (who.y != b) continue;
        vec3 push = pushOf(first + k, who.x, m);
        if (any(greaterThan(abs(push), vec3(kHardest)))) report(kErrorForce, who.x);
        push = clamp(push, vec3(-kHardest), vec3(kHardest));
        x = added(x, wholeOf(push.x));
        y = added(y, wholeOf(push.y));
        z = added(z, wholeOf(push.z));
    }
    sumsXY[lane] = uvec4(x, y);
    sumsZ[lane] = z;
    for (uint width = gl_WorkGroupSize.x / 2u; width > 0u; width /= 2u) {
        barrier();
        if (lane < width) {
            uvec4 more = sumsXY[lane + width], mine = sumsXY[lane];
            sumsXY[lane] = uvec4(added(mine.xy, more.xy), added(mine.zw, more.zw));
            sumsZ[lane] = added(sumsZ[lane], sumsZ[lane + width]);
        }
    }
    return vec3(realOf(sumsXY[0].xy), realOf(sumsXY[0].zw), realOf(sumsZ[0]));
}

/// geometry::stoppedAt. `room`: how far it is to the stop [m], [rad].
float stoppedAt(float speed, float room, float dt) {
    if (abs(speed) * dt <= room) return speed;
    return room > kAtStop ? sign(speed) * room / dt : 0.0;
}

/// Gives the way of the body in this step [m].
float shift(BodyMotion now, uint next, vec3 reacted) {
    float dt = numerics().x, kick = now.line.w;
    precise vec3 pull = kick * (gravity().xyz - reacted);
    vec3 line = now.line.xyz;
    bool guided = line != vec3(0.0);
    if (guided) pull = (dot(pull, line) + kick * now.held.x) * line;
    // Damping acts at the mean of the velocities before and after.
    if (now.held.y > 0.0) pull = (pull - now.held.y * now.velocity.xyz) / (1.0 + 0.5 * now.held.y);
    Two3 speed = twoGrown(now.velocity.xyz, now.free.xyz, pull);

    vec3 origin = vec3(now.toBodyHigh[0].w, now.toBodyHigh[1].w, now.toBodyHigh[2].w);
    vec3 originLow = vec3(now.toBodyLow[0].w, now.toBodyLow[1].w, now.toBodyLow[2].w);
    if (guided) {
        float along = dot(speed.high, line), at = dot(origin, line) + dot(originLow, line);
        float stopped = stoppedAt(along, along > 0.0 ? now.held.w - at : at - now.held.z, dt);
        if (stopped != along) speed = Two3(stopped * line, vec3(0.0));
    }
    vec3 velocity = speed.high;
    precise vec3 step = dt * velocity;
    Two3 place = twoGrown(origin, originLow, step);
    vec3 high = place.high, low = place.low;
    for (uint d = 0u; d < 3u; ++d) {
        motions[next].toBodyHigh[d].w = high[d];
        motions[next].toBodyLow[d].w = low[d];
    }
    motions[next].pivot.xyz = high;
    motions[next].velocity.xyz = velocity;
    motions[next].free.xyz = speed.low;
    return length(step);
}

/// A vector of the world, turned as the body is.
Two3 turnedAs(BodyMotion now, TwoSineCosine by, Two3 v) {
    return twoTurned(v, Two3(now.line.xyz, now.axisLow.xyz), by);
}

/// The same of a body on a hinge: a bound of the way of its points [m]. The host has put it as it stands at its start.
float turn(BodyMotion now, uint next, float reacted) {
    float dt = numerics().x, kick = now.line.w, driven = now.held.x - reacted / now.hinge.w;
    if (now.axisLow.w != 0.0 || now.pivotLow.w != 0.0) {
        TwoSineCosine of = sineCosine(now.hinge.xy);
        driven += now.axisLow.w * of.cosine.x + now.pivotLow.w * of.sine.x;
    }
    precise float pull = kick * driven;
    // Damping acts at the mean of the rates before and after.
    if (now.held.y > 0.0) pull = (pull - now.held.y * now.hinge.z) / (1.0 + 0.5 * now.held.y);
    Two3 grown = twoGrown(vec3(now.hinge.z), vec3(now.free.x), vec3(pull));
    vec2 rate = vec2(grown.high.x, grown.low.x);
    float room = rate.x > 0.0 ? (now.held.w - now.hinge.x) - now.hinge.y : (now.hinge.x - now.held.z) + now.hinge.y;
    float stopped = stoppedAt(rate.x, room, dt);
    if (stopped != rate.x) rate = vec2(stopped, 0.0);
    precise float step = dt * rate.x;
    Two3 turned = twoGrown(vec3(now.hinge.x), vec3(now.hinge.y), vec3(step));
    vec2 angle = vec2(turned.high.x, turned.low.x);
    motions[next].hinge.xyz = vec3(angle, rate.x);
    motions[next].free.x = rate.y;
    motions[next].spin.xyz = rate.x * now.line.xyz;

    TwoSineCosine by = sineCosine(angle);
    vec3 high, low;  // of the origin
    for (uint d = 0u; d < 3u; ++d) {
        vec4 rowHigh = motions[next].toBodyHigh[d], rowLow = motions[next].toBodyLow[d];
        high[d] = rowHigh.w;
        low[d] = rowLow.w;
        Two3 row = turnedAs(now, by, Two3(rowHigh.xyz, rowLow.xyz));
        motions[next].toBodyHigh[d].xyz = row.high;
        motions[next].toBodyLow[d].xyz = row.low;
    }
    Two3 arm = turnedAs(now, by, twoDifference(high, low, now.pivot.xyz, now.pivotLow.xyz));
    Two3 origin = twoDifference(now.pivot.xyz, now.pivotLow.xyz, -arm.high, -arm.low);
    for (uint d = 0u; d < 3u; ++d) {
        motions[next].toBodyHigh[d].w = origin.high[d];
        motions[next].toBodyLow[d].w = origin.low[d];
    }
    return abs(step) * now.hinge.w;
}

void main() {
    openMember();
    uint b = gl_WorkGroupID.x;
    if (waits() || b >= member.bodies.x) return;
    uint at = member.bodies.z + stepInBatch * member.bodies.w + b, next = at + member.bodies.w;
    BodyMotion now = motions[at];
    if (now.free.w == 0.0) return;
    vec3 reacted = reaction(b, now);
    if (gl_LocalInvocationID.x != 0u) return;

    // The lists were made with this slack, if they were made before this step (pass/near.comp).
    bool renewed = control.wanted.y != 0u && push.stepInStride == 0u;
    float left = renewed ? slackOfFreeBody(freeSpeed(now)) : now.way.x;
    if (now.line.w == 0.0) {  // it stands, where the host has put it
        motions[next].way.x = left;
        return;
    }
    float gone;
    if (now.hinge.w == 0.0)
        gone = shift(now, next, reacted);
    else
        gone = turn(now, next, reacted.x);
    precise float after = left - (gone + left / 8388608.0);  // rounded to the safe side: no way is too short to count
    left = after;
    motions[next].way.x = left;
    if (left < 0.0)
        report(kCallRefresh, firstParticle());
    else if (left < float(kStride) * gone)
        atomicMin(callOfStep, kCallSoon);
}
