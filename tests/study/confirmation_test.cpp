// What confirming runs say of a target.
#include "host/study/confirmation.h"

#include <cmath>
#include <limits>

#include "tests/support/catch.h"

using namespace vkdose;
using Verdict = Confirmed::Verdict;

TEST_CASE("confirming runs meet a target if their mean is within the tolerance, and known to it") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto verdict = [&](const std::vector<double>& values, double scatter) {
        return confirmedBy(values, 3, {scatter, std::isnan(scatter) ? 0 : 2}, 48, 3).verdict;
    };
    CHECK(verdict({43.1, 43.8, 44.5}, 0.7) == Verdict::Missed);
    CHECK(verdict({45, 46, 47}, 1) == Verdict::Met);
    CHECK(verdict({45, 45, 45}, 0) == Verdict::Met);  // at the edge, and exact
    CHECK(verdict({44.9, 45, 45}, 0) == Verdict::Missed);
    CHECK(verdict({40, 48, 56}, 8) == Verdict::Uncertain);  // 8 over the root of 3 is 4.6, and more with Student
    CHECK(verdict({48, 48, 48}, nan) == Verdict::Uncertain);
    CHECK(verdict({48, 48}, 1) == Verdict::Incomplete);
    CHECK(verdict({}, 1) == Verdict::Incomplete);
    CHECK(verdict({48, 48, nan}, 1) == Verdict::Incomplete);
    const Confirmed c = confirmedBy({43, 44, 45}, 3, {1.5, 2}, 48, 3);
    CHECK(c.found.value == Approx(44));
    CHECK(c.found.error ==
          Approx(4.527 / 2 * 1.5 / std::sqrt(3.0)).epsilon(1e-3));  // Student's t for two degrees at 95.45 %
    CHECK(c.runs == 3);
}

TEST_CASE("a point is confirmed only if every figure is met") {
    const Confirmed met = confirmedBy({1, 1}, 2, {0, 1}, 1, 1), missed = confirmedBy({3, 3}, 2, {0, 1}, 1, 1);
    CHECK(Confirmation{0, {met, met}}.met());
    CHECK_FALSE(Confirmation{0, {met, missed}}.met());
    for (const Verdict v : {Verdict::Met, Verdict::Missed, Verdict::Uncertain, Verdict::Incomplete})
        CHECK_FALSE(verdictText(v).empty());
}

TEST_CASE("new seeds are none of those that were used") {
    CHECK(newSeeds({1, 2, 3}, 3) == std::vector<std::uint64_t>{4, 5, 6});
    CHECK(newSeeds({2, 7}, 3) == std::vector<std::uint64_t>{1, 3, 4});
    CHECK(newSeeds({}, 2) == std::vector<std::uint64_t>{1, 2});
    CHECK(newSeeds({std::numeric_limits<std::uint64_t>::max()}, 1) == std::vector<std::uint64_t>{1});
}
