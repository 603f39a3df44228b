// Places on the blade of a screw (geometry/flight.h): local minima of the distance to its sections.
//
// Every half plane through the axis cuts the blade in a rectangle. Let v be the blade angle less that of the half plane
// of the centre, within half a turn. Seen along the section's own half plane the centre lies `off` beyond the
// rectangle's ends and rho sin v aside, and `beyond` above or below it. The squared distance D = off^2 + (rho sin
// v)^2 + beyond^2 has the half derivative (rho cos v - off) rho sin v - beyond h'. A sphere of radius R < 0.7 m, m =
// max(rho, inner radius), reaches sections only at |v| < asin(R/m) < pi/4. The derivative rises there all the way, if
// the pitch changes slowly, so that bisection finds the one minimum of each turn. For larger spheres the derivative is
// followed in steps around the whole turn.
//
// What the vectors of the shape's record hold:
//
//   2: inner radius, low part, outer radius, low part   3: half the thickness, curvature, hand, 1 if simple
//   4: where its turns begin, how many; length of the blade in turns: whole ones, part of one
//   5: angle of its start [turns], first pitch, change of the pitch per turn, height from end to end
//   6: z of its start, largest slope [m/rad]
//   turn   z of the blade's middle after whole turns, low part, slope there [m per turn]; the first is that after -1
//
// The curvature is half the change of the pitch per turn. `simple` is 1 if the pitch changes slowly.
#ifndef VKDOSE_LAW_FLIGHT_GLSL
#define VKDOSE_LAW_FLIGHT_GLSL

#include "law/coil.glsl"
#include "law/places.glsl"
#include "law/twoproduct.glsl"

const uint kHalvings = 28u;
const float kRoundSteps = 64.0;  // around a turn, for spheres as large as the shaft

struct Blade {
    vec4 radii, form;
    uvec4 turns;
    vec4 line, place;
};

Blade bladeOf(uint shape) {
    return Blade(uintBitsToFloat(geometryAt(shape + 2u)), uintBitsToFloat(geometryAt(shape + 3u)),
                 geometryAt(shape + 4u), uintBitsToFloat(geometryAt(shape + 5u)),
                 uintBitsToFloat(geometryAt(shape + 6u)));
}

/// The blade from a centre.
struct BladeView {
    float rho, pastInner, pastOuter;  // from the axis, and less each radius [m]
    vec2 outward;                     // unit
    vec2 z;                           // two floats
    float turn;                       // angle of the centre from the blade's start, whole turns dropped [turns]
    ivec2 turns;                      // first and last whole turn with sections in reach
};

BladeView bladeView(Blade b, Two3 centre, float reach) {
    BladeView w;
    Two3 d = Two3(vec3(centre.high.xy, 0.0), vec3(centre.low.xy, 0.0));
    w.rho = length(centre.high.xy);
    w.pastInner = -differenceOfSquares(b.radii.xy, d) / (b.radii.x + w.rho);
    w.pastOuter = -differenceOfSquares(b.radii.zw, d) / (b.radii.z + w.rho);
    w.outward = w.rho > 0.0 ? centre.high.xy / w.rho : vec2(1.0, 0.0);
    w.z = vec2(centre.high.z, centre.low.z);
    w.turn = b.form.z * (polarAngle(centre.high.x, centre.high.y) / kTwoPi - b.line.x);
    w.turn -= floor(w.turn + 0.5);
    // Turns at which the middle of the blade is as high as the lowest and the highest point in reach.
    float up = centre.high.z - b.place.x, span = reach + b.form.x, height = b.line.w;
    vec2 ends = clamp(vec2(up - span, up + span), 0.0, height);
    ends = 2.0 * ends / (b.line.y + sqrt(b.line.y * b.line.y + 2.0 * b.line.z * ends));
    w.turns = ivec2(ceil(ends.x - w.turn - 0.501), floor(ends.y - w.turn + 0.501));
    w.turns = clamp(w.turns, ivec2(-1), ivec2(int(b.turns.y) - 2));
    bool outside = w.pastOuter >= reach || w.pastInner <= -reach || up <= -span || up >= height + span;
    if (outside) w.turns = ivec2(0, -1);
    return w;
}

vec4 turnOf(Blade b, int turn) { return uintBitsToFloat(geometryAt(b.turns.x + uint(turn + 1))); }

/// The section at v as the centre sees it.
struct BladeSection {
    vec2 halfAngle;  // sine and cosine of v/2
    float off, aside, above, beyond;
    float slope;  // of the blade [m/rad]
    float rise;   // half the derivative of the squared distance [m2]
};

BladeSection bladeSection(Blade b, BladeView w, vec4 turn, float v) {
    BladeSection s;
    s.halfAngle = halfSinCos(v);
    float less = 2.0 * w.rho * s.halfAngle.x * s.halfAngle.x, inner = w.pastInner - less;
    s.off = inner < 0.0 ? inner : max(w.pastOuter - less, 0.0);
    s.aside = 2.0 * w.rho * s.halfAngle.x * s.halfAngle.y;
    float part = w.turn + v / kTwoPi;
    precise float up = (w.z.x - turn.x) + (w.z.y - turn.y);
    s.above = up - part * (turn.z + part * b.form.y);
    s.beyond = s.above - clamp(s.above, -b.form.x, b.form.x);
    s.slope = (turn.z + 2.0 * part * b.form.y) / kTwoPi;
    s.rise = (w.rho - less - s.off) * s.aside - s.beyond * s.slope;
    return s;
}

