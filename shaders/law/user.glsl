// A law of the normal force that a user wrote. The host puts its text in place of law/user_text.glsl, every name of it
// behind the prefix User, and behind it the functions userLoad, userKeep, userDamping, userPull and userEnergy, which
// know the law's parameters and memory (host/backend/vulkan/user_source.cpp).
#ifndef VKDOSE_LAW_USER_GLSL
#define VKDOSE_LAW_USER_GLSL

/// What the law is told of a contact.
struct UserContact {
    float overlap;  // [m]
    float speed;    // with which the two approach [m/s]
    float radius;   // reduced, a b/(a + b); of a sphere at a wall its own [m]
    float mass;     // reduced [kg]
};

#include "law/user_text.glsl"

float userStored;      // energy of the contact that was answered last [J]
float userGrowth;      // its stiffness over that of the step before

NormalAnswer userAnswer(ContactParams p, Meeting m, float speed, inout History h) {
    userLoad(p, h.own);
    UserContact c = UserContact(m.overlap, speed, 0.5 * m.reduced, m.mass);
    float force = Userforce(c), before = h.own[1].w;
    userKeep(h.own);
    float stiffness = Userstiffness(c), damping = userDamping(c);
    userStored = userEnergy(c);
    userGrowth = before > 0.0 ? stiffness / before : 1.0;
    h.slidingMax.w = m.overlap;
    h.own[1].w = stiffness;
    return NormalAnswer(force, damping, userPull(c), stiffness * p.springs.xyz, damping * p.damping.xyz, vec3(0.0));
}

#endif
