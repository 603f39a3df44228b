// The laws of the normal force, each a file that answers the same questions (shared/laws.h lists them). Which of them
// occur is known when a pipeline is made, so that the others cost nothing.
#ifndef VKDOSE_LAW_NORMAL_GLSL
#define VKDOSE_LAW_NORMAL_GLSL

#include "law/eepa.glsl"
#include "law/hertz.glsl"
#include "law/jkr.glsl"
#include "law/luding.glsl"
#include "law/reach.glsl"

bool follows(ContactParams p, uint law) {
    uint bit = 1u << law;
    return (LAWS & bit) != 0u && (LAWS == bit || uint(p.springs.w) % kLawKinds == law);
}

/// How far beyond touch a contact that has come about holds on [m]; grows with `reduced`.
float reachOf(ContactParams p, float reduced) {
#define LAW(number, Name, name, reaches, stiffens, keepsOverlap) \
    if (reaches == 1 && follows(p, uint(number))) return name##Reach(p, reduced);
#include "shared/laws.h"
    return 0.0;
}

/// Whether there is a contact at this overlap. `memory` is what the law left of the last step, 0 if there was none.
bool holds(ContactParams p, float overlap, float reduced, float memory) {
    if (reaches() && memory > 0.0 && overlap > -reachOf(p, reduced)) return true;
    return overlap > 0.0;
}

/// The overlap of `m` is positive, or above -reachOf where the contact goes on. `h.slidingMax.w` is the law's memory of
/// one number [m], above 0 while there is a contact. `speed` is that of approach; only a user's law asks for it.
NormalAnswer normalAnswer(ContactParams p, Meeting m, float speed, inout History h) {
#define LAW(number, Name, name, reaches, stiffens, keepsOverlap) \
    if (follows(p, uint(number))) return name##Answer(p, m, h);
#include "shared/laws.h"
    return noAnswer();
}

/// Energy that the normal direction gives back when the contact parts slowly [J]; `force` is the answer's [N]. The work
/// of a pull may count too, so that it may be negative.
float storedEnergy(ContactParams p, float force, float overlap, float reduced, History h) {
#define LAW(number, Name, name, reaches, stiffens, keepsOverlap) \
    if (follows(p, uint(number))) return name##Stored(p, force, overlap, reduced, h.slidingMax.w);
#include "shared/laws.h"
    return 0.0;
}

/// Whether the overlap makes sliding, rolling and torsion stiffer.
bool stiffens(ContactParams p) {
#define LAW(number, Name, name, reaches, stiffens, keepsOverlap) \
    if (stiffens == 1 && follows(p, uint(number))) return true;
#include "shared/laws.h"
    return false;
}

/// Stiffness of sliding, rolling, torsion [N/m].
vec3 springsAt(ContactParams p, float overlap, float reduced, History h) {
#define LAW(number, Name, name, reaches, stiffens, keepsOverlap) \
    if (stiffens == 1 && follows(p, uint(number))) return name##Stiffness(p, overlap, reduced) * p.springs.xyz;
#include "shared/laws.h"
    return p.springs.xyz;
}

/// By which factor that stiffness has grown since the overlap `before`, of a contact that goes on.
float stiffnessGrowth(ContactParams p, float before, float overlap, float reduced) {
#define LAW(number, Name, name, reaches, stiffens, keepsOverlap) \
    if (follows(p, uint(number))) return name##Growth(p, before, overlap, reduced);
#include "shared/laws.h"
    return 1.0;
}

/// Energy that the law itself loses in a step [J]. What an elastic law loses is an error of the time step, and no loss.
float lostByLaw(ContactParams p, NormalStep s, float reduced) {
#define LAW(number, Name, name, reaches, stiffens, keepsOverlap) \
    if (follows(p, uint(number))) return name##Lost(p, s, reduced);
#include "shared/laws.h"
    return 0.0;
}

/// Whether what the law loses is adhesion's.
bool adheres(ContactParams p, float force, float overlap) {
#define LAW(number, Name, name, reaches, stiffens, keepsOverlap) \
    if (follows(p, uint(number))) return name##Adheres(p, force, overlap);
#include "shared/laws.h"
    return false;
}

#endif
