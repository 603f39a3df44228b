// The places where a body touches a sphere, and which of them are distinct features (geometry/features.h: `distinct`).
// The lists are variables of the invocation: arrays in arguments would be copied. No loop over many places has a
// constant bound: drivers would write such a one out, 32 times over.
//
// A mesh, or the blade of a screw, may be touched in many places, any other body in a few. The few stand in a short
// list, deepest first, over which loops have constant bounds: drivers write them out and keep the list in registers.
// Software devices look into other arrays lane by lane, and make every loop once, even if no invocation needs it.
#ifndef VKDOSE_LAW_PLACES_GLSL
#define VKDOSE_LAW_PLACES_GLSL

#include "shared/geometry.h"

struct BodyFeature {
    float depth;     // overlap [m]
    vec3 direction;  // unit, in the frame of the body, from the surface to the sphere's centre
    uint tag;        // of its place (shared/geometry.h)
};

// A sphere that fits snugly into a ring of facets touches all of them.
const uint kMostPlaces = 128u;
const float kOneFeature = 0.9397;  // cosine of 20 degrees: geometry/surface.h, kSameDirection
const float kSameDepth = 2e-7;     // in radii: places of a ring around a sphere count as equally deep

vec4 placeAt[kMostPlaces];  // direction, depth
uint placeTag[kMostPlaces];
/// The feature of a place, or one of the numbers below.
uint placeFeature[kMostPlaces];
const uint kNotLookedAt = kMaxBodyFeatures;
const uint kCovered = kMaxBodyFeatures + 1u;
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

/// Lists a place that overlaps by `depth` > 0.
void addPlace(float depth, vec3 direction, uint tag) {
    if (fewPlaces()) {
        addToFew(BodyFeature(depth, direction, tag));
        return;
    }
    if (placeCount == kMostPlaces) {
        placesLost = true;
        return;
    }
    placeAt[placeCount] = vec4(direction, depth);
    placeTag[placeCount] = tag;
    placeFeature[placeCount] = kNotLookedAt;
    ++placeCount;
}

/// Whether the flat of a deeper contact covers a place in another direction: geometry/surface.h, oneContact.
bool covered(BodyFeature deeper, vec4 place, float radius) {
    float cosine = dot(deeper.direction, place.xyz);
    return radius * (1.0 - cosine) + place.w * cosine - deeper.depth < deeper.depth;
}

// Features are few and looked at by all places, so they have constant numbers, written out: X(f) for each.
#define EACH_FEATURE(X) X(0u) X(1u) X(2u) X(3u) X(4u) X(5u) X(6u) X(7u)

/// The deepest place that has not been looked at, ties by tag.
uint deepestLeft() {
    uint best = 0u, tag = 0xffffffffu;
    float depth = 0.0;
    for (uint i = 0u; i < placeCount; ++i) {
        float other = placeAt[i].w;
        uint otherTag = placeTag[i];
        bool first = other > depth || (other == depth && otherTag < tag);
        if (placeFeature[i] == kNotLookedAt && first) {
            best = i;
            depth = other;
            tag = otherTag;
        }
        if (i + 1u >= placeCount) break;
    }
    return best;
}

// The number of the feature's deepest place, or kCovered. That of a feature which another joined stays: among four
// places nothing is left to join then.
uint featureOfFew[kFewPlaces];
uint aliveFew;  // features that no other has joined, a bit each

/// Finds the feature of a place; those of the places before it are found.
void judge(uint n, float radius) {
    uint touching = 0u, joins = 0u;  // features, a bit each
    bool hidden = false;
    for (uint q = 0u; q < n; ++q) {
        bool near = dot(few[q].direction, few[n].direction) >= kOneFeature;
        bool under = covered(few[q], vec4(few[n].direction, few[n].depth), radius);
        if (near && featureOfFew[q] != kCovered) touching |= 1u << featureOfFew[q];
        hidden = hidden || (under && (aliveFew >> q & 1u) != 0u);
    }
    bool counts = n < placeCount && (touching != 0u || !hidden);
    uint mine = touching != 0u ? uint(findLSB(touching)) : n;
    for (uint q = 0u; q < n; ++q) {
        bool asDeep = few[q].depth - few[n].depth <= kSameDepth * radius;
        if (counts && q > mine && (touching >> q & 1u) != 0u && asDeep) joins |= 1u << q;
    }
    featureOfFew[n] = counts ? mine : kCovered;
    aliveFew &= ~joins;
    if (counts && touching == 0u) aliveFew |= 1u << n;
}

