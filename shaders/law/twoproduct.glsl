// Products of unevaluated sums of two floats, beside the sums of law/twofloat.glsl. Source: Dekker (1971), Numer. Math.
// 18:224. A product of two floats and its rounding error are exact; those of sums of two are good to some 2^-46.
#ifndef VKDOSE_LAW_TWOPRODUCT_GLSL
#define VKDOSE_LAW_TWOPRODUCT_GLSL

#include "law/twofloat.glsl"

/// The sum of a number and a much smaller one.
vec2 quickSum(float high, float low) {
    precise float s = high + low;
    precise float e = low - (s - high);
    return vec2(s, e);
}

/// a b of each component, and its rounding error. Splitting at 12 bits makes the partial products exact.
Two3 twoProduct(vec3 a, vec3 b) {
    vec3 aTop = uintBitsToFloat(floatBitsToUint(a) & 0xfffff000u),
         bTop = uintBitsToFloat(floatBitsToUint(b) & 0xfffff000u);
    precise vec3 p = a * b;
    precise vec3 aRest = a - aTop;
    precise vec3 bRest = b - bTop;
    precise vec3 e = ((aTop * bTop - p) + aTop * bRest + aRest * bTop) + aRest * bRest;
    return Two3(p, e);
}

/// a b of each component.
Two3 twoTimes(Two3 a, Two3 b) {
    Two3 p = twoProduct(a.high, b.high);
    precise vec3 low = p.low + (a.high * b.low + a.low * b.high);
    return Two3(p.high, low);
}

vec2 twoDot(Two3 a, Two3 b) {
    Two3 p = twoTimes(a, b);
    vec2 s = twoSum(p.high.x, p.high.y);
    vec2 t = twoSum(s.x, p.high.z);
    precise float low = ((p.low.x + p.low.y) + p.low.z) + (s.y + t.y);
    return quickSum(t.x, low);
}

vec2 twoAdd(vec2 a, vec2 b) {
    vec2 s = twoSum(a.x, b.x);
    precise float low = s.y + (a.y + b.y);
    return quickSum(s.x, low);
}

/// a - s b
Two3 twoLess(Two3 a, vec2 s, Two3 b) {
    Two3 p = twoTimes(Two3(vec3(s.x), vec3(s.y)), b);
    return twoDifference(a.high, a.low, p.high, p.low);
}

/// |a|, of a vector.
vec2 twoLength(Two3 a) {
    float rough = length(a.high);
    return rough > 0.0 ? quickSum(rough, -differenceOfSquares(vec2(rough, 0.0), a) / (2.0 * rough)) : vec2(0.0);
}

#endif
