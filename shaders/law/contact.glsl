// One contact: normal, sliding, rolling and torsion put together. Knows no tables.
#ifndef VKDOSE_LAW_CONTACT_GLSL
#define VKDOSE_LAW_CONTACT_GLSL

#ifdef USER_LAW
#include "law/user.glsl"
#else
#include "law/normal.glsl"
#endif
#include "law/rolling.glsl"
#include "law/sliding.glsl"
#include "law/torsion.glsl"

struct Response {
    vec3 force;                 // on i [N]; on j the opposite
    vec3 sliding;               // its tangential part, which acts on the lever arms [N]
    vec3 couple;                // rolling and torsion torque on i [N m]; on j the opposite
    float hysteretic, damping;  // along the normal: that of the law without damping, and the damping that acts [N]
    bvec3 slips;                // sliding, rolling, torsion
};

Response contactResponse(ContactParams p, uvec4 choices, Meeting m, float dt, inout History h) {
    float vn = dot(m.velocity, m.normal);
    vec3 vt = m.velocity - m.normal * vn;
    NormalAnswer answer = normalAnswer(p, m, -m.share * vn, h);
    float f = answer.force;
    float damping = -answer.damping * m.share * vn;
    float fn = m.share * (f + damping);
    // Friction is limited by the normal force, counted from the adhesive limit (Luding 2008), or by its size.
    bool bySize = (uint(p.springs.w) & kLimitAbsolute) != 0u;
    float bearing = bySize ? abs(fn) : m.share * max(0.0, f + answer.pull);

    bool slides, rolls, twists;
    vec3 spring = answer.kept * h.slidingMax.xyz;
    vec3 ft = frictionForce(answer.springs.x, answer.dampings.x, answer.slipping.x, p.friction.x, bearing, m.normal, vt,
                            dt, spring, slides);
    h.slidingMax.xyz = spring;

    float lever = rollingLever(m.reduced, choices.x);
    spring = answer.kept * h.rollingTorsion.xyz;
    vec3 fr = frictionForce(answer.springs.y, answer.dampings.y, answer.slipping.y, p.friction.y, bearing, m.normal,
                            rollingVelocity(lever, m.normal, m.spin), dt, spring, rolls);
    h.rollingTorsion.xyz = spring;

    float twist = answer.kept * h.rollingTorsion.w;
    float fto = torsionForce(answer.springs.z, answer.dampings.z, answer.slipping.z, p.friction.z, bearing,
                             lever * dot(m.normal, m.spin), dt, twist, twists);
    h.rollingTorsion.w = twist;

    return Response(m.normal * fn + ft, ft, lever * (cross(m.normal, fr) + m.normal * fto), f, m.share * damping,
                    bvec3(slides, rolls, twists));
}

#endif
