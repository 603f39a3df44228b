#version 450
// move: gathers the forces on one particle per invocation and moves it a time step.
// Reads the source half of the state, links, forces and torques, anchors; writes the other half. Calls for a refresh of
// the contact lists or a rebuild of the rows when the particle has moved as far as they allow for.
//
// The sum runs in the order of the links: other particles by ascending index, surfaces, bodies. It does not depend on
// where their slots are.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "law/mass.glsl"
#include "law/twofloat.glsl"
#include "pass/slack.glsl"
#include "shared/geometry.h"
#ifdef ENERGY_BOOK
#include "pass/body.glsl"
#include "pass/books.glsl"
#endif

/// By the bits: Vulkan lets a compiler take isnan for false.
bool finite(vec3 v) {
    const uvec3 exponent = uvec3(0x7f800000u);
    return all(notEqual(floatBitsToUint(v) & exponent, exponent));
}

/// Takes a place that has left the domain in a direction that repeats back into it. Returns the periods gone in this
/// step.
vec3 wrap(inout vec3 high, inout vec3 low, vec3 bottom, vec3 top, Period p) {
    vec3 margin = kBeyondEnd * p.high;
    vec3 gone = vec3(greaterThan(high, top + margin)) - vec3(lessThan(high, bottom - margin));
    gone *= vec3(greaterThan(p.high, vec3(0.0)));
    Two3 back = twoDifference(high, low, gone * p.high, gone * p.low);
    high = back.high;
    low = back.low;
    return gone;
}

bool beyond(vec3 way, float limit) { return dot(way, way) > limit * limit; }

/// Whether a particle has come past the outlet, or into a region that deletes. `first` is the first vector of the first
/// region.
bool isDosed(vec3 x, float outletZ, vec4 first) {
    bool dosed = x.z > outletZ;
    for (uint k = 0u; k < OUTLETS; ++k) {
        if (first.w == 0.0) break;
        vec4 second = outletVector(2u * k + 1u);
        bool beyond = dot(first.xyz, x) > second.w;
        bool within = all(greaterThan(x, first.xyz)) && all(lessThan(x, second.xyz));
        dosed = dosed || (first.w == 1.0 ? beyond : within);
        if (k + 1u < OUTLETS) first = outletVector(2u * k + 2u);
    }
    return dosed;
}

