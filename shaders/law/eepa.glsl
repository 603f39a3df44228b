// Edinburgh's elasto-plastic adhesive spheres (Morrissey 2013; Thakur et al. 2014). physics.md, "Elasto-plastic
// adhesive spheres". Powers of 3/2 are products with a root. A device's pow sees only ratios of overlaps, near 1, where
// it is good to single precision.
#ifndef VKDOSE_LAW_EEPA_GLSL
#define VKDOSE_LAW_EEPA_GLSL

#include "law/hertz.glsl"

/// The path on which a contact unloads and loads again.
struct EepaPath {
    float unloading;  // k2 [N/m^(3/2)]
    float flattened;  // delta_p^(3/2)
    float pull;       // P [N]
    float pole;       // delta_min^(3/2)
};

float threeHalves(float x) { return x * sqrt(x); }

/// `maxOverlap` > 0 and `reduced` 2 R* [m].
EepaPath eepaPath(ContactParams p, float reduced, float maxOverlap) {
    float share = p.normal.w;
    float unloading = 4.0 / 3.0 * p.normal.x * sqrt(0.5 * reduced) / (1.0 - share);
    float flattened = share * threeHalves(maxOverlap);
    float wide = maxOverlap * pow(share, 2.0 / 3.0);
    float patch2 = wide * max(reduced - wide, 0.0);
    float pull = min(p.normal.z * sqrt(patch2), 0.5 * unloading * flattened);
    return EepaPath(unloading, flattened, pull, flattened - pull / unloading);
}

/// Pull of the adhesive branch at overlap^(3/2) `d`, continued beyond the pole [N].
float eepaPull(ContactParams p, EepaPath path, float d) {
    return path.pull > 0.0 ? path.pull * pow(d / path.pole, p.damping.w) : 0.0;
}

/// All but the normal force are those of Hertz's line at this overlap.
NormalAnswer eepaAnswer(ContactParams p, Meeting m, inout History h) {
    NormalAnswer answer = hertzAnswer(p, m.overlap, m.reduced, m.mass, h.last);
    h.slidingMax.w = max(h.slidingMax.w, m.overlap);
    EepaPath path = eepaPath(p, m.reduced, h.slidingMax.w);
    float d = threeHalves(m.overlap), pull = eepaPull(p, path, d);
    answer.force = p.friction.w + (d < path.pole ? -pull : path.unloading * (d - path.flattened));
    answer.pull = pull - p.friction.w;
    return answer;
}

/// Area under the path from 0 to the overlap [J].
float eepaStored(ContactParams p, float force, float overlap, float reduced, float maxOverlap) {
    EepaPath path = eepaPath(p, reduced, maxOverlap);
    float d = threeHalves(overlap), share = 1.0 / (1.5 * p.damping.w + 1.0);
    if (d < path.pole) return overlap * (p.friction.w - share * eepaPull(p, path, d));
    // Beyond the pole, counted from there: -P, and k2 (x^(3/2) - pole).
    float least = maxOverlap * pow(path.pole / threeHalves(maxOverlap), 2.0 / 3.0), beyond = overlap - least;
    float steep = path.unloading * (0.4 * overlap * (d - path.pole) - 0.6 * path.pole * beyond);
    return overlap * p.friction.w - path.pull * (share * least + beyond) + steep;
}

float eepaReach(ContactParams p, float reduced) { return 0.0; }
float eepaStiffness(ContactParams p, float overlap, float reduced) { return hertzStiffness(p, overlap, reduced); }
float eepaGrowth(ContactParams p, float before, float overlap, float reduced) { return sqrt(overlap / before); }
/// The first touch presses along Hertz's line and f0. A contact that parts takes the path that its stored energy is the
/// area of.
float eepaLost(ContactParams p, NormalStep s, float reduced) {
    precise float area = s.taken;
    if (!s.touched) area = s.overlap * (0.4 * s.force + 0.6 * p.friction.w);
    precise float lost = area - s.gained;
    return s.touches ? lost : 0.0;
}
bool eepaAdheres(ContactParams p, float force, float overlap) { return false; }

#endif
