// A contact as a law sees it: how two bodies meet, and what is remembered of it.
#ifndef VKDOSE_LAW_MEETING_GLSL
#define VKDOSE_LAW_MEETING_GLSL

struct History {
    vec4 slidingMax;      // xyz: sliding spring [m]; w: delta_max [m]
    vec4 rollingTorsion;  // xyz: rolling spring [m]; w: torsion spring [m]
#ifdef USER_LAW
    vec4 own[2];  // what the user's law remembers; the last: its stiffness in the last step [N/m]
#else
    float last;  // overlap of the last step, of a law that keeps it [m]; 0: there was none
#endif
};

History noHistory() {
    History h;
    h.slidingMax = vec4(0.0);
    h.rollingTorsion = vec4(0.0);
#ifdef USER_LAW
    h.own[0] = vec4(0.0);
    h.own[1] = vec4(0.0);
#else
    h.last = 0.0;
#endif
    return h;
}

struct Meeting {
    vec3 normal;    // from j to i
    float overlap;  // [m], > 0
    float reduced;  // 2 a_i a_j/(a_i + a_j), wall 2 a_i [m]
    float mass;     // reduced mass [kg]
    vec3 velocity;  // of i relative to j at the contact point [m/s]
    vec3 spin;      // omega_i - omega_j [rad/s]
    float share;    // how much the overlap falls per way along the normal (geometry/features.h)
};

/// What the ledger is told of a contact's step along the normal.
struct NormalStep {
    bool touched, touches;             // in the step before, and now
    float forceBefore, overlapBefore;  // without damping [N], [m]
    float force, overlap;              // now
    float taken;                       // work that the force took from the motion [J]
    float gained;                      // what the contact stores more than before [J]
};

#endif
