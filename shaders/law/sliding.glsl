// Sliding friction: spring, dashpot and Coulomb slider in the tangent plane. Rolling friction uses the same element.
#ifndef VKDOSE_LAW_SLIDING_GLSL
#define VKDOSE_LAW_SLIDING_GLSL

#include "law/grown.glsl"

/// sin^2 of the angle below which a spring counts as in the plane. Rounding alone turns it out by some 1e-7. If that
/// were taken back in every step, the steps of the spring would follow from the rounding of the steps before, and their
/// own rounding would no longer be even (law/grown.glsl): a spring of 0.3 um lost a fifteenth of its steps of 1e-14 m.
const float kInPlane = 1e-12;

/// By how much the spring changes when it is turned into the plane normal to n at its old length: from s to
/// (s - n (n.s))/cos, where sin = n.s/|s|. It is written as a small difference, so that a spring that hardly turns is
/// not rounded anew in every step.
vec3 turnIntoTangentPlane(vec3 spring, vec3 n) {
    float off = dot(n, spring), size = dot(spring, spring);
    float share = size > 0.0 ? off * off / size : 0.0;  // sin^2
    float cosine = sqrt(max(0.0, 1.0 - share));
    vec3 turn = cosine > 0.0 ? (spring * (share / (1.0 + cosine)) - n * off) / cosine : -spring;
    return share < kInPlane ? vec3(0.0) : turn;
}

/// Coulomb's limit [N]. Without friction it is 0 however large the force that bears on the contact is.
float coulombLimit(float mu, float bearing) { return mu > 0.0 ? mu * bearing : 0.0; }

/// `v` tangential velocity [m/s], `slipping` the damping while it slips [kg/s], `mu` coefficient of friction, `bearing`
/// the force that it is of [N], `dt` advance of the spring [s]. Returns the force [N] that resists v. `spring` [m]
/// becomes the spring of the next step; `slips` tells whether the slider slips. A contact with friction that bears
/// nothing keeps what the dashpot leaves in its spring.
vec3 frictionForce(float k, float gamma, float slipping, float mu, float bearing, vec3 n, vec3 v, float dt,
                   inout vec3 spring, out bool slips) {
    spring = grown(spring, turnIntoTangentPlane(spring, n) + v * dt);
    vec3 f = -k * spring - gamma * v;
    float size = length(f), limit = coulombLimit(mu, bearing);
    slips = size > limit;
    if (slips) {
        f *= limit / size;
        spring = k > 0.0 && mu > 0.0 ? -(f + slipping * v) / k : vec3(0.0);
    }
    return f;
}

#endif
