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
/// particle's radius, unless the wall is curved.
WallForce meetWall(Body me, Overlap o, float reduced, ContactParams law, uvec4 choices, float density, float springDt,
                   vec3 wall, vec3 wallSpin, inout History h, out Response r) {
    float lever = me.sphere.radius - 0.5 * o.depth;
    Meeting m = Meeting(o.normal, o.depth, reduced, sphereMass(density, me.sphere.radius),
                        (me.velocity - wall) - lever * cross(me.spin, o.normal), me.spin - wallSpin);
    r = contactResponse(law, choices, m, springDt, h);
    return WallForce(r.force, r.couple, r.couple - lever * cross(o.normal, r.sliding));
}

#endif
