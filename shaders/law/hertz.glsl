// Elastic spheres (Hertz 1882; Mindlin 1949): the stiffness at the overlap sets that of the other directions, and the
// damping of all (Tsuji 1992). physics.md, "Hertz and Mindlin".
#ifndef VKDOSE_LAW_HERTZ_GLSL
#define VKDOSE_LAW_HERTZ_GLSL

#include "law/answer.glsl"
#include "law/meeting.glsl"

/// Stiffness of the normal direction 2 E* sqrt(R* overlap) [N/m]; `reduced` is 2 R*.
float hertzStiffness(ContactParams p, float overlap, float reduced) {
    return 2.0 * p.normal.x * sqrt(0.5 * reduced * overlap);
}

/// The memory is the overlap.
NormalAnswer hertzAnswer(ContactParams p, float overlap, float reduced, float mass, inout float memory) {
    float was = hertzStiffness(p, memory, reduced), stiffness = hertzStiffness(p, overlap, reduced);
    memory = overlap;
    float damping = p.normal.y * sqrt(stiffness * mass);
    return NormalAnswer(2.0 / 3.0 * stiffness * overlap, damping, 0.0, stiffness * p.springs.xyz,
                        damping * p.damping.xyz, vec3(0.0), springsKept(was, stiffness));
}
NormalAnswer hertzAnswer(ContactParams p, Meeting m, inout History h) {
    return hertzAnswer(p, m.overlap, m.reduced, m.mass, h.slidingMax.w);
}

float hertzReach(ContactParams p, float reduced) { return 0.0; }
float hertzStored(ContactParams p, float force, float overlap, float reduced, float memory) {
    return 0.4 * force * overlap;
}
float hertzGrowth(ContactParams p, float before, float overlap, float reduced) { return sqrt(overlap / before); }
float hertzLost(ContactParams p, NormalStep s, float reduced) { return 0.0; }
bool hertzAdheres(ContactParams p, float force, float overlap) { return false; }

#endif
