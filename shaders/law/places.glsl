// The places where a body touches a sphere, and which of them are distinct features (geometry/features.h: `distinct`).
// The lists are variables of the invocation: arrays in arguments would be copied.
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
// Cosine of 10 degrees. Where more places touch than the list holds, of two closer than this the deeper stands for both.
const float kThinned = 0.9848;
const float kSameDepth = 2e-7;  // in radii: places of a ring around a sphere count as equally deep

vec4 placeAt[kMostPlaces];  // direction, depth
uint placeTag[kMostPlaces];
uint placeCount;
bool placesLost;                            // a place has found no room, or a loop has ended early
BodyFeature features[kMaxBodyFeatures];     // the answer

void clearPlaces() {
    placeCount = 0u;
    placesLost = false;
}

/// Lists a place that overlaps by `depth` > 0. Where the list is full, a place near to it in direction makes room.
void addPlace(float depth, vec3 direction, uint tag) {
    uint at = placeCount;
    float nearest = -2.0;
    for (uint i = 0u; i < kMostPlaces && placeCount == kMostPlaces; ++i) {
        float cosine = dot(placeAt[i].xyz, direction);
        if (cosine > nearest) {
            nearest = cosine;
            at = i;
        }
    }
    if (placeCount < kMostPlaces) {
        ++placeCount;
    } else {
        if (nearest < kThinned) placesLost = true;
        if (nearest < kThinned || placeAt[at].w >= depth) return;
    }
    placeAt[at] = vec4(direction, depth);
    placeTag[at] = tag;
}

/// Strikes out a place, if it is listed.
void dropPlace(uint tag) {
    for (uint i = 0u; i < placeCount; ++i)
        if (placeTag[i] == tag) placeAt[i].w = 0.0;
}

/// Whether the flat of the deeper contact covers the other, in a direction with this cosine to its own:
/// geometry/surface.h, oneContact, for directions that differ.
bool covered(float deeper, float shallower, float cosine, float radius) {
    return radius * (1.0 - cosine) + shallower * cosine - deeper < deeper;
}

/// Finds the distinct ones among the places, deepest first, ties by tag, and puts the first kMaxBodyFeatures into
/// `features`. Gives their number. If that is more than kMaxBodyFeatures, some could not be told.
uint distinctFeatures(float radius) {
    uint memberOf[kMostPlaces];  // of a place: the number of its feature
    uint headOf[kMostPlaces];    // of a feature: its deepest place
    uint left = 0u;
    for (uint i = 0u; i < placeCount; ++i)
        if (placeAt[i].w > 0.0) left |= 1u << i;
    uint members = 0u, kept = 0u, made = 0u;
    for (uint n = 0u; n < kMostPlaces && left != 0u; ++n) {
        uint best = 0u;
        vec4 place = vec4(0.0);
        uint tag = 0xffffffffu;
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
        uint touching = 0u;  // features with a member near to it in direction
        for (uint i = 0u; i < placeCount; ++i)
            if ((members >> i & 1u) != 0u && dot(placeAt[i].xyz, place.xyz) >= kOneFeature)
                touching |= 1u << memberOf[i];
        uint mine = touching != 0u ? uint(findLSB(touching)) : made;
        if (touching == 0u) {
            bool hidden = false;
            for (uint f = 0u; f < made; ++f) {
                vec4 head = placeAt[headOf[f]];
                hidden = hidden || ((kept >> f & 1u) != 0u && covered(head.w, place.w, dot(head.xyz, place.xyz), radius));
            }
            if (hidden) continue;
            headOf[made] = best;
            kept |= 1u << made;
            ++made;
        }
        members |= 1u << best;
        memberOf[best] = mine;
        // It joins features that are no deeper than itself: nothing lies between them.
        uint joined = 0u;
        for (uint f = mine + 1u; f < made; ++f)
            if ((touching >> f & 1u) != 0u && placeAt[headOf[f]].w - place.w <= kSameDepth * radius) joined |= 1u << f;
        kept &= ~joined;
        for (uint i = 0u; i < placeCount && joined != 0u; ++i)
            if ((members >> i & 1u) != 0u && (joined >> memberOf[i] & 1u) != 0u) memberOf[i] = mine;
    }
    uint found = 0u;
    for (uint f = 0u; f < made; ++f) {
        if ((kept >> f & 1u) == 0u) continue;
        vec4 head = placeAt[headOf[f]];
        if (found < kMaxBodyFeatures) features[found] = BodyFeature(head.w, head.xyz, placeTag[headOf[f]]);
        ++found;
    }
    return placesLost ? kMaxBodyFeatures + 1u : found;
}

#endif
