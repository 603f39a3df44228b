// A particle as the contact laws see it.
#ifndef VKDOSE_PASS_BODY_GLSL
#define VKDOSE_PASS_BODY_GLSL

#include "law/mass.glsl"
#include "law/surface.glsl"

struct Body {
    Sphere sphere;
    vec3 velocity;
    vec3 spin;
    uint material;
};

Body readBody(uint i) {
    vec4 position = readState(source, kPosition, i), residue = readState(source, kResidue, i);
    return Body(Sphere(position.xyz, residue.xyz, position.w), readState(source, kVelocity, i).xyz,
                readState(source, kSpin, i).xyz, materialIn(residue.w));
}

/// Reduced size of a sphere of radius a at a surface of radius `curvature`, which is flat if that is 0 [m].
float reducedAtWall(float a, float curvature) {
    return curvature != 0.0 ? 2.0 * a * curvature / (a + curvature) : 2.0 * a;
}

#endif
