// A scalar product that every pass rounds alike. glslang carries `precise` to sums and products, but not into dot(),
// which a driver may then compute in one way in one pass and in another way in the next.
#ifndef VKDOSE_LAW_PRECISE_GLSL
#define VKDOSE_LAW_PRECISE_GLSL

float preciseDot(vec3 a, vec3 b) {
    precise float sum = a.x * b.x + a.y * b.y + a.z * b.z;
    return sum;
}

#endif
