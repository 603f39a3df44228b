// A particle as the contact laws see it.
#ifndef VKDOSE_PASS_BODY_GLSL
#define VKDOSE_PASS_BODY_GLSL

#include "law/mass.glsl"
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

/// Reduced size of a sphere of radius a at the coil: the wire counts as curved or as flat (CoilParams) [m].
float reducedAtCoil(CoilParams coil, float a) {
    float wire = coil.radius.z;
    return coil.motion.w != 0.0 ? 2.0 * a * wire / (a + wire) : 2.0 * a;
}

#endif
