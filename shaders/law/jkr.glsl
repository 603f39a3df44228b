// Elastic adhesive spheres (Johnson, Kendall and Roberts 1971). physics.md, "Elastic adhesive spheres".
//
// With b the root of the contact radius and c its value where the contact is lost, R* overlap = b^4 - 4 c^3 b. The
// difference t = b - c solves t^2 (6 c^2 + 4 c t + t^2) = R* (overlap + reach), whose sides are sums of positive terms:
// single precision is enough also where the contact is about to be lost. Without adhesion c = 0, which is Hertz's law.
#ifndef VKDOSE_LAW_JKR_GLSL
#define VKDOSE_LAW_JKR_GLSL

#include "law/answer.glsl"
#include "law/meeting.glsl"

/// A device's pow is exact to some digits only; a turn of Newton's rule adds the others.
float cubeRoot(float x) {
    float root = pow(x, 1.0 / 3.0);
    return root - (root - x / (root * root)) / 3.0;
}

float cube(float x) { return x * x * x; }

/// c of a contact [m^(1/2)]; `reduced` is 2 R* [m].
float jkrLast(ContactParams p, float reduced) { return p.normal.z * cubeRoot(0.5 * reduced); }

/// How far beyond touch the contact holds [m].
float jkrReach(ContactParams p, float reduced) {
    float c = jkrLast(p, reduced), square = c * c;
    return 3.0 * square * square / (0.5 * reduced);
}

/// A contact at some overlap.
struct JkrPatch {
    float radius;  // of the contact [m]
    float ratio;   // c/b, 1 where the contact is lost, 0 without adhesion
    float depth;   // radius^2/R* [m]
    float room;    // overlap + reach [m]
};

/// `room` > 0, or 0 where the contact is lost.
JkrPatch jkrPatchAt(ContactParams p, float room, float reduced) {
    float c = jkrLast(p, reduced), square = c * c, size = 0.5 * reduced, right = size * room;
    // Without the middle term the root is too large by a fourth at most; from there the rule comes down to it.
    float t = sqrt(right / (3.0 * square + sqrt(9.0 * square * square + right)));
    for (uint turn = 0u; turn < 4u; ++turn) {
        float miss = t * t * (6.0 * square + t * (4.0 * c + t)) - right;
        t -= t > 0.0 ? miss / (t * (12.0 * square + t * (12.0 * c + 4.0 * t))) : 0.0;
    }
    float b = c + t;
    return JkrPatch(b * b, c / b, b * b * (b * b / size), room);
}

JkrPatch jkrPatch(ContactParams p, float overlap, float reduced) {
    float c = jkrLast(p, reduced), square = c * c;
    return jkrPatchAt(p, max(0.0, overlap + 3.0 * square * square / (0.5 * reduced)), reduced);
}

/// Stiffness that the other directions and the damping are ratios to: 2 E* a [N/m].
float jkrStiffness(ContactParams p, float overlap, float reduced) {
    return 2.0 * p.normal.x * jkrPatch(p, overlap, reduced).radius;
}

/// The memory is how much the overlap is above the one at which the contact is lost [m].
NormalAnswer jkrAnswer(ContactParams p, Meeting m, inout History h) {
    JkrPatch at = jkrPatch(p, m.overlap, m.reduced);
    float memory = h.slidingMax.w;
    float was = memory > 0.0 ? 2.0 * p.normal.x * jkrPatchAt(p, memory, m.reduced).radius : 0.0;
    h.slidingMax.w = max(at.room, 1e-30);  // above 0 while there is a contact
    float stiffness = 2.0 * p.normal.x * at.radius, damping = p.normal.y * sqrt(stiffness * m.mass);
    float c = jkrLast(p, m.reduced), square = c * c;
    float pull = 24.0 * p.normal.x * square * (square * square / (0.5 * m.reduced));  // 2 Fc
    return NormalAnswer(2.0 * stiffness * at.depth * (1.0 / 3.0 - 2.0 * cube(at.ratio)), damping, pull,
                        stiffness * p.springs.xyz, damping * p.damping.xyz, vec3(0.0), springsKept(was, stiffness));
}

/// Area under the path from where the contact is lost to the overlap [J].
float jkrStored(ContactParams p, float force, float overlap, float reduced, float memory) {
    JkrPatch at = jkrPatch(p, overlap, reduced);
    float x = cube(at.ratio);
    float area = 1.0 / 30.0 - x * (1.0 / 3.0 - 0.5 * x) - 0.2 * x * x * x * at.ratio;
    return 16.0 * p.normal.x * at.radius * at.depth * at.depth * area;
}

float jkrGrowth(ContactParams p, float before, float overlap, float reduced) {
    float was = jkrStiffness(p, before, reduced), is = jkrStiffness(p, overlap, reduced);
    return is / was;
}

/// The spheres lose as they snap into contact, and nowhere else: the energy at touch, which comes from no motion.
float jkrLost(ContactParams p, NormalStep s, float reduced) {
    if (s.touched) return 0.0;
    float c = jkrLast(p, reduced), square = c * c, depth = square * square / (0.5 * reduced);
    return 16.0 * 2.1048813 * p.normal.x * square * depth * depth;  // 0.3 * 4^(4/3) + 1/5
}

bool jkrAdheres(ContactParams p, float force, float overlap) { return true; }

#endif
