#version 450
// Asks law/features.glsl for each query, and writes the answer down. For tests alone.
#extension GL_GOOGLE_include_directive : require
#include "shared/geometry.h"

layout(constant_id = 0) const uint SHAPE_KINDS = 0xffffffffu;
layout(constant_id = 1) const uint MOST_PLACES = kFewPlaces;
layout(local_size_x = 64) in;

struct Query {
    vec4 high;  // centre in the world [m]; w: radius [m]
    vec4 low;   // w: number of the body
};

layout(std430, set = 0, binding = 0) readonly buffer GeometryBuffer {
    uvec4 geometry[];
};
layout(std430, set = 0, binding = 1) readonly buffer MotionBuffer {
    BodyMotion motions[];
};
layout(std430, set = 0, binding = 2) readonly buffer QueryBuffer {
    Query queries[];
};
layout(std430, set = 0, binding = 3) writeonly buffer CountBuffer {
    uvec4 counts[];
};
layout(std430, set = 0, binding = 4) writeonly buffer FeatureBuffer {
    vec4 answers[];
};  // direction in the world, depth
layout(push_constant) uniform Push {
    uint queryCount;
};

#ifdef TEXEL_READS
#extension GL_EXT_samplerless_texture_functions : require
layout(set = 0, binding = 5) uniform utextureBuffer geometryView;
uvec4 geometryAt(uint i) {
    return texelFetch(geometryView, int(i));
}
#else
uvec4 geometryAt(uint i) {
    return geometry[i];
}
#endif

uint listed[kNearbyWords];
uint nearbyAt(uint i) {
    return listed[i];
}
void keepNearby(uint i, uint entry) {
    listed[i] = entry;
}
#define KEEPS_NEARBY

#include "law/features.glsl"
#include "law/pose.glsl"

/// Whether the answer is the same to the bit with the list of a mesh that was made at another place, from which the
/// centre has come here. For bodies of one mesh.
bool sameFromList(uint body, Two3 centre, float radius, uint q, uint count) {
    BodyFeature before[kMaxBodyFeatures];
    for (uint k = 0u; k < kMaxBodyFeatures; ++k) before[k] = features[k];
    // All about the sphere in turn, by a little less than the slack: the length of the direction is below 1.
    float slack = 0.04 * radius, turn = 2.399963 * float(q), height = 2.0 * fract(0.618034 * float(q)) - 1.0;
    vec3 way = vec3(sqrt(1.0 - height * height) * vec2(cos(turn), sin(turn)), height);
    Two3 was = Two3(centre.high + 0.999 * slack * way, centre.low);
    uint shape = geometryAt(kBodyVectors * body).x;
    if (geometryAt(kBodyVectors * body).y != 1u) return true;
    nearbyCount = listNearby(shape, geometryAt(shape), was, radius, slack);
    if (nearbyCount == kWholeCell) return true;
    bool same = touchedFeatures(body, centre, radius, 0.0) == count;
    for (uint k = 0u; k < min(count, kMaxBodyFeatures); ++k)
        same = same && features[k].depth == before[k].depth && features[k].direction == before[k].direction;
    return same;
}

void main() {
    uint q = gl_GlobalInvocationID.x;
    if (q >= queryCount) return;
    vec4 high = queries[q].high, low = queries[q].low;
    uint body = uint(low.w);
    BodyMotion motion = motions[body];
    Two3 centre = toBody(motion, high.xyz, low.xyz);
    uint count = touchedFeatures(body, centre, high.w, 0.0);
    bool may = mayTouch(body, centre, high.w), near = mayBeNear(body, centre, high.w);
    for (uint k = 0u; k < kMaxBodyFeatures; ++k)
        if (k < count)
            answers[kMaxBodyFeatures * q + k] =
                vec4(directionToWorld(motion, features[k].direction), features[k].depth);
    bool same = true;
    if (SHAPE_KINDS == 1u << kShapeMesh) same = sameFromList(body, centre, high.w, q, count);
    counts[q] = uvec4(count, may ? 1u : 0u, near ? 1u : 0u, same ? 1u : 0u);
}
