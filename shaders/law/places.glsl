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

const uint kMostPlaces = 32u;      // one bit of a word each
const float kOneFeature = 0.9397;  // cosine of 20 degrees: geometry/surface.h, kSameDirection
// Where more places touch than the list holds, of two closer than 14 degrees the deeper stands for both, and places are
// one feature if they are within 45 degrees. That happens where a sphere fits snugly into a ring of many facets.
const float kThinned = 0.9703;
const float kOneThinned = 0.7071;
const float kSameDepth = 2e-7;  // in radii: places of a ring around a sphere count as equally deep

vec4 placeAt[kMostPlaces];  // direction, depth
uint placeTag[kMostPlaces];
uint placeCount;
bool placesThinned;                      // some stand for others
bool placesLost;                         // a place has found no room, or a loop has ended early
BodyFeature features[kMaxBodyFeatures];  // the answer

void clearPlaces() {
    placeCount = 0u;
    placesThinned = false;
    placesLost = false;
}

/// Makes room: of each two places that are close in direction, the deeper stays.
void thinPlaces() {
    uint stay = 0u;
    for (uint i = 0u; i < placeCount; ++i) {
        vec4 place = placeAt[i];
        uint tag = placeTag[i];
        uint at = stay;
        for (uint j = 0u; j < stay && at == stay; ++j)
            if (dot(placeAt[j].xyz, place.xyz) >= kThinned) at = j;
        if (at == stay)
            ++stay;
        else if (placeAt[at].w >= place.w)
            continue;
        placeAt[at] = place;
        placeTag[at] = tag;
    }
    placeCount = stay;
    placesThinned = true;
}

/// Lists a place that overlaps by `depth` > 0.
void addPlace(float depth, vec3 direction, uint tag) {
    uint at = placeCount;
    uint rivals = placesThinned ? placeCount : 0u;
    for (uint i = 0u; i < rivals && at == placeCount; ++i)
        if (dot(placeAt[i].xyz, direction) >= kThinned) at = i;
    if (at < placeCount && placeAt[at].w >= depth) return;
    if (at == kMostPlaces) {
        placesLost = true;
        return;
    }
    if (at == placeCount) ++placeCount;
    placeAt[at] = vec4(direction, depth);
    placeTag[at] = tag;
}

/// Whether the flat of a deeper contact covers a place in another direction: geometry/surface.h, oneContact.
bool covered(BodyFeature deeper, vec4 place, float radius) {
    float cosine = dot(deeper.direction, place.xyz);
    return radius * (1.0 - cosine) + place.w * cosine - deeper.depth < deeper.depth;
}

// Features are few and looked at by all places, so they have constant numbers, written out: X(f) for each.
#define EACH_FEATURE(X) X(0u) X(1u) X(2u) X(3u) X(4u) X(5u) X(6u) X(7u)

/// Finds the distinct ones among the places, deepest first, ties by tag, and puts the first kMaxBodyFeatures into
/// `features`. Gives their number. If that is more than kMaxBodyFeatures, some could not be told.
uint distinctFeatures(float radius) {
    uint group[kMaxBodyFeatures];  // the places of a feature, a bit each
#define CLEAR(f) group[f] = 0u;
    EACH_FEATURE(CLEAR)
    float oneFeature = placesThinned ? kOneThinned : kOneFeature;
    uint left = placeCount == 0u ? 0u : 0xffffffffu >> (kMostPlaces - placeCount);
    uint members = 0u, made = 0u;
    for (uint n = 0u; n < placeCount && left != 0u; ++n) {
        uint best = 0u, tag = 0xffffffffu;
        vec4 place = vec4(0.0);
        for (uint i = 0u; i < placeCount; ++i) {
            vec4 other = placeAt[i];
            uint otherTag = placeTag[i];
            bool first = other.w > place.w || (other.w == place.w && otherTag < tag);
            if ((left >> i & 1u) == 0u || !first) continue;
            best = i;
            place = other;
            tag = otherTag;
        }
        left &= ~(1u << best);
        uint close = 0u;  // members in nearly the same direction
        for (uint i = 0u; i < placeCount && members != 0u; ++i)
            if (dot(placeAt[i].xyz, place.xyz) >= oneFeature) close |= 1u << i;
        close &= members;
        uint touching = 0u;  // features that it belongs to
        bool hidden = false;
#define MEET(f)                                        \
    if ((group[f] & close) != 0u) touching |= 1u << f; \
    hidden = hidden || (group[f] != 0u && covered(features[f], place, radius));
        EACH_FEATURE(MEET)
        if (touching == 0u && hidden) continue;
        uint mine = touching != 0u ? uint(findLSB(touching)) : made;
        if (touching == 0u) ++made;
        uint all = 1u << best;
        members |= all;
        // It joins features that are no deeper than itself: nothing lies between them.
#define JOIN(f)                                                                                         \
    if (f > mine && (touching >> f & 1u) != 0u && features[f].depth - place.w <= kSameDepth * radius) { \
        all |= group[f];                                                                                \
        group[f] = 0u;                                                                                  \
    }
        EACH_FEATURE(JOIN)
#define ENTER(f)                                                                \
    if (f == mine) {                                                            \
        if (group[f] == 0u) features[f] = BodyFeature(place.w, place.xyz, tag); \
        group[f] |= all;                                                        \
    }
        EACH_FEATURE(ENTER)
    }
    // Those that another has joined leave gaps.
    uint gaps = 0u;
#define LOOK(f) \
    if (f < made && group[f] == 0u) gaps |= 1u << f;
    EACH_FEATURE(LOOK)
    uint found = made;
    for (uint n = 0u; n < made && gaps != 0u; ++n) {
        uint gap = uint(findLSB(gaps));
#define CLOSE(f) \
    if (f >= gap && f + 1u < kMaxBodyFeatures) features[f] = features[min(f + 1u, kMaxBodyFeatures - 1u)];
        EACH_FEATURE(CLOSE)
        gaps = gaps >> (gap + 1u) << gap;
        --found;
    }
    return placesLost ? kMaxBodyFeatures + 1u : found;
}

#undef CLEAR
#undef MEET
#undef JOIN
#undef ENTER
#undef LOOK
#undef CLOSE

#endif
