// What a law of the normal force says of a contact.
#ifndef VKDOSE_LAW_ANSWER_GLSL
#define VKDOSE_LAW_ANSWER_GLSL

#include "shared/layout.h"

struct NormalAnswer {
    float force;    // along the normal, without damping, repulsive positive [N]
    float damping;  // of the normal direction [kg/s]
    float pull;     // largest adhesive force at this overlap [N]
    vec3 springs;   // of sliding, rolling, torsion [N/m]
    vec3 dampings;  // of sliding, rolling, torsion [kg/s]
    vec3 slipping;  // the same while they slip; 0: then the spring alone bears the limit
    float kept;     // share of their length that the springs keep (springsKept)
};

NormalAnswer noAnswer() { return NormalAnswer(0.0, 0.0, 0.0, vec3(0.0), vec3(0.0), vec3(0.0), 1.0); }

/// Share of their length that the springs of sliding, rolling and torsion keep when the contact's stiffness goes from
/// `was`, 0 of a new contact, to `is` [N/m]. Where it grows they get shorter, so that they exert what they did. Where
/// it falls they keep their length. Neither gives them energy (Thornton, Cummins and Cleary 2013).
float springsKept(float was, float is) { return was > 0.0 ? min(1.0, was / is) : 1.0; }

#endif
