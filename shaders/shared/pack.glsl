// Vectors as integers of 64 bits, for devices that store component by component.
#ifndef VKDOSE_SHARED_PACK_GLSL
#define VKDOSE_SHARED_PACK_GLSL

u64vec2 pack(vec4 a) { return u64vec2(packUint2x32(floatBitsToUint(a.xy)), packUint2x32(floatBitsToUint(a.zw))); }
u64vec4 pack(vec4 a, vec4 b) { return u64vec4(pack(a), pack(b)); }

#endif
