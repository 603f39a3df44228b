// Closest points on the wire of a coil (geometry/coil.h): local minima of the distance from a point to a helical wire.
//
// In cylindrical coordinates (rho, theta, z) of the point, with u = phase of the wire - theta, the distance is
// stationary where  u + eps sin u = M,  eps = rho r_c kappa^2,  M = u at the point's own z. Around every u = 2 pi k
// lies at most one minimum; with v = u - 2 pi k, m = M - 2 pi k, Newton from v0 = m/(1 + eps) converges without ever
// passing the root, because the left side is concave for v > 0 (and odd). A sphere smaller than r_c cannot touch the
// wire further than `reach.x` from its own angle, where the slope is still positive: six steps are plenty, and a
// failure is reported.
//
// The distance is formed in the polar frame, g^2 + 4 rho r_c sin^2(v/2) + dz^2. So neither a large angle nor the sine
// of the device (Vulkan promises only 2^-11) affects the overlap.
#ifndef VKDOSE_LAW_COIL_GLSL
#define VKDOSE_LAW_COIL_GLSL

#include "law/surface.glsl"
#include "shared/geometry.h"

const float kTwoPi = 6.28318530717958648;

struct CoilTouch {
    float depth;      // overlap [m]; <= 0: not touching
    vec3 normal;      // unit, from the wire to the sphere's centre
    float wireAngle;  // hand 2 pi s / pitch: identifies the turn [rad]
    bool failed;      // Newton did not converge
};

// The formatter is off, so that each series stays readable line by line.
// clang-format off
/// sin and cos of half an angle |v| <= pi, by their series (errors below 1e-9).
vec2 halfSinCos(float v) {
    float h = 0.5 * v, q = h * h;
    float s = h * (1.0 + q * (-1.0 / 6.0 + q * (1.0 / 120.0 + q * (-1.0 / 5040.0 + q * (1.0 / 362880.0
              + q * (-1.0 / 39916800.0 + q / 6227020800.0))))));
    float c = 1.0 + q * (-1.0 / 2.0 + q * (1.0 / 24.0 + q * (-1.0 / 720.0 + q * (1.0 / 40320.0
              + q * (-1.0 / 3628800.0 + q * (1.0 / 479001600.0 - q / 87178291200.0))))));
    return vec2(s, c);
}

/// Polar angle of (x, y) in (-pi, pi], to a few units in the last place of pi on every device.
float polarAngle(float x, float y) {
    float ax = abs(x), ay = abs(y);
    float t = min(ax, ay) / max(max(ax, ay), 1e-30);
    bool wide = t > 0.41421356;
    float r = wide ? (t - 1.0) / (t + 1.0) : t;
    float q = r * r;
    float a = r * (1.0 + q * (-1.0 / 3.0 + q * (1.0 / 5.0 + q * (-1.0 / 7.0 + q * (1.0 / 9.0 + q * (-1.0 / 11.0
              + q * (1.0 / 13.0 + q * (-1.0 / 15.0 + q / 17.0))))))));
    if (wide) a += 0.785398163397448310;
    if (ay > ax) a = 1.57079632679489662 - a;
    if (x < 0.0) a = 3.14159265358979324 - a;
    return y < 0.0 ? -a : a;
}
// clang-format on

float fold(float angle) { return angle - kTwoPi * floor(angle / kTwoPi + 0.5); }

/// The quantities that all candidates of one sphere share.
struct CoilView {
    float rho;        // distance from the axis [m]
    float off;        // rho - r_c, accurate [m]
    vec2 outward;     // unit
    float z;          // from the wire's start, along the axis [m]
    float start;      // u at the wire's start, folded [rad]
    float phase;      // M folded into (-pi, pi] [rad]
    float wirePhase;  // kappa z [rad]
    float reach;      // sphere + wire radius [m]
};

