// Torsion friction: the scalar twin of sliding, about the normal. The spring has the same sign seen from either
// particle, because both the normal and the relative spin change sign. So one scalar serves the pair.
#ifndef VKDOSE_LAW_TORSION_GLSL
#define VKDOSE_LAW_TORSION_GLSL

#include "law/sliding.glsl"

/// `v` twisting velocity a_r n.(omega_i - omega_j) [m/s]. Returns the pseudo force [N] that resists it;
/// `slipping`: the damping while it slips [kg/s]; `slips`: whether it does.
float torsionForce(float k, float gamma, float slipping, float mu, float bearing, float v, float dt, inout float spring,
                   out bool slips) {
    spring = grown(spring, v * dt);
    float f = -k * spring - gamma * v;
    float limit = coulombLimit(mu, bearing);
    slips = abs(f) > limit;
    if (slips) {
        f = f > 0.0 ? limit : -limit;
        spring = k > 0.0 && mu > 0.0 ? -(f + slipping * v) / k : 0.0;
    }
    return f;
}

#endif
