#pragma once
// The comparators of all tests. A difference is always measured in units of a physical scale that the caller names
// (the radius for an overlap, the weight for a force), never against a bare number in SI. NaN and infinity on any
// side fail.

#include <cmath>
#include <cstddef>
#include <ostream>
#include <sstream>
#include <string>

#include "host/core/vec.h"

namespace vkdose::test {

/// Outcome of a comparison; CHECK(near(...)) prints the numbers when it fails.
struct Verdict {
    bool holds = false;
    std::string text;
    explicit operator bool() const { return holds; }
};

inline std::ostream& operator<<(std::ostream& out, const Verdict& verdict) {
    return out << verdict.text;
}

/// |actual - expected| <= tolerance * scale, all of them finite and the scale positive.
inline Verdict near(double actual, double expected, double scale, double tolerance) {
    const double error = std::abs(actual - expected) / scale;
    const bool meaningful = std::isfinite(actual) && std::isfinite(expected) && std::isfinite(scale) && scale > 0 &&
                            std::isfinite(tolerance) && tolerance >= 0;
    std::ostringstream text;
    text.precision(12);
    text << actual << " against " << expected << ": off by " << error << " of the scale " << scale << ", allowed "
         << tolerance;
    return {meaningful && error <= tolerance, text.str()};
}

/// |actual - expected| <= tolerance * scale with the length of the difference.
inline Verdict near(const Vec3& actual, const Vec3& expected, double scale, double tolerance) {
    const double error = glm::length(actual - expected);  // NaN if any component is
    Verdict verdict = near(error, 0, scale, tolerance);
    std::ostringstream text;
    text.precision(12);
    text << "(" << actual.x << ", " << actual.y << ", " << actual.z << ") against (" << expected.x << ", " << expected.y
         << ", " << expected.z << "): " << verdict.text;
    return {verdict.holds, text.str()};
}

/// Like `near` with the expected value as the scale: for quantities that cannot be zero.
inline Verdict nearRelative(double actual, double expected, double tolerance) {
    return near(actual, expected, std::abs(expected), tolerance);
}

}  // namespace vkdose::test
