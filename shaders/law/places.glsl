// The places where a body touches a sphere, and which of them are distinct features (geometry/features.h: `distinct`).
// The lists are variables of the invocation: arrays in arguments would be copied. No loop over many places has a
// constant bound: drivers would write such a one out, 32 times over.
//
// A mesh, or the blade of a screw, may be touched in many places, any other body in a few. The few stand in a short
// list, deepest first, over which loops have constant bounds: drivers write them out and keep the list in registers.
// Software devices look into other arrays lane by lane, and make every loop once, even if no invocation needs it.
#ifndef VKDOSE_LAW_PLACES_GLSL
#define VKDOSE_LAW_PLACES_GLSL

#include "law/passes.glsl"
#include "shared/geometry.h"

struct BodyFeature {
    float depth;     // overlap [m]
    vec3 direction;  // unit, in the frame of the body, the contact's normal
    uint tag;        // of its place (shared/geometry.h)
    float share;     // how much the overlap falls per way along it (geometry/features.h)
};

// A sphere that fits snugly into a ring of facets touches all of them.
const uint kMostPlaces = 128u;
const float kSameDepth = 2e-7;  // in radii: places of a ring around a sphere count as equally deep

Place placeAt[kMostPlaces];
uint placeTag[kMostPlaces];
// Once its turn has come, the deepest pass from a place to those before it, and the place at the pass's other end.
float placePass[kMostPlaces];
uint placeFrom[kMostPlaces];
uint placeCount;
bool placesLost;                         // a place has found no room, or a loop has ended early
BodyFeature features[kMaxBodyFeatures];  // the answer

void clearPlaces() {
    placeCount = 0u;
    placesLost = false;
}

const uint kManyPlaces = (1u << kShapeMesh) | (1u << kShapeFlight);  // kinds of shapes
bool fewPlaces() { return (SHAPE_KINDS & kManyPlaces) == 0u; }

BodyFeature few[kFewPlaces];

/// Puts a place among the few.
void addToFew(BodyFeature place) {
    for (uint k = 0u; k < MOST_PLACES; ++k) {
        BodyFeature other = few[k];
        bool first = place.depth > other.depth || (place.depth == other.depth && place.tag < other.tag);
        if (k == placeCount || (k < placeCount && first)) {
            few[k] = place;
            place = other;
        }
    }
    placesLost = placesLost || placeCount == MOST_PLACES;
    placeCount = min(placeCount + 1u, MOST_PLACES);
}

/// Lists a place that overlaps by `depth` > 0. `bend` tells how its direction turns (law/passes.glsl).
void addPlace(float depth, vec3 direction, uint tag, uint bend) {
    if (fewPlaces()) {
        addToFew(BodyFeature(depth, direction, tag, 1.0));
        return;
    }
    if (placeCount == kMostPlaces) {
        placesLost = true;
        return;
    }
    placeAt[placeCount] = Place(vec4(direction, depth), bend);
    placeTag[placeCount] = tag;
    ++placeCount;
}

/// A pass among the few, and the numbers of its two places.
struct FewPass {
    float depth;
    uint ends;
};

FewPass passOfFew(uint a, uint b, float radius) {
    float depth = passDepth(vec4(few[a].direction, few[a].depth), vec4(few[b].direction, few[b].depth), radius);
    return FewPass(b < placeCount ? depth : kNoPass, a << 2 | b);
}

/// The way over a third place may be the deeper one.
void goOver(inout FewPass pass, FewPass there, FewPass back) {
    FewPass lower = there;
    if (back.depth < there.depth) lower = back;
    if (lower.depth > pass.depth) pass = lower;
}

void goDeeper(inout FewPass pass, FewPass other) {
    if (other.depth > pass.depth) pass = other;
}

Place fewPlace(uint n) {
    BodyFeature f = few[0];
    for (uint k = 1u; k < MOST_PLACES; ++k)
        if (k == n) f = few[k];
    return Place(vec4(f.direction, f.depth), kFlat);
}

/// Puts place n of the few behind `found` others, if it is a feature. `pass` leads to a deeper one.
void answer(uint n, FewPass pass, float radius, float beyond, inout uint found) {
    BodyFeature f = few[n];
    bool counts = n < placeCount && (n == 0u || pass.depth < f.depth - kSameDepth * radius);
    if (n > 0u && pass.depth > beyond) {
        Left left = leftBy(fewPlace(n), fewPlace(pass.ends >> 2), fewPlace(pass.ends & 3u), radius, beyond);
        f = BodyFeature(left.depth, left.direction, f.tag, left.share);
    }
    for (uint k = 0u; k <= n; ++k)
        if (counts && k == found) features[k] = f;
    if (counts) ++found;
}

/// distinctFeatures where places are few. Written out, because drivers do not unroll loops in loops.
uint distinctFew(float radius, float beyond) {
    const FewPass none = FewPass(kNoPass, 0u);
    FewPass p01 = none, p02 = none, p03 = none, p12 = none, p13 = none, p23 = none;
    if (MOST_PLACES > 1u) p01 = passOfFew(0u, 1u, radius);
    if (MOST_PLACES > 2u) {
        p02 = passOfFew(0u, 2u, radius);
        p12 = passOfFew(1u, 2u, radius);
    }
    if (MOST_PLACES > 3u) {
        p03 = passOfFew(0u, 3u, radius);
        p13 = passOfFew(1u, 3u, radius);
        p23 = passOfFew(2u, 3u, radius);
        goOver(p12, p01, p02);
        goOver(p13, p01, p03);
        goOver(p23, p02, p03);
        goOver(p02, p01, p12);
        goOver(p03, p01, p13);
        goOver(p23, p12, p13);
        goOver(p01, p02, p12);
        goOver(p03, p02, p23);
        goOver(p13, p12, p23);
        goOver(p01, p03, p13);
        goOver(p02, p03, p23);
        goOver(p12, p13, p23);
    } else if (MOST_PLACES > 2u) {
        goOver(p01, p02, p12);
        goOver(p02, p01, p12);
    }
    goDeeper(p02, p12);
    goDeeper(p03, p13);
    goDeeper(p03, p23);
    uint found = 0u;
    answer(0u, none, radius, beyond, found);
    if (MOST_PLACES > 1u) answer(1u, p01, radius, beyond, found);
    if (MOST_PLACES > 2u) answer(2u, p02, radius, beyond, found);
    if (MOST_PLACES > 3u) answer(3u, p03, radius, beyond, found);
    return found;
}

