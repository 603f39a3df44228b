// A particle as the contact laws see it.
#ifndef VKDOSE_PASS_BODY_GLSL
#define VKDOSE_PASS_BODY_GLSL

#include "law/surface.glsl"

struct Body {
    Sphere sphere;
    vec3 velocity;
    vec3 spin;
};

Body readBody(uint i) {
    vec4 position = readState(source, kPosition, i);
    return Body(Sphere(position.xyz, readState(source, kResidue, i).xyz, position.w),
                readState(source, kVelocity, i).xyz, readState(source, kSpin, i).xyz);
}

#endif
