// Sliding friction: spring, dashpot and Coulomb slider in the tangent plane. Rolling friction uses the same element.
#ifndef VKDOSE_LAW_SLIDING_GLSL
#define VKDOSE_LAW_SLIDING_GLSL

/// Turns the spring into the plane normal to n, keeping its length.
vec3 intoTangentPlane(vec3 spring, vec3 n) {
    vec3 tangent = spring - n * dot(n, spring);
    float old = dot(spring, spring);
    float now = dot(tangent, tangent);
    return now > 0.0 ? tangent * sqrt(old / now) : vec3(0.0);
}

/// Coulomb's limit [N]. Without friction it is 0 however large the force that bears on the contact is.
float coulombLimit(float mu, float bearing) { return mu > 0.0 ? mu * bearing : 0.0; }

/// `v` tangential velocity [m/s], `slipping` the damping while it slips [kg/s], `mu` coefficient of friction, `bearing`
/// the force that it is of [N], `dt` advance of the spring [s]. Returns the force [N] that resists v. `spring` [m]
/// becomes the spring of the next step; `slips` tells whether the slider slips. A contact with friction that bears
/// nothing keeps what the dashpot leaves in its spring.
vec3 frictionForce(float k, float gamma, float slipping, float mu, float bearing, vec3 n, vec3 v, float dt,
                   inout vec3 spring, out bool slips) {
    spring = intoTangentPlane(spring, n) + v * dt;
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
