// The laws of the normal force. Which of them occur is known when a pipeline is made, so that the others cost nothing.
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
    if (follows(p, kLawJkr)) return jkrReach(p, reduced);
    return 0.0;
}

/// Whether there is a contact at this overlap. `memory` is what the law left of the last step, 0 if there was none.
bool holds(ContactParams p, float overlap, float reduced, float memory) {
    if (reaches() && memory > 0.0 && overlap > -reachOf(p, reduced)) return true;
    return overlap > 0.0;
}

/// `overlap` > 0, or above -reachOf where the contact goes on, and `reduced` 2 a_i a_j / (a_i + a_j) (wall: 2 a_i) [m];
/// `mass` the reduced mass [kg]. `memory` is the contact's history of one number [m], above 0 while there is a contact.
/// `last` is the overlap of the last step, which only EEPA needs beside the memory.
NormalAnswer normalAnswer(ContactParams p, float overlap, float reduced, float mass, inout float memory,
                          inout float last) {
    if (follows(p, kLawHertzMindlin)) return hertzAnswer(p, overlap, reduced, mass, memory);
    if (follows(p, kLawEepa)) return eepaAnswer(p, overlap, reduced, mass, memory, last);
    if (follows(p, kLawJkr)) return jkrAnswer(p, overlap, reduced, mass, memory);
    return ludingAnswer(p, overlap, reduced, memory);
}

/// Energy that the normal direction gives back when the contact parts slowly [J]; `force` is the answer's [N]. Under
/// EEPA and JKR the work of the pull counts too, so that it may be negative.
float storedEnergy(ContactParams p, float force, float overlap, float reduced, float memory) {
    if (follows(p, kLawHertzMindlin)) return 0.4 * force * overlap;
    if (follows(p, kLawEepa)) return eepaEnergy(p, overlap, reduced, memory);
    if (follows(p, kLawJkr)) return jkrEnergy(p, overlap, reduced);
    return 0.5 * (force * force / unloadingStiffness(p, reduced, memory));
}

/// Whether the overlap makes sliding, rolling and torsion stiffer.
bool stiffens(ContactParams p) { return follows(p, kLawHertzMindlin) || follows(p, kLawEepa) || follows(p, kLawJkr); }

/// Stiffness of sliding, rolling, torsion [N/m].
vec3 springsAt(ContactParams p, float overlap, float reduced) {
    if (follows(p, kLawJkr)) return jkrStiffness(p, overlap, reduced) * p.springs.xyz;
    if (stiffens(p)) return hertzStiffness(p, overlap, reduced) * p.springs.xyz;
    return p.springs.xyz;
}

/// Whether the law itself loses energy. What an elastic law loses is an error of the time step.
bool losesEnergy(ContactParams p) { return !follows(p, kLawHertzMindlin); }

/// Work that pressing a new contact to `overlap` takes, where it exerts `force` [J].
float workOfFirstTouch(ContactParams p, float force, float overlap) {
    if (follows(p, kLawEepa)) return eepaFirstWork(p, force, overlap);
    return 0.5 * force * overlap;
}

/// What a contact loses by law when it parts after it exerted `force` and stored `stored` [J].
float lossOfParting(ContactParams p, float force, float overlap, float stored) {
    if (follows(p, kLawEepa)) return 0.0;  // what it stored is the area of the path on which it parts
    return -0.5 * force * overlap + stored;
}

/// Whether what the law loses is adhesion's: on the adhesive branch of Luding's law, and always under JKR.
bool onAdhesiveBranch(ContactParams p, float force, float overlap) {
    if (follows(p, kLawJkr)) return true;
    return follows(p, kLawLuding) && force < 0.0 && force <= -p.normal.z * overlap;
}

#endif