// Features are few, so they have constant numbers, written out: X(f) for each.
#define EACH_FEATURE(X) X(0u) X(1u) X(2u) X(3u) X(4u) X(5u) X(6u) X(7u)

bool comesFirst(float depth, uint tag, float otherDepth, uint otherTag) {
    return depth > otherDepth || (depth == otherDepth && tag < otherTag);
}

/// The deepest place, ties by tag.
uint deepestPlace() {
    uint best = 0u;
    for (uint i = 1u; i < placeCount; ++i) {
        if (comesFirst(placeAt[i].at.w, placeTag[i], placeAt[best].at.w, placeTag[best])) best = i;
        if (i + 1u >= placeCount) break;
    }
    return best;
}

void swapPlaces(uint a, uint b) {
    Place place = placeAt[a];
    uint tag = placeTag[a], from = placeFrom[a];
    float pass = placePass[a];
    placeAt[a] = placeAt[b];
    placeTag[a] = placeTag[b];
    placePass[a] = placePass[b];
    placeFrom[a] = placeFrom[b];
    placeAt[b] = place;
    placeTag[b] = tag;
    placePass[b] = pass;
    placeFrom[b] = from;
}

/// Orders the places so that each is the one with the deepest pass to those before it, the deepest place first. Two
/// places are then joined by the highest of the passes from the one to the other in this order (Prim 1957).
void orderByPasses(float radius) {
    uint next = deepestPlace(), n = 0u;
    while (n < placeCount) {
        swapPlaces(n, next);
        Place here = placeAt[n];
        next = n + 1u;
        float deepest = kNoPass, depth = 0.0;
        uint tag = 0u;
        for (uint i = n + 1u; i < placeCount; ++i) {
            float pass = passDepth(here.at, placeAt[i].at, radius), other = placeAt[i].at.w;
            if (n == 0u || pass > placePass[i]) {
                placePass[i] = pass;
                placeFrom[i] = n;
            }
            pass = placePass[i];
            if (pass > deepest || (pass == deepest && comesFirst(other, placeTag[i], depth, tag))) {
                next = i;
                deepest = pass;
                depth = other;
                tag = placeTag[i];
            }
            if (i + 1u >= placeCount) break;
        }
        ++n;
        if (n >= placeCount) break;
    }
    if (n < placeCount) placesLost = true;  // broken off, by a driver perhaps
}

/// A pass, and which of the ordered places has it.
struct WayOut {
    float pass;
    uint at;
};

void lower(inout WayOut way, uint n) {
    if (placePass[n] < way.pass) way = WayOut(placePass[n], n);
}

/// The deepest pass from place n > 0 of the ordered ones to a deeper place, or to one before it that is as deep.
WayOut wayOut(uint n) {
    float depth = placeAt[n].at.w;
    WayOut back = WayOut(placePass[n], n), on = WayOut(-kNoPass, n);
    uint k = n;
    while (k > 1u && placeAt[k - 1u].at.w < depth) {
        --k;
        lower(back, k);
        if (k <= 1u) break;
    }
    bool found = false;
    for (k = n + 1u; k < placeCount && on.pass > back.pass; ++k) {
        lower(on, k);
        found = placeAt[k].at.w > depth;
        if (found || k + 1u >= placeCount) break;
    }
    return found && on.pass > back.pass ? on : back;
}

/// Finds the distinct ones among the places, and puts the first kMaxBodyFeatures into `features`, the deepest first and
/// the others in any order. Gives their number. If that is more than kMaxBodyFeatures, some could not be told.
/// `radius` is the sphere's and `beyond` together.
uint distinctFeatures(float radius, float beyond) {
    if (fewPlaces()) {
        uint count = distinctFew(radius, beyond);
        return placesLost ? kMaxBodyFeatures + 1u : count;
    }
    orderByPasses(radius);
    // These loops leave at their end when they are through (shaders/README.md, Drivers).
    uint found = 0u, n = 0u;
    while (n < placeCount) {
        Place here = placeAt[n];
        BodyFeature feature = BodyFeature(here.at.w, here.at.xyz, placeTag[n], 1.0);
        bool counts = true;
        if (n > 0u) {
            WayOut way = wayOut(n);
            counts = way.pass < here.at.w - kSameDepth * radius;
            if (counts && way.pass > beyond) {
                Left left = leftBy(here, placeAt[way.at], placeAt[placeFrom[way.at]], radius, beyond);
                feature = BodyFeature(left.depth, left.direction, feature.tag, left.share);
            }
        }
#define ENTER(f) \
    if (counts && f == found) features[f] = feature;
        EACH_FEATURE(ENTER)
        if (counts) ++found;
        ++n;
        if (n >= placeCount) break;
    }
    if (n < placeCount) placesLost = true;  // broken off, by a driver perhaps
    return placesLost ? kMaxBodyFeatures + 1u : found;
}

#undef ENTER

#endif
