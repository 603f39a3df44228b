#version 450
// free_bodies: moves a body that moves freely by a time step, one body per workgroup. Reads the forces of the body's
// slots, entries, controls and where the body is in this step; writes where it is in the next one. Calls for a refresh
// of the contact lists when the body has gone as far as they allow for.
//
// The order of the slots depends on timing. So the forces are added up in whole numbers of 64 bits, whose sum does not
// depend on the order.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "shared/geometry.h"
#include "law/twofloat.glsl"
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

/// The acceleration of the particles by body `b`, as if each had the body's mass. Complete in the first invocation.
vec3 reaction(uint b, float perMass) {
    uint lane = gl_LocalInvocationID.x, first = firstBodySlot();
    uvec2 x = uvec2(0u), y = uvec2(0u), z = uvec2(0u);
    for (uint k = lane; k < control.listed.z; k += gl_WorkGroupSize.x) {
        uvec2 who = entries[entryIndex(first + k)];
        if (who.y != b) continue;
        vec3 push = forces[forceIndex(first + k)].xyz * perMass;
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

/// geometry::Free::stopped. `room`: how far it is to the stop [m].
float stoppedAt(float speed, float room, float dt) {
    if (abs(speed) * dt <= room) return speed;
    return room > kAtStop ? sign(speed) * room / dt : 0.0;
}

void main() {
    openMember();
    uint b = gl_WorkGroupID.x;
    if (waits() || b >= member.bodies.x) return;
    uint at = member.bodies.z + stepInBatch * member.bodies.w + b, next = at + member.bodies.w;
    BodyMotion now = motions[at];
    if (now.free.w == 0.0) return;
    vec3 reacted = reaction(b, now.free.w);
    if (gl_LocalInvocationID.x != 0u) return;

    // The lists were made with this slack, if they were made before this step (pass/near.comp).
    bool renewed = control.wanted.y != 0u && push.stepInStride == 0u;
    float dt = numerics().x, kick = now.line.w, left = renewed ? slackOfFreeBody(now.velocity.xyz) : now.way.x;
    if (kick == 0.0) {  // it stands, where the host has put it
        motions[next].way.x = left;
        return;
    }
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

    float gone = length(step);
    precise float after = left - (gone + left / 8388608.0);  // rounded to the safe side: no way is too short to count
    left = after;
    motions[next].way.x = left;
    if (left < 0.0)
        report(kCallRefresh, firstParticle());
    else if (left < float(kStride) * gone)
        atomicMin(callOfStep, kCallSoon);
}
