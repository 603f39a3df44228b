// Directions that repeat: a place and the place one period farther are the same. Knows no tables.
#ifndef VKDOSE_LAW_PERIOD_GLSL
#define VKDOSE_LAW_PERIOD_GLSL

#include "law/twofloat.glsl"

struct Period {
    vec3 high;  // its length [m]; 0 in directions that do not repeat
    vec3 low;   // the low part
};

/// The periods, -1, 0 or 1 in each direction, that make a way the shortest one.
vec3 periodsFor(vec3 way, Period p) {
    vec3 far = vec3(greaterThan(abs(way), 0.5 * p.high));
    return -far * sign(way);
}

/// A way between two places of the domain, by the shortest image. Of the opposite way it is the opposite to the last
/// bit.
vec3 shortest(vec3 way, Period p) {
    vec3 periods = periodsFor(way, p);
    precise vec3 moved = way + periods * p.high;
    precise vec3 most = moved + periods * p.low;
    return most;
}

/// The image of a place that is nearest to `to`.
Two3 nearestImage(vec3 high, vec3 low, vec3 to, Period p) {
    vec3 periods = periodsFor(high - to, p);
    return twoDifference(high, low, -periods * p.high, -periods * p.low);
}

/// By so much of a period a particle may leave the domain before it is taken back into it, so that rounding moves none
/// to and fro.
const float kBeyondEnd = 1e-6;

// How many periods a particle has gone through since it was loaded, upwards less downwards. At most two directions
// repeat, so that two numbers tell it: that of x, or else of y, and that of z, or else of y.
vec2 keptPeriods(vec3 periods, Period p) {
    return vec2(p.high.x > 0.0 ? periods.x : periods.y, p.high.z > 0.0 ? periods.z : periods.y);
}
/// The way that it has gone so [m].
vec3 wayGone(vec2 kept, Period p) { return p.high * vec3(kept.x, p.high.x > 0.0 ? kept.y : kept.x, kept.y); }

#endif
