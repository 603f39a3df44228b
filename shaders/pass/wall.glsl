// A particle against a wall, at rest or turning.
#ifndef VKDOSE_PASS_WALL_GLSL
#define VKDOSE_PASS_WALL_GLSL

#include "law/contact.glsl"
#include "pass/body.glsl"

struct WallForce {
    vec3 force;
    vec3 couple;
    vec3 torque;  // couple and the force's moment about the particle's centre
};

/// Contact with a wall that moves with velocity `wall` at the contact and turns with `wallSpin`. `reduced` is twice the
/// particle's radius, unless the wall is curved. `share` is that of the contact (law/contact.glsl). `perMass` is one
/// over the mass of a body that moves freely [1/kg], else 0.
WallForce meetWall(Body me, Overlap o, float share, float reduced, ContactParams law, uvec4 choices, float density,
                   float perMass, float springDt, vec3 wall, vec3 wallSpin, inout History h, out Response r) {
    float lever = me.sphere.radius - 0.5 * o.depth, mass = sphereMass(density, me.sphere.radius);
    Meeting m = Meeting(o.normal, o.depth, reduced, mass / (1.0 + mass * perMass),
                        (me.velocity - wall) - lever * cross(me.spin, o.normal), me.spin - wallSpin, share);
    r = contactResponse(law, choices, m, springDt, h);
    return WallForce(r.force, r.couple, r.couple - lever * cross(o.normal, r.sliding));
}

#endif
