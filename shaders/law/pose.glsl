// From the world to the frame of a body and back (shared/geometry.h, BodyMotion). A centre goes to the body in
// two-float arithmetic, so that an overlap found there is as good as one found in the world.
#ifndef VKDOSE_LAW_POSE_GLSL
#define VKDOSE_LAW_POSE_GLSL

#include "law/twoproduct.glsl"
#include "shared/geometry.h"

/// A point of the world, high and low part [m], in the frame of the body.
Two3 toBody(BodyMotion m, vec3 high, vec3 low) {
    Two3 d = twoDifference(high, low, vec3(m.toBodyHigh[0].w, m.toBodyHigh[1].w, m.toBodyHigh[2].w),
                           vec3(m.toBodyLow[0].w, m.toBodyLow[1].w, m.toBodyLow[2].w));
    vec2 x = twoDot(Two3(m.toBodyHigh[0].xyz, m.toBodyLow[0].xyz), d);
    vec2 y = twoDot(Two3(m.toBodyHigh[1].xyz, m.toBodyLow[1].xyz), d);
    vec2 z = twoDot(Two3(m.toBodyHigh[2].xyz, m.toBodyLow[2].xyz), d);
    return Two3(vec3(x.x, y.x, z.x), vec3(x.y, y.y, z.y));
}

vec3 directionToBody(BodyMotion m, vec3 n) {
    return vec3(dot(m.toBodyHigh[0].xyz, n), dot(m.toBodyHigh[1].xyz, n), dot(m.toBodyHigh[2].xyz, n));
}

vec3 directionToWorld(BodyMotion m, vec3 n) {
    return m.toBodyHigh[0].xyz * n.x + m.toBodyHigh[1].xyz * n.y + m.toBodyHigh[2].xyz * n.z;
}

/// Velocity of the body at a point of the world [m/s].
vec3 bodyVelocity(BodyMotion m, vec3 x) { return m.velocity.xyz + cross(m.spin.xyz, x - m.centre.xyz); }

/// One over the mass that a contact at `x` with the normal `n` sees in a body that moves freely [1/kg]. One that still
/// stands is as a wall.
float perMassAt(BodyMotion m, vec3 x, vec3 n) {
    if (m.line.w <= 0.0) return 0.0;
    if (m.hinge.w == 0.0) return m.free.w;
    float lever = dot(m.line.xyz, cross(x - m.pivot.xyz, n));
    return lever * lever * m.free.w;
}

/// No point of a body that moves freely is faster [m/s].
float freeSpeed(BodyMotion m) { return m.hinge.w == 0.0 ? length(m.velocity.xyz) : abs(m.hinge.z) * m.hinge.w; }

#endif
