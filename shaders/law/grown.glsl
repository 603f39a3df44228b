// Sums that grow by many small steps and have but one float. Rounded to nearest, a step that is always the same is
// always rounded the same way, and one below half of the last place is lost. So a number between -1/2 and 1/2 of the
// last place is added before the sum is rounded. It is another one in each step, so that a step which is a tenth of the
// last place is rounded up in every tenth step. The numbers are the fractional parts of the multiples of the golden
// ratio, which are the most even ones (Knuth, TAOCP 3, 6.4). So the errors of n equal steps do not add up to n halves
// of the last place or to the root of n of them, but to its logarithm. A sum whose step is 0 stays what it is.
#ifndef VKDOSE_LAW_GROWN_GLSL
#define VKDOSE_LAW_GROWN_GLSL

/// What is added, as a share of the binade; a pass sets it to that of the step at work.
float dither = 0.0;

/// That of the step with this number: less than half of the last place by a little more than rounding.
float ditherOf(uint step) { return float(int(step * 2654435769u) >> 8) * (0.9999 / 16777216.0 / 8388608.0); }

/// The sum of two numbers of which the second is the smaller one by far.
vec4 grown(vec4 sum, vec4 step) {
    vec4 binade = uintBitsToFloat(floatBitsToUint(sum) & 0x7f800000u);
    precise vec4 more = step + dither * binade;
    precise vec4 now = sum + more;
    return now;
}
vec3 grown(vec3 sum, vec3 step) {
    vec3 binade = uintBitsToFloat(floatBitsToUint(sum) & 0x7f800000u);
    precise vec3 more = step + dither * binade;
    precise vec3 now = sum + more;
    return now;
}
float grown(float sum, float step) {
    float binade = uintBitsToFloat(floatBitsToUint(sum) & 0x7f800000u);
    precise float more = step + dither * binade;
    precise float now = sum + more;
    return now;
}

#endif