/// A direction in the frame of the body.
vec3 bladeDirection(BladeView w, float radial, float around, float up) {
    return vec3(w.outward * radial + vec2(-w.outward.y, w.outward.x) * around, up);
}

/// Out of the nearer face, for a centre on the blade or in it.
Overlap wayOutOfBlade(Blade b, BladeView w, BladeSection s, float radius) {
    vec3 n = bladeDirection(w, 0.0, -b.form.z * s.slope, w.rho) / length(vec2(s.slope, w.rho));
    return Overlap(radius + (b.form.x - abs(s.above)) * n.z, s.above < 0.0 ? -n : n);
}

Overlap bladeOverlap(Blade b, BladeView w, BladeSection s, float radius) {
    float away = length(vec3(s.off, s.aside, s.beyond));
    if (away == 0.0) return wayOutOfBlade(b, w, s, radius);
    float sine = 2.0 * s.halfAngle.x * s.halfAngle.y, cosine = 1.0 - 2.0 * s.halfAngle.x * s.halfAngle.x;
    vec3 n = bladeDirection(w, s.off * cosine + s.aside * sine, b.form.z * (s.off * sine - s.aside * cosine), s.beyond);
    return Overlap(radius - away, n / away);
}

void addBladePlace(Overlap o, uint tag, float turns) {
    if (o.depth > 0.0) addPlace(o.depth, o.normal, tag + uint(floor(turns + 0.5)), kFlat);
}

/// Adds the place if the centre lies in the blade: then it is the only one.
bool addPlaceInBlade(Blade b, BladeView w, uint tag, float radius) {
    bool inside = false;
    if (w.pastInner <= 0.0 || w.pastOuter >= 0.0) return inside;
    for (int k = w.turns.x; k <= w.turns.y && !inside; ++k) {
        BladeSection s = bladeSection(b, w, turnOf(b, k), 0.0);
        float start = float(k) + w.turn, rest = float(int(b.turns.z) - k) + (uintBitsToFloat(b.turns.w) - w.turn);
        inside = abs(s.above) < b.form.x && start >= 0.0 && rest >= 0.0;
        if (inside) addBladePlace(wayOutOfBlade(b, w, s, radius), tag, start);
    }
    return inside;
}

/// Adds the places of one turn.
void addTurnPlaces(Blade b, BladeView w, int k, uint tag, float radius) {
    vec4 turn = turnOf(b, k);
    float middle = float(k) + w.turn, m = max(w.rho, b.radii.x);
    bool simple = b.form.w != 0.0 && radius <= b.radii.x && radius < 0.7 * m;
    float wide = simple ? 1.12 * radius / m : 0.5 * kTwoPi;  // asin x < 1.12 x up to 0.7
    float start = -kTwoPi * middle, end = kTwoPi * (float(int(b.turns.z) - k) + (uintBitsToFloat(b.turns.w) - w.turn));
    float low = max(-wide, start), high = min(wide, end);
    if (low > high) return;
    float steps = simple ? 1.0 : kRoundSteps;
    BladeSection s = bladeSection(b, w, turn, low);
    if (s.rise >= 0.0 && low == start) addBladePlace(bladeOverlap(b, w, s, radius), tag, middle + low / kTwoPi);
    float last = low, before = s.rise;
    for (float n = 1.0; n <= steps; n += 1.0) {
        float next = n == steps ? high : low + (high - low) * (n / steps);
        float rise = bladeSection(b, w, turn, next).rise;
        if (before < 0.0 && rise >= 0.0) {
            float left = last, right = next;
            for (uint h = 0u; h < kHalvings && right - left > 1e-8; ++h) {
                float v = 0.5 * (left + right);
                bool falls = bladeSection(b, w, turn, v).rise < 0.0;
                left = falls ? v : left;
                right = falls ? right : v;
            }
            float v = 0.5 * (left + right);
            addBladePlace(bladeOverlap(b, w, bladeSection(b, w, turn, v), radius), tag, middle + v / kTwoPi);
        }
        last = next;
        before = rise;
    }
    if (before < 0.0 && high == end)
        addBladePlace(bladeOverlap(b, w, bladeSection(b, w, turn, high), radius), tag, middle + high / kTwoPi);
}

/// Adds the places of the blade to the list.
void flightPlaces(uint shape, uint tag, Two3 centre, float radius) {
    Blade b = bladeOf(shape);
    BladeView w = bladeView(b, centre, radius);
    if (addPlaceInBlade(b, w, tag, radius)) return;
    int k = w.turns.x;
    for (; k <= w.turns.y; ++k) addTurnPlaces(b, w, k, tag, radius);
    if (k <= w.turns.y) placesLost = true;
}

/// Whether the blade may come within `reach` of the centre. Never wrongly false. With its middle off by m at the
/// centre's own half plane, and the largest slope s, a section at v is at least (2 rho v/pi)^2 + (m - s v)^2 away
/// (squared), as long as |v| < pi/2; farther round it is farther than rho.
bool mayTouchFlight(uint shape, Two3 centre, float reach) {
    Blade b = bladeOf(shape);
    BladeView w = bladeView(b, centre, reach);
    float across = 0.405 * w.rho * w.rho, share = across / (across + b.place.y * b.place.y);
    bool near = w.rho <= reach && w.turns.x <= w.turns.y;
    int k = w.turns.x;
    for (; k <= w.turns.y && !near; ++k) {
        vec4 turn = turnOf(b, k);
        float m = abs(bladeSection(b, w, turn, 0.0).above) - b.form.x;
        near = m <= 0.0 || m * m * share < reach * reach;
    }
    return near || k <= w.turns.y;
}

#endif
