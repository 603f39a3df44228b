#version 450
// bodies: computes the contacts with bodies in this step, one particle and one body near it per invocation. With
// ONE_FACE it is the pass `faces`, which does this for particles near one face of a mesh and nothing else of the body
// (pass/parts.comp): where invocations wait for each other, those near edges and corners would take the time of all.
// Reads the source half of the state, entries, history, the shapes and motions of the bodies, `nearby`; writes history,
// forces and torques, which `move` gathers, and the sums of what the particle does to the body, which the host reads.
//
// Each place where the body is touched is a contact. It goes on with the contact of the last step whose direction in
// the frame of the body is nearest to its own, within 45 degrees, and the springs turn with it (geometry/matching.h).
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "pass/bodies.glsl"
#include "pass/history.glsl"
#include "pass/loads.glsl"
#include "pass/sides.glsl"
#include "pass/wall.glsl"
#ifdef ENERGY_BOOK
#include "pass/slot_books.glsl"
#endif

const float kFarthest = 0.70710678;  // cosine of 45 degrees

/// How many contacts with a body a particle can have had in the last step, and can have now.
uint mostBefore() { return fewPlaces() ? MOST_PLACES : kMaxBodyTouches; }
uint mostTouches() { return ONE_FACE == 1u ? 1u : mostBefore(); }

/// How often a loop over `count` features runs. A loop over one at most has a constant bound: see law/places.glsl.
uint trips(uint count) { return mostTouches() == 1u ? 1u : count; }

/// Whether such a loop is through after number n. It leaves at its end then: shaders/README.md, Drivers.
bool isLast(uint n, uint count) { return mostTouches() == 1u || n + 1u >= count; }

/// Of the last step: the places that were touched, a bit each, and the direction of each. A contact keeps its place.
uint touched;
vec3 oldDirection[kMaxBodyTouches];

void recall(uint slot) {
    touched = 0u;
    for (uint k = 0u; k < mostBefore(); ++k) {
        vec4 direction = historyAt(placeHistoryIndex(slot, k, 2u));
        oldDirection[k] = direction.xyz;
        if (direction.w > 0.0) touched |= 1u << k;
    }
}

/// The place of each feature, four bits each; kNowhere if no contact of the last step goes on in it. The nearest pairs
/// come first, ties by the feature, then by the place.
uint places;
const uint kNowhere = 15u;
uint placeOf(uint n) { return places >> (4u * n) & 15u; }

/// Gives the places of the last step with which no feature goes on, a bit each.
uint match(uint count) {
    uint left = touched, taken = 0u, rounds = min(count, bitCount(touched));
    places = 0xffffffffu;
    for (uint round = 0u; round < trips(rounds); ++round) {
        float nearest = kFarthest;
        uint now = kEmpty, before = 0u;
        for (uint n = 0u; n < trips(count); ++n) {
            vec3 direction = features[n].direction;
            bool free = n < count && (taken >> n & 1u) == 0u;
            for (uint k = 0u; k < mostBefore(); ++k) {
                float cosine = dot(direction, oldDirection[k]);
                if (free && (left >> k & 1u) != 0u && cosine > nearest) {
                    nearest = cosine;
                    now = n;
                    before = k;
                }
            }
            if (isLast(n, count)) break;
        }
        if (now == kEmpty) break;
        places ^= (kNowhere ^ before) << (4u * now);
        taken |= 1u << now;
        left &= ~(1u << before);
        if (isLast(round, rounds)) break;
    }
    return left;
}

/// The vector turned as the unit vector `from` must be to become `to`, on the shortest way. What changes is added as a
/// small difference: a product with a cosine that rounding makes a little more or less than 1 would change the length
/// in every step.
vec3 turnedAlong(vec3 v, vec3 from, vec3 to) {
    vec3 axis = cross(from, to);
    float more = 1.0 + dot(from, to);  // and the cosine itself is 1 - sin^2/(1 + cos)
    return grown(v, cross(axis, v) + (axis * dot(axis, v) - v * dot(axis, axis)) / more);
}

#ifdef ENERGY_BOOK
Exerted exertedAt(uint slot, uint place) {
    return Exerted(historyAt(placeHistoryIndex(slot, place, 3u)), historyAt(placeHistoryIndex(slot, place, 4u)),
                   historyAt(placeHistoryIndex(slot, place, 5u)));
}
#endif

/// The slot of an invocation, if there is one.
bool findSlot(out uint slot) {
    uint k = invocation(), listed = control.listed.z;
    slot = firstBodySlot();
    if (sortsSlots()) listed = ONE_FACE == 1u ? control.sorted.x : control.sorted.y;
    if (waits() || k >= listed) return false;
    if (sortsSlots())
        slot = nearby[sortedWord(ONE_FACE == 1u ? k : push.bodySlots - 1u - k)];
    else
        slot += k;
    return true;
}