void main() {
    openMember();
    uint i = firstParticle() + invocation();
    vec4 pull = gravity(), numbers = numerics();
    vec4 bottom = domainLow(), top = domainHigh();
    vec4 outlet = outletVector(0u);
    float unit = slackUnit();
    Period repeats = Period(vec3(0.0), vec3(0.0));
    if (PERIODS == 1u) repeats = period();
    bool opens = opening(), follows = push.stepInStride < control.steps.y && callOfStep >= kCallSoon;
    if (waits()) {
        if (follows) callOfStep = kCallWaits;  // the next step waits, too
        return;
    }
    if (invocation() == 0u) control.steps.z = push.stepInStride + 1u;

    vec4 position = readState(source, kPosition, i);
    vec4 residue = readState(source, kResidue, i);
    vec4 velocity4 = readState(source, kVelocity, i);
    vec4 spin4 = readState(source, kSpin, i);
    vec3 rowAnchor = anchorsAt(rowAnchorIndex(i)).xyz;
    vec4 listAnchor = anchorsAt(listAnchorIndex(i));  // w: slack
    vec4 velocityLow = anchorsAt(speedLowIndex(i, 0u)), spinLow = anchorsAt(speedLowIndex(i, 1u));
    vec2 kept = vec2(velocityLow.w, spinLow.w);
    uvec4 range = rangesAt(rowRangeIndex(i));
    bool moving = uint(spin4.w) == kStatusActive;

    // A particle out of the motion has no links, so that all it does is copy itself.
    vec3 force = vec3(0.0), torque = vec3(0.0);
    float overlap = 0.0;
#ifdef OWN_PROPERTIES
    vec4 flow = vec4(0.0);
#endif
#ifdef ENERGY_BOOK
    float bodyWork = 0.0;
    vec4 normal = vec4(0.0), sliders = vec4(0.0);
#endif
    for (uint k = 0u; k < range.w; ++k) {
        uint link = rowsAt(linkIndex(range.z + k));
        vec4 f = forcesAt(link >> 1u), t = torquesAt(torqueIndex(link >> 1u, link & 1u));
        force += (link & 1u) == 0u ? f.xyz : -f.xyz;
        torque += t.xyz;
        overlap = max(overlap, f.w);
#ifdef OWN_PROPERTIES
        vec4 gained = forcesAt(flowIndex(link >> 1u));
        flow += (link & 1u) == 0u ? gained : -gained;
#endif
#ifdef ENERGY_BOOK
        bodyWork += link >> 1u >= springSlotCount() ? t.w : 0.0;
        if ((link & 1u) == 0u) {
            normal += books[slotBookIndex(kBookNormal, link >> 1u)];
            sliders += books[slotBookIndex(kBookSliders, link >> 1u)];
        }
#endif
        if (k + 1u >= range.w) break;  // at the end: shaders/README.md, Drivers
    }

    // Leapfrog. The loaded velocity belongs to t = 0, so the opening kick is half a step.
    float dt = numbers.x, r = abs(position.w);
    float mass = sphereMass(densityOf(materialIn(residue.w), pull.w), r);
    float kick = opens ? 0.5 * dt : dt;
    Two3 speed = twoGrown(velocity4.xyz, velocityLow.xyz, kick * (force / mass + pull.xyz));
    Two3 turning = twoGrown(spin4.xyz, spinLow.xyz, kick / (0.4 * mass * r * r) * torque);
    vec3 velocity = speed.high, spin = turning.high;
    Two3 place = twoGrown(position.xyz, residue.xyz, dt * velocity);
    vec3 high = place.high, low = place.low;

    bool sound = finite(high) && finite(velocity) && finite(spin);
    vec3 gone = vec3(0.0);
    bvec3 under = lessThan(high, bottom.xyz), over = greaterThan(high, top.xyz);
    if (PERIODS == 1u) {
        gone = wrap(high, low, bottom.xyz, top.xyz, repeats);
        bvec3 ends = equal(repeats.high, vec3(0.0));
        under = bvec3(uvec3(under) * uvec3(ends));
        over = bvec3(uvec3(over) * uvec3(ends));
    }
    bool outside = any(under) || any(over);
    bool dosed = isDosed(high, top.w, outlet);
    uint now = !sound ? kStatusLost : dosed ? kStatusDosed : outside ? kStatusLost : kStatusActive;
    bool leaves = moving && now != kStatusActive;

    // Lists may be made from the rows at any time, so the rows must always hold all that is within the slack, with what
    // `nearPair` adds to it.
    float room = max(0.0, (1.0 - kMostSlack) * unit - (roundingAt(high) + 1e-5 * r));
    vec3 fromRow = high - rowAnchor, way = high - listAnchor.xyz;
    if (PERIODS == 1u) {
        fromRow = shortest(fromRow, repeats);
        way = shortest(way, repeats);
    }
    bool rebuild = leaves || beyond(fromRow, room);
    // The parts of a mesh that were kept for a particle at one end of the domain are not those at the other end.
    bool elsewhere = (SHAPE_KINDS & (1u << kShapeMesh)) != 0u && gone != vec3(0.0);
    bool refresh = elsewhere || beyond(way, listAnchor.w),
         soon = beyond(way + float(kStride) * dt * velocity, listAnchor.w);
    uint kind = !sound                ? kErrorNan
                : overlap > numbers.w ? kErrorOverlap
                : now == kStatusLost  ? kErrorLost
                : rebuild             ? kCallRebuild
                                      : kCallRefresh;
    bool atOnce = kind < kErrors || rebuild || refresh;
    if (moving && (atOnce || soon)) atomicMin(callOfStep, atOnce ? kind << kCallShift | i : kCallSoon);

#ifdef ENERGY_BOOK
    vec3 centre = position.xyz;
    if (PERIODS == 1u) centre += wayGone(kept, repeats);
    if (moving)
        bookStep(i, normal, sliders, centre, r, mass, velocity4.xyz, spin4.xyz, velocity,
                 spin, bodyWork, leaves);
#endif

    vec2 keeps = PERIODS == 1u ? kept + keptPeriods(gone, repeats) : vec2(0.0);
    uint to = 1u - source;
    float radius = leaves ? -position.w : position.w;  // a negative radius touches nothing
    writeState(to, kPosition, i, moving ? vec4(high, radius) : position,
               moving ? vec4(low, POWDERS == 1u ? 0.0 : residue.w) : residue);
    writeSpeedLow(i, moving ? vec4(speed.low, keeps.x) : velocityLow, moving ? vec4(turning.low, keeps.y) : spinLow);
#ifdef OWN_PROPERTIES
    vec4 property = forcesAt(propertyIndex(i, 0u)), low4 = forcesAt(propertyIndex(i, 1u));
    Two3 three = twoGrown(property.xyz, low4.xyz, dt * flow.xyz);
    Two3 last = twoGrown(property.www, low4.www, dt * flow.www);
    if (moving) {
        forces[propertyIndex(i, 0u)] = vec4(three.high, last.high.x);
        forces[propertyIndex(i, 1u)] = vec4(three.low, last.low.x);
    }
#endif
    writeState(to, kVelocity, i, moving ? vec4(velocity, max(velocity4.w, overlap)) : velocity4,
               moving ? vec4(spin, float(now)) : spin4);
}
