#version 450
// store_trial: no pass of a step. Each invocation stores two vectors as a pass does (writeHistory in
// shared/buffers.glsl), so that the host can time which of the two ways is faster. Writes a buffer of its own.
#ifdef PACKED_STORES
#extension GL_ARB_gpu_shader_int64 : require
#extension GL_GOOGLE_include_directive : require
#include "shared/pack.glsl"
layout(std430, set = 0, binding = 0) buffer PackedBuffer { u64vec4 stored[]; };
#else
layout(std430, set = 0, binding = 0) buffer PlainBuffer { vec4 stored[]; };
#endif
layout(local_size_x = 64) in;

void main() {
    uint i = gl_GlobalInvocationID.x;
    vec4 a = float(i) * vec4(1.0, 0.5, 0.25, 0.125), b = a + 1.0;
#ifdef PACKED_STORES
    stored[i] = pack(a, b);
#else
    stored[2u * i] = a;
    stored[2u * i + 1u] = b;
#endif
}
