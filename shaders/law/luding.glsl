// Linear hysteretic adhesive law (Luding 2008, Granular Matter 10:235, eqs. 4-7), force without damping.
#ifndef VKDOSE_LAW_LUDING_GLSL
#define VKDOSE_LAW_LUDING_GLSL

#include "law/answer.glsl"
#include "law/meeting.glsl"

/// `overlap` delta > 0 [m], `reduced` = 2 a_i a_j / (a_i + a_j) [m] (wall: 2 a_i). `maxOverlap` is the history
/// delta_max: raised while loading, pulled back on the adhesive branch. Returns f [N], repulsive positive.
float normalForce(ContactParams p, float overlap, float reduced, inout float maxOverlap) {
    float k1 = p.normal.x, k2Max = p.normal.y, kc = p.normal.z;
    float range = k2Max - k1;
    maxOverlap = range > 0.0 ? max(maxOverlap, overlap) : overlap;
    if (range <= 0.0) return k1 * overlap;  // one stiffness: an elastic spring, nothing to remember

    float limit = k2Max / range * p.normal.w * reduced;  // delta*: the plastic limit
    float effective = min(maxOverlap, limit);
    float k2 = k1 + range * min(1.0, maxOverlap / limit);
    float unloading = k2 * (overlap - effective) + k1 * effective;  // = k2 (delta - delta_0), without cancellation
    // Up to the limit overlap = delta_max on this line and f = k1 delta; past it the line goes on at slope k2Max.
    float f = overlap <= limit ? min(unloading, k1 * overlap) : unloading;
    if (f <= -kc * overlap) {
        f = -kc * overlap;
        // delta_max shrinks until the adhesive branch and the unloading line meet at this overlap.
        if (k2 > k1) maxOverlap = overlap * (k2 + kc) / (k2 - k1);
    }
    return f;
}

NormalAnswer ludingAnswer(ContactParams p, Meeting m, inout History h) {
    float f = normalForce(p, m.overlap, m.reduced, h.slidingMax.w);
    return NormalAnswer(f, p.damping.w, p.normal.z * m.overlap, p.springs.xyz, p.damping.xyz, p.damping.xyz, 1.0);
}

/// Slope of the line on which a contact with this history unloads [N/m].
float unloadingStiffness(ContactParams p, float reduced, float maxOverlap) {
    float k1 = p.normal.x, range = p.normal.y - k1;
    if (range <= 0.0) return k1;
    return k1 + range * min(1.0, maxOverlap * range / (p.normal.y * p.normal.w * reduced));
}

float ludingReach(ContactParams p, float reduced) { return 0.0; }
float ludingStored(ContactParams p, float force, float overlap, float reduced, float memory) {
    return 0.5 * (force * force / unloadingStiffness(p, reduced, memory));
}
float ludingStiffness(ContactParams p, float overlap, float reduced) { return 1.0; }  // the springs have their own
float ludingGrowth(ContactParams p, float before, float overlap, float reduced) { return 1.0; }
float ludingLost(ContactParams p, NormalStep s, float reduced) {
    precise float area = s.taken;
    if (!s.touched) area = 0.5 * s.force * s.overlap;
    if (!s.touches) area = -0.5 * s.forceBefore * s.overlapBefore;
    precise float lost = area - s.gained;
    return lost;
}
/// On the adhesive branch.
bool ludingAdheres(ContactParams p, float force, float overlap) {
    return force < 0.0 && force <= -p.normal.z * overlap;
}

#endif