/// Puts the feature of number n, if there is one, behind `found` others.
void answer(uint n, inout uint found) {
    bool counts = (aliveFew >> n & 1u) != 0u;
    for (uint f = 0u; f <= n; ++f)
        if (counts && f == found) features[f] = few[n];
    if (counts) ++found;
}

/// distinctFeatures where places are few. Written out, because drivers do not unroll loops in loops.
uint distinctFew(float radius) {
    aliveFew = 0u;
    judge(0u, radius);
    if (MOST_PLACES > 1u) judge(1u, radius);
    if (MOST_PLACES > 2u) judge(2u, radius);
    if (MOST_PLACES > 3u) judge(3u, radius);
    uint found = 0u;
    answer(0u, found);
    if (MOST_PLACES > 1u) answer(1u, found);
    if (MOST_PLACES > 2u) answer(2u, found);
    if (MOST_PLACES > 3u) answer(3u, found);
    return found;
}

/// Finds the distinct ones among the places, deepest first, ties by tag, and puts the first kMaxBodyFeatures into
/// `features`. Gives their number. If that is more than kMaxBodyFeatures, some could not be told.
uint distinctFeatures(float radius) {
    if (fewPlaces()) {
        uint count = distinctFew(radius);
        return placesLost ? kMaxBodyFeatures + 1u : count;
    }
    // These loops leave at their end when they are through (shaders/README.md, Drivers).
    uint made = 0u, alive = 0u;  // features; a bit for each that no other has joined
    uint looked = 0u;
    while (looked < placeCount) {
        uint at = deepestLeft();
        vec4 place = placeAt[at];
        uint touching = 0u;  // features that it belongs to, a bit each
        for (uint i = 0u; i < placeCount; ++i) {
            uint f = placeFeature[i];
            if (f < kMaxBodyFeatures && dot(placeAt[i].xyz, place.xyz) >= kOneFeature) touching |= 1u << f;
            if (made == 0u || i + 1u >= placeCount) break;
        }
        bool hidden = false;
#define MEET(f) hidden = hidden || ((alive >> f & 1u) != 0u && covered(features[f], place, radius));
        EACH_FEATURE(MEET)
        bool counts = touching != 0u || !hidden;
        uint mine = touching != 0u ? uint(findLSB(touching)) : made;
        if (counts && mine == kMaxBodyFeatures) {
            placesLost = true;
            break;
        }
        // It joins features that are no deeper than itself: nothing lies between them.
        uint joins = 0u;
#define JOIN(f)                                                                                                 \
    if (counts && f > mine && (touching >> f & 1u) != 0u && features[f].depth - place.w <= kSameDepth * radius) \
        joins |= 1u << f;
        EACH_FEATURE(JOIN)
        for (uint i = 0u; i < placeCount; ++i) {
            uint f = placeFeature[i];
            if (f < kMaxBodyFeatures && (joins >> f & 1u) != 0u) placeFeature[i] = mine;
            if (joins == 0u || i + 1u >= placeCount) break;
        }
        alive &= ~joins;
        if (counts && touching == 0u) {
            ++made;
            alive |= 1u << mine;
#define ENTER(f) \
    if (f == mine) features[f] = BodyFeature(place.w, place.xyz, placeTag[at]);
            EACH_FEATURE(ENTER)
        }
        placeFeature[at] = counts ? mine : kCovered;
        ++looked;
        if (looked >= placeCount) break;
    }
    if (looked < placeCount) placesLost = true;  // broken off, by a driver perhaps
    // Those that another has joined leave gaps.
    uint gaps = ~alive & ((1u << made) - 1u), found = made;
    for (uint k = 0u; k < made && gaps != 0u; ++k) {
        uint gap = uint(findLSB(gaps));
#define CLOSE(f) \
    if (f >= gap && f + 1u < kMaxBodyFeatures) features[f] = features[min(f + 1u, kMaxBodyFeatures - 1u)];
        EACH_FEATURE(CLOSE)
        gaps = gaps >> (gap + 1u) << gap;
        --found;
        if (gaps == 0u) break;
    }
    return placesLost ? kMaxBodyFeatures + 1u : found;
}

#undef MEET
#undef JOIN
#undef ENTER
#undef CLOSE

#endif
