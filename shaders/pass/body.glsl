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
    vec4 position = readState(push.source, kPosition, i);
    return Body(Sphere(position.xyz, readState(push.source, kResidue, i).xyz, position.w),
                readState(push.source, kVelocity, i).xyz, readState(push.source, kSpin, i).xyz);
}

#endif
