// Arithmetic on unevaluated sums of two floats (high + low). Overlaps under gravity are half a micrometre while
// positions are centimetres and radii millimetres: a plain float difference of distances is wrong by 1e-10 m, which at
// the limit stiffness is a force of a particle's own weight in the smallest spheres. Sources: Dekker (1971), Numer.
// Math. 18:224; Knuth, TAOCP 2, 4.2.2. `precise` keeps the compiler from "simplifying" the error terms away; no fused
// multiply-add is assumed, because Vulkan does not promise one.
#ifndef VKDOSE_LAW_TWOFLOAT_GLSL
#define VKDOSE_LAW_TWOFLOAT_GLSL

struct Two3 {
    vec3 high;
    vec3 low;
};

/// a + b and its rounding error.
vec2 twoSum(float a, float b) {
    precise float s = a + b;
    precise float t = s - a;
    precise float e = (a - (s - t)) + (b - t);
    return vec2(s, e);
}

/// (aHigh + aLow) - (bHigh + bLow), renormalised.
Two3 twoDifference(vec3 aHigh, vec3 aLow, vec3 bHigh, vec3 bLow) {
    precise vec3 s = aHigh - bHigh;
    precise vec3 t = s - aHigh;
    precise vec3 e = ((aHigh - (s - t)) - (bHigh + t)) + (aLow - bLow);
    precise vec3 high = s + e;
    precise vec3 low = e - (high - s);
    return Two3(high, low);
}

/// (high + low) + step, renormalised. What is lost is at most 2^-48 of `high` and 2^-23 of `step`: the latter where
/// `step` is the larger one, for then three operations do not give the whole error of the sum, but that much of it.
Two3 twoGrown(vec3 high, vec3 low, vec3 step) {
    precise vec3 more = step + low;
    precise vec3 sum = high + more;
    precise vec3 rest = more - (sum - high);
    return Two3(sum, rest);
}

/// (high + low)^2 as (rounded square, error). Splitting at 12 bits makes the partial products exact.
vec2 twoSquare(float high, float low) {
    precise float p = high * high;
    precise float a = uintBitsToFloat(floatBitsToUint(high) & 0xfffff000u);
    precise float b = high - a;
    precise float e = ((a * a - p) + 2.0 * a * b) + b * b;
    precise float f = e + 2.0 * high * low;
    return vec2(p, f);
}

/// s^2 - |d|^2 with a relative error near one float's, however closely the two agree.
float differenceOfSquares(vec2 s, Two3 d) {
    vec2 ss = twoSquare(s.x, s.y);
    vec2 x = twoSquare(d.high.x, d.low.x);
    vec2 y = twoSquare(d.high.y, d.low.y);
    vec2 z = twoSquare(d.high.z, d.low.z);
    vec2 a = twoSum(ss.x, -x.x);
    vec2 b = twoSum(a.x, -y.x);
    vec2 c = twoSum(b.x, -z.x);
    precise float low = (((ss.y - x.y) - y.y) - z.y) + ((a.y + b.y) + c.y);
    precise float r = c.x + low;
    return r;
}

#endif
