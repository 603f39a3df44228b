// A contact under a user's law (law/user_functions.glsl).
#ifndef VKDOSE_LAW_USER_GLSL
#define VKDOSE_LAW_USER_GLSL

float userStored;  // energy of the contact that was answered last [J]
float userGrowth;  // its stiffness over that of the step before

/// Whether an answer is a number from 0 on.
bool answersSize(float x) { return x >= 0.0 && x <= 3.4e38; }

/// Answers that the trial would have refused (host/model/user_law_trial.cpp) make the force no number, which ends the
/// run: it would go on with wrong results.
NormalAnswer userAnswer(ContactParams p, Meeting m, float speed, inout History h) {
    userParameters(p);
    userRecall(h.own);
    UserContact c = UserContact(m.overlap, speed, 0.5 * m.reduced, m.mass);
    float force = Userforce(c), before = h.own[1].w;
    userKeep(h.own);
    float stiffness = Userstiffness(c), damping = userDamping(c), pull = userPull(c);
    userStored = userEnergy(c);
    bool sound = stiffness > 0.0 && stiffness <= p.normal.x && answersSize(damping) && answersSize(pull);
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

#endif
