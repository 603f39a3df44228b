// The comparators must fail when they should: every other test leans on them.

#include "tests/support/near.h"

#include <limits>

#include "tests/support/catch.h"

using vkdose::Vec3;
using vkdose::test::near;
using vkdose::test::nearRelative;

namespace {
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
}  // namespace

TEST_CASE("near accepts a difference within the tolerance and refuses one beyond it") {
    CHECK(near(1.0, 1.0, 1.0, 0.0));
    CHECK(near(1.0009, 1.0, 1.0, 1e-3));
    CHECK_FALSE(near(1.0011, 1.0, 1.0, 1e-3));
    CHECK_FALSE(near(-1.0, 1.0, 1.0, 1e-3));
}

TEST_CASE("near measures in units of the scale, however small the numbers") {
    CHECK(near(1.0009e-9, 1e-9, 1e-9, 1e-3));
    CHECK_FALSE(near(1e-9, 2e-9, 1e-9, 1e-3));  // one nanonewton would pass any absolute floor
    CHECK(near(1e-9, 2e-9, 1e-3, 1e-3));
}

TEST_CASE("near refuses NaN and infinity everywhere") {
    CHECK_FALSE(near(kNan, 1.0, 1.0, 1.0));
    CHECK_FALSE(near(1.0, kNan, 1.0, 1.0));
    CHECK_FALSE(near(kNan, kNan, 1.0, 1.0));
    CHECK_FALSE(near(kInf, kInf, 1.0, 1.0));
    CHECK_FALSE(near(kInf, 1.0, 1.0, kInf));
    CHECK_FALSE(near(1.0, 1.0, kInf, 1.0));
    CHECK_FALSE(near(1.0, 2.0, kNan, 1.0));
    CHECK_FALSE(near(1.0, 1.0, 1.0, kNan));
}

TEST_CASE("near refuses a scale that measures nothing and a negative tolerance") {
    CHECK_FALSE(near(1.0, 1.0, 0.0, 1.0));
    CHECK_FALSE(near(1.0, 1.0, -1.0, 1.0));
    CHECK_FALSE(near(1.0, 1.0, 1.0, -1e-9));
    CHECK_FALSE(nearRelative(0.0, 0.0, 1.0));
}

TEST_CASE("near compares vectors by the length of the difference") {
    CHECK(near(Vec3(1, 2, 3), Vec3(1, 2, 3.001), 1.0, 2e-3));
    CHECK_FALSE(near(Vec3(1, 2, 3), Vec3(1, 2, 3.003), 1.0, 2e-3));
    CHECK_FALSE(near(Vec3(1, 2, 3), Vec3(-1, 2, 3), 1.0, 2e-3));
    CHECK_FALSE(near(Vec3(1, kNan, 3), Vec3(1, 2, 3), 1.0, 1e9));
    CHECK_FALSE(near(Vec3(1, 2, 3), Vec3(1, 2, kNan), 1.0, 1e9));
    CHECK_FALSE(near(Vec3(kInf, 2, 3), Vec3(kInf, 2, 3), 1.0, 1e9));
}

TEST_CASE("nearRelative takes the expected value as the scale") {
    CHECK(nearRelative(1.0009e-6, 1e-6, 1e-3));
    CHECK_FALSE(nearRelative(1.0011e-6, 1e-6, 1e-3));
    CHECK_FALSE(nearRelative(-1e-6, 1e-6, 1e-3));
    CHECK_FALSE(nearRelative(kNan, 1e-6, 1.0));
}

TEST_CASE("a failed comparison says what was compared") {
    const auto verdict = near(2.0, 1.0, 1.0, 0.5);
    CHECK(verdict.text.find("2 against 1") != std::string::npos);
}