void main() {
    openMember();
    openBodies();
    dither = ditherOf(stepNumber());
    ContactParams ofWall = lawOf(pairIndex(kFirstPowder, kWallMaterial));  // before any branch, as in `pairs`
    ContactParams ofCoil = lawOf(pairIndex(kFirstPowder, kCoilMaterial));
    uvec4 chosen = choices();
    float density = gravity().w;
    float springDt = springStep();
    uint slot;
    if (!findSlot(slot)) return;
    uvec2 who = entriesAt(slot);
    uint i = who.x, body = who.y;
    Body me = readBody(i);
    BodyMotion motion = motionOf(body);
    ContactParams law = ofWall;
    if (motion.velocity.w == float(kCoilMaterial)) law = ofCoil;
    if (ownLaws()) law = lawOf(pairIndex(me.material, uint(motion.velocity.w)));
    density = densityOf(me.material, density);
    meetMaterial(i, uint(motion.velocity.w));

    float radius = me.sphere.radius, reduced = reducedAtWall(radius, motion.centre.w);
    if (openNearby(slot)) nearbyCount = nearby[nearbyStart];
    // Features beyond touch, in which a contact may hold on, have a depth as well: `most` is the radius with the reach.
    precise float most = radius;
    if (reaches()) most += reachOf(law, reduced);
    precise float reach = most - radius;
    Two3 centre = toBody(motion, me.sphere.high, me.sphere.low);
    uint count = ONE_FACE == 1u ? touchedFace(body, centre, most) : touchedFeatures(body, centre, most, reach);
    uint room = reaches() ? kMaxBodyFeatures : kMaxBodyTouches;
    if (count > room) {
        report(kErrorFeatures, i);
        count = room;
    }
    recall(slot);
    uint gone = match(count), inUse = touched & ~gone;

    vec3 force = vec3(0.0), torque = vec3(0.0);
    vec3 moment = vec3(0.0);  // about the body's pivot, which may move
    float overlap = 0.0, gap = 0.0, work = 0.0, booked = 0.0;
    vec4 flow = vec4(0.0);
#ifdef ENERGY_BOOK
    WallMotion moving = WallMotion(motion.velocity.xyz, motion.spin.xyz, motion.centre.xyz);
    openSlotBook();
#endif
    for (; gone != 0u; gone &= gone - 1u) {
        uint place = uint(findLSB(gone));
#ifdef ENERGY_BOOK
        partPlace(law, springDt, moving, reduced, me, exertedAt(slot, place), historyOfPlace(slot, place));
#endif
        keepHistoryOfPlace(slot, place, noHistory());
        history[placeHistoryIndex(slot, place, 2u)] = vec4(0.0);
        writeForce(forceOfPlace(slot, place), vec4(0.0));
    }
    for (uint k = 0u; k < trips(count); ++k) {
        if (k >= count) continue;
        uint place = placeOf(k);
        bool known = place != kNowhere;
        BodyFeature feature = features[k];
        if (reaches()) {
            feature.depth -= reach;
            if (!known && feature.depth <= 0.0) continue;
        }
        if (!known) place = uint(findLSB(~inUse));
        if (reaches() && place >= kMaxBodyTouches) {
            report(kErrorFeatures, i);
            continue;
        }
        inUse |= 1u << place;
        vec3 normal = directionToWorld(motion, feature.direction);
        History h = noHistory();
        vec3 was = historyAt(placeHistoryIndex(slot, place, 2u)).xyz;
        if (known) {
            h = historyOfPlace(slot, place);
            vec3 from = directionToWorld(motion, was);
            h.slidingMax.xyz = turnedAlong(h.slidingMax.xyz, from, normal);
            h.rollingTorsion.xyz = turnedAlong(h.rollingTorsion.xyz, from, normal);
        }
        vec3 point = me.sphere.high - normal * (radius - 0.5 * feature.depth);
        vec3 wall = bodyVelocity(motion, point);
        // The law compares velocities of half a step before, so it takes the body's where the contact was then.
        vec3 wallBefore = bodyVelocity(motion, point - 0.5 * springDt * me.velocity);
        float seen = motion.spin.w, perMass = 0.0;
        if ((SHAPE_KINDS & kFreeBodies) != 0u) perMass = perMassAt(motion, point, normal);
        Response r;
#ifdef ENERGY_BOOK
        History before = h;
        Exerted exerted = kNothing;
        if (known) exerted = exertedAt(slot, place);
#endif
        WallForce f = meetWall(me, Overlap(feature.depth, normal), feature.share, reduced, law, chosen, density,
                               perMass, springDt, seen * wallBefore, seen * motion.spin.xyz, h, r);
        keepHistoryOfPlace(slot, place, h);
        history[placeHistoryIndex(slot, place, 2u)] = vec4(feature.direction, float(place + 1u));
        // The host asks for single contacts, and `field_branches` for their overlaps.
        writeForce(forceOfPlace(slot, place), vec4(f.force, feature.depth));
#ifdef ENERGY_BOOK
        bookPlace(law, springDt, moving, reduced, slot, place, me, Overlap(feature.depth, normal), feature.share, r,
                  known, exerted, before, h);
#endif
        flow += flowNow();
        force += f.force;
        torque += f.torque;
        moment += cross(point - motion.pivot.xyz, f.force) + f.couple;
        work += springDt * (dot(f.force, wall) + dot(f.couple, motion.spin.xyz));
        overlap = max(overlap, feature.depth / radius);
        if (reaches()) gap = min(gap, feature.depth / radius);
        if (isLast(k, count)) break;
    }
    if (overlap == 0.0) overlap = gap;  // of contacts that hold on beyond touch
    writeForce(slot, vec4(force, overlap));
#ifdef ENERGY_BOOK
    writeBook(slot, slotBook);
    booked = slotBook.flow.w;
#endif
    writeTorque(slot, vec4(torque, booked));
    writeFlow(slot, flow);
    if (overlap != 0.0) addLoad(body, i, force, moment, work);
}
