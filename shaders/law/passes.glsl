// The pass between two places of a sphere on a body, and what of a contact it leaves (geometry/features.cpp). Depths
// count from `radius`, which is the sphere's with the reach of the law; `beyond` is this reach. Knows no tables.
#ifndef VKDOSE_LAW_PASSES_GLSL
#define VKDOSE_LAW_PASSES_GLSL

struct Place {
    vec4 at;    // direction to the centre, unit; depth [m]
    uint bend;  // how the direction turns when the sphere moves: one of the following, or that of an edge
};
const uint kFlat = 0u;
const uint kAtCorner = 2u;

/// Of an edge: its direction in 31 bits, which are enough for what a bend is used for, and 1 in the lowest.
uint bendOfEdge(vec3 along) {
    vec3 e = along / (abs(along.x) + abs(along.y) + abs(along.z));
    vec2 folded = e.z < 0.0 ? (1.0 - abs(e.yx)) * vec2(e.x < 0.0 ? -1.0 : 1.0, e.y < 0.0 ? -1.0 : 1.0) : e.xy;
    return packSnorm2x16(folded) | 1u;
}

vec3 edgeOf(uint bend) {
    vec2 folded = unpackSnorm2x16(bend);
    vec3 e = vec3(folded, 1.0 - abs(folded.x) - abs(folded.y));
    if (e.z < 0.0) e.xy = (1.0 - abs(e.yx)) * vec2(e.x < 0.0 ? -1.0 : 1.0, e.y < 0.0 ? -1.0 : 1.0);
    return normalize(e);
}

const float kNoPass = -3.4e38;
const float kPassCosine = 0.98480775, kPassSine = 0.17364818;  // of 10 degrees

/// How the tangent planes of two places meet.
struct Ridge {
    float far;     // of the shallower place from the centre [m]
    float cosine;  // of the angle between the planes
    float sine2;   // squared sine
    float height;  // of the shallower place above the plane of the deeper one [m]
    float away2;   // squared distance of the ridge from the shallower place [m2]
    float drop;    // above 0: the ridge parts the places, and the pass is by this, over a length, less deep [m2]
};

Ridge ridgeOf(vec4 deeper, vec4 shallower, float radius) {
    vec3 between = deeper.xyz - shallower.xyz;
    float versine = 0.5 * dot(between, between), far = radius - shallower.w;
    float sine2 = versine * (2.0 - versine), height = (shallower.w - deeper.w) + far * versine;
    float away2 = height * height / max(sine2, 1e-12);
    float drop = kPassCosine * kPassCosine * away2 - kPassSine * kPassSine * far * far;
    return Ridge(far, 1.0 - versine, sine2, height, away2, height > 0.0 ? drop : 0.0);
}

float depthOf(Ridge r, float shallower) {
    return r.drop > 0.0 ? shallower - r.drop / (kPassCosine * sqrt(r.far * r.far + r.away2) + r.far) : shallower;
}

/// Depth of the pass between two places.
float passDepth(vec4 a, vec4 b, float radius) {
    bool swapped = b.w > a.w;
    vec4 deeper = swapped ? b : a, shallower = swapped ? a : b;
    return depthOf(ridgeOf(deeper, shallower, radius), shallower.w);
}

/// Change of a place's direction with the centre, times `v`.
vec3 turnedBy(Place place, vec3 v, float radius) {
    vec3 square = v - place.at.xyz * dot(place.at.xyz, v);
    if ((place.bend & 1u) != 0u) {
        vec3 along = edgeOf(place.bend);
        square -= along * dot(along, v);
    }
    return place.bend == kFlat ? vec3(0.0) : square / (radius - place.at.w);
}

/// What a pass leaves of a contact: its overlap, normal and share (geometry/features.h).
struct Left {
    float depth;
    vec3 direction;
    float share;
};

/// Of the contact in `place`, if the pass between a and b leads from it to a deeper one.
Left leftBy(Place place, Place a, Place b, float radius, float beyond) {
    Place i = a, j = b;
    if (b.at.w > a.at.w) {
        i = b;
        j = a;
    }
    Ridge ridge = ridgeOf(i.at, j.at, radius);
    vec3 fall = j.at.xyz;
    if (ridge.drop > 0.0) {
        float x = ridge.height / ridge.sine2;
        float y = (ridge.far - ridge.cosine * (radius - i.at.w)) / ridge.sine2;
        vec3 opening = turnedBy(i, j.at.xyz, radius) + turnedBy(j, i.at.xyz, radius);
        fall =
            kPassCosine * (x * i.at.xyz + y * j.at.xyz - x * y * opening) / sqrt(ridge.far * ridge.far + ridge.away2);
    }
    float depth = place.at.w - beyond, part = (depthOf(ridge, j.at.w) - beyond) / depth;
    vec3 push = (1.0 + part * part) * place.at.xyz - 2.0 * part * fall;
    float share = length(push);
    return Left(depth * (1.0 - part * part) + beyond, share > 0.0 ? push / share : place.at.xyz, share);
}

#endif
