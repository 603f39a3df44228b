#version 450
// bodies: computes the contacts with bodies in this step, one particle and one body near it per invocation.
// Reads the source half of the state, entries, history, the shapes and motions of the bodies, `nearby`; writes history,
// forces and torques, which `move` gathers, and the sums of what the particle does to the body, which the host reads.
//
// Each place where the body is touched is a contact. It goes on with the contact of the last step whose direction in
// the frame of the body is nearest to its own, within 45 degrees, and the springs turn with it (geometry/matching.h).
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "pass/bodies.glsl"
#include "pass/wall.glsl"
#ifdef ENERGY_BOOK
#include "pass/slot_books.glsl"
#endif

const float kFarthest = 0.70710678;  // cosine of 45 degrees

/// The contacts of the last step.
History old[kMaxBodyTouches];
vec3 oldDirection[kMaxBodyTouches];
#ifdef ENERGY_BOOK
Exerted oldExerted[kMaxBodyTouches];
#endif
/// The one that each place goes on with; kEmpty: none.
uint goesOn[kMaxBodyTouches];

void recall(uint slot) {
    for (uint k = 0u; k < kMaxBodyTouches; ++k) {
        old[k] = History(historyAt(placeHistoryIndex(slot, k, 0u)), historyAt(placeHistoryIndex(slot, k, 1u)));
        oldDirection[k] = historyAt(placeHistoryIndex(slot, k, 2u)).xyz;
        goesOn[k] = kEmpty;
#ifdef ENERGY_BOOK
        oldExerted[k] = Exerted(historyAt(placeHistoryIndex(slot, k, 3u)), historyAt(placeHistoryIndex(slot, k, 4u)),
                                historyAt(placeHistoryIndex(slot, k, 5u)));
#endif
    }
}

/// The nearest pairs come first, ties by the index now, then by that before.
void match(uint count) {
    uint takenNow = 0u, takenBefore = 0u;
    for (uint round = 0u; round < count; ++round) {
        float nearest = kFarthest;
        uint now = kEmpty, before = kEmpty;
        for (uint n = 0u; n < count; ++n)
            for (uint o = 0u; o < kMaxBodyTouches; ++o) {
                float cosine = dot(features[n].direction, oldDirection[o]);
                bool free = (takenNow >> n & 1u) == 0u && (takenBefore >> o & 1u) == 0u && old[o].slidingMax.w > 0.0;
                if (free && cosine > nearest) {
                    nearest = cosine;
                    now = n;
                    before = o;
                }
            }
        if (now == kEmpty) return;
        goesOn[now] = before;
        takenNow |= 1u << now;
        takenBefore |= 1u << before;
    }
}

/// The vector turned as the unit vector `from` must be to become `to`, on the shortest way.
vec3 turnedAlong(vec3 v, vec3 from, vec3 to) {
    vec3 axis = cross(from, to);
    float cosine = dot(from, to);
    return cosine * v + cross(axis, v) + axis * (dot(axis, v) / (1.0 + cosine));
}

void load(uint body, uint i, uint number, float value) {
    coilTorques[bodyLoadIndex(kBodyLoads * body + number, i)] += value;
}

void main() {
    openMember();
    ContactParams ofWall = lawOf(kParticleWall), ofCoil = lawOf(kParticleCoil);  // before any branch, as in `pairs`
    uvec4 chosen = choices();
    float density = gravity().w;
    float springDt = springStep();
    uint listed = control.body.x;
    if (waits() || invocation() >= listed) return;
    uint slot = firstBodySlot() + invocation();
    uvec2 who = entriesAt(slot);
    uint i = who.x, body = who.y;
    Body me = readBody(i);
    BodyMotion motion = motionOf(body);
    ContactParams law = ofWall;
    if (motion.velocity.w == float(kParticleCoil)) law = ofCoil;

    float radius = me.sphere.radius;
    openBodies();
    if (openNearby(slot)) nearbyCount = nearby[nearbyStart];
    uint count = touchedFeatures(body, toBody(motion, me.sphere.high, me.sphere.low), radius);
    if (count > kMaxBodyTouches) {
        report(kErrorFeatures, i);
        count = kMaxBodyTouches;
    }
    recall(slot);
    match(count);

    vec3 force = vec3(0.0), torque = vec3(0.0), moment = vec3(0.0);
    float overlap = 0.0, work = 0.0, booked = 0.0;
#ifdef ENERGY_BOOK
    WallMotion moving = WallMotion(motion.velocity.xyz, motion.spin.xyz, motion.centre.xyz);
    uint parted = (1u << kMaxBodyTouches) - 1u;  // contacts of the last step with which no place goes on
    openSlotBook();
#endif
    for (uint k = 0u; k < kMaxBodyTouches; ++k) {
        bool touching = k < count, known = touching && goesOn[k] != kEmpty;
        BodyFeature feature = features[k];
        vec3 normal = directionToWorld(motion, feature.direction);
        History h = History(vec4(0.0), vec4(0.0));
        if (known) {
            h = old[goesOn[k]];
            vec3 from = directionToWorld(motion, oldDirection[goesOn[k]]);
            h.slidingMax.xyz = turnedAlong(h.slidingMax.xyz, from, normal);
            h.rollingTorsion.xyz = turnedAlong(h.rollingTorsion.xyz, from, normal);
        }
        vec3 point = me.sphere.high - normal * (radius - 0.5 * feature.depth);
        vec3 wall = bodyVelocity(motion, point);
        Response r;
#ifdef ENERGY_BOOK
        History before = h;
#endif
        WallForce f = WallForce(vec3(0.0), vec3(0.0), vec3(0.0));
        if (touching)
            f = meetWall(me, Overlap(feature.depth, normal), 2.0 * radius, law, chosen, density, springDt, wall,
                         motion.spin.xyz, h, r);
        history[placeHistoryIndex(slot, k, 0u)] = h.slidingMax;
        history[placeHistoryIndex(slot, k, 1u)] = h.rollingTorsion;
        history[placeHistoryIndex(slot, k, 2u)] = vec4(touching ? feature.direction : vec3(0.0), 0.0);
        // The host asks for single contacts, and `field_branches` for their overlaps.
        writeForce(forceOfPlace(slot, k), vec4(f.force, touching ? feature.depth : 0.0));
#ifdef ENERGY_BOOK
        Exerted was = kNothing;
        if (known) {
            was = oldExerted[goesOn[k]];
            parted &= ~(1u << goesOn[k]);
        }
        if (touching)
            bookPlace(law, springDt, moving, slot, k, me, Overlap(feature.depth, normal), r, known, was, before, h);
#endif
        force += f.force;
        torque += f.torque;
        if (touching) {
            moment += cross(point, f.force) + f.couple;
            work += springDt * (dot(f.force, wall) + dot(f.couple, motion.spin.xyz));
            overlap = max(overlap, feature.depth / radius);
        }
    }
    writeForce(slot, vec4(force, overlap));
#ifdef ENERGY_BOOK
    for (uint k = 0u; k < kMaxBodyTouches; ++k)
        if ((parted >> k & 1u) != 0u && old[k].slidingMax.w > 0.0)
            partPlace(law, springDt, moving, me, oldExerted[k], old[k]);
    writeBook(slot, slotBook);
    booked = slotBook.flow.w;
#endif
    writeTorque(slot, vec4(torque, booked));
    if (overlap > 0.0) {
        for (uint d = 0u; d < 3u; ++d) {
            load(body, i, d, force[d]);
            load(body, i, 3u + d, moment[d]);
        }
        load(body, i, 6u, work);
    }
}
