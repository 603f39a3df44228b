// The functions of a law of the normal force that a user wrote. The host puts its text in place of law/user_text.glsl,
// every name of it behind the prefix User, and behind it the functions userParameters, userRecall, userKeep, userSides,
// userDamping, userPull, userEnergy, userReach and userFlows, which know what the law declares (host/law/user_law.cpp).
#ifndef VKDOSE_LAW_USER_FUNCTIONS_GLSL
#define VKDOSE_LAW_USER_FUNCTIONS_GLSL

#include "law/answer.glsl"
#include "law/reach.glsl"

/// What the law is told of a contact.
struct UserContact {
    float overlap;  // beyond touch negative [m]
    float speed;    // with which the two approach [m/s]
    float radius;   // reduced, a b/(a + b); of a sphere at a wall its own [m]
    float mass;     // reduced [kg]
};

#include "law/user_text.glsl"

/// The properties of the two sides of the contact that is asked for next (pass/sides.glsl), and what the first side has
/// gained by the contact that was answered last [unit/s].
vec4 propertiesOfI = vec4(0.0), propertiesOfJ = vec4(0.0), userFlow = vec4(0.0);

/// As in law/normal.glsl. Lists reach no farther than the trial found.
float reachOf(ContactParams p, float reduced) {
    userParameters(p);
    userRecall(vec4[2](vec4(0.0), vec4(0.0)));  // the reach is known before the contact
    userSides(vec4(0.0), vec4(0.0));
    return min(userReach(UserContact(0.0, 0.0, 0.5 * reduced, 0.0)), p.friction.w);
}
bool holds(ContactParams p, float overlap, float reduced, float memory) {
    if (reaches() && memory > 0.0 && overlap > -reachOf(p, reduced)) return true;
    return overlap > 0.0;
}

#endif