/// `turn`: the angle of the wire's start about +z, in turns, [-0.5, 0.5).
CoilView coilView(CoilParams c, float turn, Sphere a) {
    CoilView w;
    Two3 d = Two3(vec3(a.high.xy, 0.0), vec3(a.low.xy, 0.0));
    w.rho = length(a.high.xy);
    w.off = -differenceOfSquares(c.radius.xy, d) / (c.radius.x + w.rho);
    w.outward = w.rho > 0.0 ? a.high.xy / w.rho : vec2(1.0, 0.0);
    precise float z = (a.high.z - c.reach.z) + (a.low.z - c.reach.w);
    w.z = z;
    w.reach = a.radius + c.radius.z;

    float hand = c.pitch.w > 0.0 ? 1.0 : -1.0;
    float turns = floor(z / c.pitch.x + 0.5);
    precise float rest = (z - turns * c.pitch.y) - turns * c.pitch.z;  // exact products: 16 bits x a small integer
    float theta = polarAngle(a.high.x, a.high.y);
    w.start = fold(kTwoPi * turn - theta);
    w.phase = fold(kTwoPi * (turn + hand * rest / c.pitch.x) - theta);
    w.wirePhase = c.pitch.w * z;
    return w;
}

/// Whether the sphere comes closer than `slack` to the wire, or may: with the wire's next turn off by the angle m at
/// the sphere's own z, a wire point at the angle v is at least  off^2 + A v^2 + ((m - v) / kappa)^2  away (squared),
/// with A = 4 rho r_c / pi^2 for sin(v/2) >= v/pi; that is least where v makes it  off^2 + m^2 A / (1 + A kappa^2).
bool nearCoil(CoilParams c, float turn, Sphere a, float slack) {
    CoilView w = coilView(c, turn, a);
    float reach = w.reach + slack + 1e-7;
    float A = 0.405284735 * w.rho * c.radius.x;
    float least = w.off * w.off + w.phase * w.phase * A / (1.0 + A * c.pitch.w * c.pitch.w);
    return least < reach * reach && w.z > -reach && w.z < c.radius.w + reach;
}

/// How many windows hold a minimum that a sphere can touch.
uint coilWindows(CoilParams c) { return 2u * uint(c.reach.y) + 1u; }

/// The minimum in window k = `window` - K, of 2K + 1.
CoilTouch coilCandidate(CoilParams c, CoilView w, uint window) {
    float kappa = c.pitch.w, rc = c.radius.x;
    float eps = w.rho * rc * kappa * kappa;
    float m = w.phase - kTwoPi * float(int(window) - int(c.reach.y));
    float limit = c.reach.x;
    float v = m / (1.0 + eps), step = 1.0;
    for (int i = 0; i < 8 && abs(v) < limit; ++i) {
        vec2 h = halfSinCos(v);
        step = (v + eps * (2.0 * h.x * h.y) - m) / (1.0 + eps * (1.0 - 2.0 * h.x * h.x));
        v -= step;  // quadratic: after a step of 1e-4 what is left is below a float's rounding
        if (i == 7 || abs(step) <= 1e-4) break;  // at the end: shaders/README.md, Drivers
    }
    float dz = (m - v) / kappa, s = w.z - dz, wireAngle = w.wirePhase + (v - m);
    bool valid = abs(v) < limit, failed = valid && abs(step) > 1e-4;
    // The distance grows from the minimum both ways. Where the wire ends before it, the end is the closest point, if it
    // is in this window.
    bool before = s < 0.0;
    bool behind = s > c.radius.w;
    if (before || behind) {
        s = before ? 0.0 : c.radius.w;
        v = before ? w.start : fold(w.phase + kappa * (s - w.z));
        dz = w.z - s;
        wireAngle = kappa * s;
        valid = abs(m - kappa * dz) < 0.5 * kTwoPi;
        failed = false;
    }
    vec2 h = halfSinCos(v);
    float distance = sqrt(w.off * w.off + 4.0 * w.rho * rc * h.x * h.x + dz * dz);
    // Components in the point's polar frame: the wire point sits at angle v from it.
    float radial = w.off + 2.0 * rc * h.x * h.x;
    float tangential = -rc * (2.0 * h.x * h.y);
    vec3 normal = vec3(w.outward * radial + vec2(-w.outward.y, w.outward.x) * tangential, dz) / distance;
    return CoilTouch(valid ? w.reach - distance : -1.0, normal, wireAngle, failed);
}

#endif
