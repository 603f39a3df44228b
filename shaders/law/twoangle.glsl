// Sine and cosine of an angle of two floats, and a turn about an axis by such an angle, all good to some 2^-46. `sin`
// and `cos` of the language may be wrong by 2^-11 (Vulkan, appendix "Precision and Operation of SPIR-V Instructions").
#ifndef VKDOSE_LAW_TWOANGLE_GLSL
#define VKDOSE_LAW_TWOANGLE_GLSL

#include "law/twoproduct.glsl"

struct TwoSineCosine {
    vec2 sine, cosine;
};

/// Taylor's series in the square of the angle: x, y: of its sine over itself, high and low part; z, w: of its cosine.
/// The first term left out is 0.617^8/16! = 1e-15, for the square of an eighth of a turn is 0.617.
const uint kTerms = 8u;
const vec4 kSeries[kTerms] = vec4[](vec4(1.0, 0.0, 1.0, 0.0), vec4(-0.166666672, 4.96705388e-09, -0.5, 0.0),
                                    vec4(0.00833333377, -4.34617203e-10, 0.0416666679, -1.24176347e-09),
                                    vec4(-0.000198412701, 2.72559687e-12, -0.00138888892, 3.36310944e-11),
                                    vec4(2.75573188e-06, 3.79357122e-14, 2.48015876e-05, -3.40699609e-13),
                                    vec4(-2.50521079e-08, -4.41762304e-16, -2.755732e-07, 7.57511221e-15),
                                    vec4(1.60590444e-10, -5.35252651e-18, 2.08767559e-09, 1.10828391e-16),
                                    vec4(-7.64716361e-13, -1.22007105e-20, -1.14707454e-11, -2.37220769e-19));

TwoSineCosine sineCosine(vec2 angle) {
    precise float quarters = floor(angle.x * 0.63661977 + 0.5);
    Two3 rest = twoLess(Two3(vec3(angle.x), vec3(angle.y)), vec2(quarters, 0.0),
                        Two3(vec3(1.57079637), vec3(-4.37113883e-8)));  // a quarter of a turn
    Two3 square = twoTimes(rest, rest), sum = Two3(vec3(0.0), vec3(0.0));
    for (uint k = kTerms; k > 0u; --k) {
        Two3 more = twoTimes(sum, square);
        vec4 term = kSeries[k - 1u];
        sum = twoDifference(vec3(term.xz, 0.0), vec3(term.yw, 0.0), -more.high, -more.low);
    }
    sum = twoTimes(sum, Two3(vec3(rest.high.x, 1.0, 0.0), vec3(rest.low.x, 0.0, 0.0)));
    vec2 sine = quickSum(sum.high.x, sum.low.x), cosine = quickSum(sum.high.y, sum.low.y);
    switch (int(quarters) & 3) {
        case 1:
            return TwoSineCosine(cosine, -sine);
        case 2:
            return TwoSineCosine(-sine, -cosine);
        case 3:
            return TwoSineCosine(-cosine, sine);
    }
    return TwoSineCosine(sine, cosine);
}

Two3 twoCross(Two3 a, Two3 b) {
    Two3 p = twoTimes(Two3(a.high.yzx, a.low.yzx), Two3(b.high.zxy, b.low.zxy)),
         q = twoTimes(Two3(a.high.zxy, a.low.zxy), Two3(b.high.yzx, b.low.yzx));
    return twoDifference(p.high, p.low, q.high, q.low);
}

/// `v` turned about the unit vector `axis`.
Two3 twoTurned(Two3 v, Two3 axis, TwoSineCosine by) {
    vec2 share = twoDot(axis, v);
    Two3 along = twoTimes(axis, Two3(vec3(share.x), vec3(share.y)));
    Two3 across = twoDifference(v.high, v.low, along.high, along.low);
    return twoLess(twoLess(along, -by.cosine, across), -by.sine, twoCross(axis, v));
}

#endif
