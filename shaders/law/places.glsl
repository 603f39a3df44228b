// The places where a body touches a sphere, and which of them are distinct features (geometry/features.h: `distinct`).
// The lists are variables of the invocation: arrays in arguments would be copied. No loop has a constant bound: drivers
// would write such a one out, 32 times over.
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

/// Lists a place that overlaps by `depth` > 0.
void addPlace(float depth, vec3 direction, uint tag) {
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
        if (placeFeature[i] != kNotLookedAt || !first) continue;
        best = i;
        depth = other;
        tag = otherTag;
    }
    return best;
}

/// Finds the distinct ones among the places, deepest first, ties by tag, and puts the first kMaxBodyFeatures into
/// `features`. Gives their number. If that is more than kMaxBodyFeatures, some could not be told.
uint distinctFeatures(float radius) {
    uint made = 0u, alive = 0u;  // features; a bit for each that no other has joined
    uint n = 0u;
    for (; n < placeCount; ++n) {
        uint at = deepestLeft();
        vec4 place = placeAt[at];
        uint touching = 0u;  // features that it belongs to, a bit each
        for (uint i = 0u; i < placeCount && made > 0u; ++i) {
            uint f = placeFeature[i];
            if (f < kMaxBodyFeatures && dot(placeAt[i].xyz, place.xyz) >= kOneFeature) touching |= 1u << f;
        }
        bool hidden = false;
#define MEET(f) hidden = hidden || ((alive >> f & 1u) != 0u && covered(features[f], place, radius));
        EACH_FEATURE(MEET)
        if (touching == 0u && hidden) {
            placeFeature[at] = kCovered;
            continue;
        }
        uint mine = touching != 0u ? uint(findLSB(touching)) : made;
        if (mine == kMaxBodyFeatures) {
            placesLost = true;
            break;
        }
        // It joins features that are no deeper than itself: nothing lies between them.
        uint joins = 0u;
#define JOIN(f) \
    if (f > mine && (touching >> f & 1u) != 0u && features[f].depth - place.w <= kSameDepth * radius) joins |= 1u << f;
        EACH_FEATURE(JOIN)
        for (uint i = 0u; i < placeCount && joins != 0u; ++i) {
            uint f = placeFeature[i];
            if (f < kMaxBodyFeatures && (joins >> f & 1u) != 0u) placeFeature[i] = mine;
        }
        alive &= ~joins;
        if (touching == 0u) {
            ++made;
            alive |= 1u << mine;
#define ENTER(f) \
    if (f == mine) features[f] = BodyFeature(place.w, place.xyz, placeTag[at]);
            EACH_FEATURE(ENTER)
        }
        placeFeature[at] = mine;
    }
    if (n < placeCount) placesLost = true;  // broken off, by a driver perhaps
    // Those that another has joined leave gaps.
    uint gaps = ~alive & ((1u << made) - 1u), found = made;
    for (uint k = 0u; k < made && gaps != 0u; ++k) {
        uint gap = uint(findLSB(gaps));
#define CLOSE(f) \
    if (f >= gap && f + 1u < kMaxBodyFeatures) features[f] = features[min(f + 1u, kMaxBodyFeatures - 1u)];
        EACH_FEATURE(CLOSE)
        gaps = gaps >> (gap + 1u) << gap;
        --found;
    }
    return placesLost ? kMaxBodyFeatures + 1u : found;
}

#undef MEET
#undef JOIN
#undef ENTER
#undef CLOSE

#endif
