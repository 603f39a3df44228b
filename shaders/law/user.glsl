// A contact under a law that a user wrote, in place of law/normal.glsl.
#ifndef VKDOSE_LAW_USER_GLSL
#define VKDOSE_LAW_USER_GLSL

#include "law/meeting.glsl"
#include "law/user_functions.glsl"

float userStored;  // energy of the contact that was answered last [J]
float userGrowth;  // its stiffness over that of the step before

/// Whether an answer is a number from 0 on.
bool answersSize(float x) { return x >= 0.0 && x <= 3.4e38; }

/// Answers that the trial would have refused (host/model/user_law_trial.cpp) make the force no number, which ends the
/// run: it would go on with wrong results.
NormalAnswer normalAnswer(ContactParams p, Meeting m, float speed, inout History h) {
    userParameters(p);
    userRecall(h.own);
    userSides(propertiesOfI, propertiesOfJ);
    UserContact c = UserContact(m.overlap, speed, 0.5 * m.reduced, m.mass);
    float force = Userforce(c), before = h.own[1].w;
    userKeep(h.own);
    float stiffness = Userstiffness(c), damping = userDamping(c), pull = userPull(c);
    userStored = userEnergy(c);
    userFlow = userFlows(c);
    bool sound = stiffness > 0.0 && stiffness <= p.normal.x && answersSize(damping) && answersSize(pull) &&
                 all(lessThanEqual(abs(userFlow), vec4(3.4e38)));
#ifdef ENERGY_BOOK
    sound = sound && answersSize(abs(userStored));
#endif
    if (!sound) force = uintBitsToFloat(0x7fc00000u);
    userGrowth = before > 0.0 ? stiffness / before : 1.0;
    h.slidingMax.w = max(m.overlap, 1e-9 * m.reduced);  // above 0: the contact goes on
    h.own[1].w = stiffness;
    return NormalAnswer(force, damping, pull, stiffness * p.springs.xyz, damping * p.damping.xyz, vec3(0.0),
                        springsKept(before, stiffness));
}

float storedEnergy(ContactParams p, float force, float overlap, float reduced, History h) { return userStored; }
bool stiffens(ContactParams p) { return true; }
vec3 springsAt(ContactParams p, float overlap, float reduced, History h) { return h.own[1].w * p.springs.xyz; }
float stiffnessGrowth(ContactParams p, float before, float overlap, float reduced) { return userGrowth; }
/// What it took and did not store, it lost: nobody else can say.
float lostByLaw(ContactParams p, NormalStep s, float reduced) { return s.taken - s.gained; }
bool adheres(ContactParams p, float force, float overlap) { return false; }

#endif
