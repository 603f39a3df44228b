// The energy of a contact in a step (host/backend/backend.h, EnergyBook, for the balance): each part of its force takes
// some from the motion, stores some in its spring and loses the rest. Knows no tables.
#ifndef VKDOSE_LAW_ENERGY_GLSL
#define VKDOSE_LAW_ENERGY_GLSL

#include "law/contact.glsl"

/// Force and place of a contact in a step, kept until the next; all zero if it did not touch.
struct Exerted {
    vec4 normal;  // xyz: normal; w: force along it, without damping [N]
    vec4 rest;    // xyz: damping and sliding force on i [N]; w: overlap [m]
    vec4 couple;  // xyz: rolling and torsion torque on i [N m]; w: energy of the normal spring [J]
};

struct Book {
    vec4 normal;  // fields as in shared/layout.h
    vec4 sliders;
    vec4 flow;
    vec4 elastic;
};

/// Work that the parts of a force take from the motion [J].
struct Work {
    float hysteretic;
    float damping;
    vec3 sliders;  // sliding, rolling, torsion
};

/// Energy in the springs of sliding, rolling and torsion of a contact at this overlap [J].
vec3 sliderEnergy(ContactParams p, float overlap, float reduced, History h) {
    vec3 springs = springsAt(p, overlap, reduced, h);
    return 0.5 * vec3(springs.x * dot(h.slidingMax.xyz, h.slidingMax.xyz),
                      springs.y * dot(h.rollingTorsion.xyz, h.rollingTorsion.xyz),
                      springs.z * h.rollingTorsion.w * h.rollingTorsion.w);
}

/// Energy in all springs of a contact that exerts `f`: normal, sliding, rolling, torsion [J].
vec4 elasticEnergy(ContactParams p, float f, float overlap, float reduced, History h) {
    return vec4(storedEnergy(p, f, overlap, reduced, h), sliderEnergy(p, overlap, reduced, h));
}

/// Energy that is gone with a contact which exerted `e` [J].
float storedIn(ContactParams p, Exerted e, float reduced, History h) {
    return dot(vec4(e.couple.w, sliderEnergy(p, e.rest.w, reduced, h)), vec4(1.0));
}

/// Share of its energy that a spring loses whose stiffness grows by this factor, or falls.
float shareLost(float factor) { return 1.0 - min(factor, 1.0 / factor); }

/// Work that the force `e` takes in half a step `dt` [s] from a contact that moves with `velocity`, seen where the
/// force acted, and `spin` (both of i relative to j).
Work halfStepWork(Exerted e, vec3 velocity, vec3 spin, float dt) {
    vec3 n = e.normal.xyz;
    float damping = dot(n, e.rest.xyz), twist = dot(n, e.couple.xyz);
    vec3 sliding = e.rest.xyz - n * damping, rolling = e.couple.xyz - n * twist;
    float along = -0.5 * dt * dot(n, velocity);
    return Work(along * e.normal.w, along * damping,
                -0.5 * dt * vec3(dot(sliding, velocity), dot(rolling, spin), twist * dot(n, spin)));
}

/// Books a step of a contact: `known` if it touched before, `touching` if it does now (`before` or `now` is zero if
/// not); `stored` is the energy of its springs then and now. Twin of reference/energy.cpp, which argues the terms.
Book bookContact(Exerted before, Exerted now, bool known, bool touching, vec4 storedBefore, vec4 stored, Work a, Work b,
                 ContactParams p, float reduced, bvec3 slips) {
    vec4 gained = stored - storedBefore;
    float taken = a.hysteretic + b.hysteretic;
    NormalStep s =
        NormalStep(known, touching, before.normal.w, before.rest.w, now.normal.w, now.rest.w, taken, gained.x);
    float loss = lostByLaw(p, s, reduced);
    Exerted last = now;
    if (!touching) last = before;
    bool adhesive = adheres(p, last.normal.w, last.rest.w);

    vec3 spent = a.sliders + b.sliders - gained.yzw;
    vec3 slipping = vec3(touching ? slips : bvec3(true));  // when a contact opens its springs snap
    vec3 friction = spent * slipping;
    float sticking = dot(spent, vec3(1.0) - slipping);
    // Where the overlap changes the stiffness the springs lose energy (springsKept). Friction has what goes to no
    // motion.
    if (stiffens(p) && known && touching) {
        float share = shareLost(stiffnessGrowth(p, before.rest.w, now.rest.w, reduced));
        vec3 lost = storedBefore.yzw * share * (vec3(1.0) - slipping);
        friction += lost;
        sticking -= lost.x + lost.y + lost.z;
    }
    return Book(
        vec4(adhesive ? 0.0 : loss, adhesive ? loss : 0.0, a.damping + b.damping + sticking, taken - gained.x - loss),
        vec4(friction, 0.0), vec4(0.0), stored);
}

/// Books the first step of a contact that touched when it was loaded.
Book bookLoaded(vec4 stored) { return Book(vec4(0.0), vec4(-stored.yzw, 0.0), vec4(stored.x, 0.0, 0.0, 0.0), stored); }

#endif
