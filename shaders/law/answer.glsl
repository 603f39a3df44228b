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
};

#endif
