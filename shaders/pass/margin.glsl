// The contacts that the lists hold: all that can touch while every particle and body keeps within their slack.
#ifndef VKDOSE_PASS_MARGIN_GLSL
#define VKDOSE_PASS_MARGIN_GLSL

#include "law/reach.glsl"
#include "law/surface.glsl"
#include "pass/slack.glsl"

float slackOfParticle(uint i) { return slackOf(readState(source, kVelocity, i).xyz); }

/// Symmetric to the last bit, and `precise`, so that both particles of a pair decide the same.
/// The factor and `roundingAt` cover the rounding.
bool nearPair(vec4 p, float slackP, vec4 q, float slackQ) {
    precise vec3 d = p.xyz - q.xyz;
    if (PERIODS == 1u) d = shortest(d, period());
    precise float reach = 1.00001 * (p.w + q.w) + (slackP + slackQ);
    reach += roundingAt(p.xyz) + roundingAt(q.xyz);
    if (reaches()) reach += longestReach();
    precise float apart = preciseDot(d, d), most = reach * reach;
    return q.w > 0.0 && apart < most;
}

// The kind is known when the pipeline is made, so that all but one branch of surfaceGap fold away, and the parameters
// are read outside any branch. One line per surface, because drivers differ in which loops they unroll.
#define PROBE(s) \
    if (s < SURFACES) near |= surfaceGap((KINDS >> (4u * s)) & 15u, member.surface[s], a) < reach ? 1u << s : 0u;

/// Surfaces, a bit each.
uint nearSurfaces(Sphere a, float slack) {
    float reach = slack + (1e-7 + 2.0 * roundingAt(a.high));  // surfaceGap rounds some more
    if (reaches()) reach += longestReach();
    uint near = 0u;
    PROBE(0u)
    PROBE(1u)
    PROBE(2u)
    PROBE(3u)
    PROBE(4u)
    PROBE(5u)
    PROBE(6u)
    PROBE(7u)
    for (uint s = kUnrolledSurfaces; s < SURFACES; ++s) {
        SurfaceParams p = member.surface[s];
        if (surfaceGap(uint(p.pointHigh.w), p, a) < reach) near |= 1u << s;
    }
    return a.radius > 0.0 ? near : 0u;
}

#endif
