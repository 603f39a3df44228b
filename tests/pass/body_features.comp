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

uint nearbyAt(uint i) {
    return 0u;
}

#include "law/features.glsl"
#include "law/pose.glsl"

void main() {
    uint q = gl_GlobalInvocationID.x;
    if (q >= queryCount) return;
    vec4 high = queries[q].high, low = queries[q].low;
    uint body = uint(low.w);
    BodyMotion motion = motions[body];
    Two3 centre = toBody(motion, high.xyz, low.xyz);
    uint count = touchedFeatures(body, centre, high.w);
    bool may = mayTouch(body, centre, high.w), near = mayBeNear(body, centre, high.w);
    counts[q] = uvec4(count, may ? 1u : 0u, near ? 1u : 0u, 0u);
    for (uint k = 0u; k < kMaxBodyFeatures; ++k)
        if (k < count)
            answers[kMaxBodyFeatures * q + k] =
                vec4(directionToWorld(motion, features[k].direction), features[k].depth);
}
