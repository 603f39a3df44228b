#include "host/analysis/emptying.h"
#include "tests/support/catch.h"

using namespace vkdose;

TEST_CASE("doses to 99 %: the first that reaches it") {
    const std::vector<double> cumulative{0.02, 0.04, 0.0594, 0.06};  // of 60 g: 99 % is 59.4 g
    CHECK(dosesToFraction(cumulative, 0.06, 0.99) == 3);
    CHECK(dosesToFraction(cumulative, 0.06, 0.6) == 2);
    CHECK(dosesToFraction(cumulative, 0.061, 0.99) == std::nullopt);
    CHECK(dosesToFraction({}, 0.06) == std::nullopt);
}

TEST_CASE("both stop rules count their doses on the same series") {
    const std::vector<double> dosed{4e-3, 0.1e-3, 0.04e-3, 0, 0, 0};
    StopRule rule;
    CHECK(dosesToRule(dosed, 0.048, rule) == 4);  // 0.1 + 0.04 + 0 g
    rule.kind = StopRule::Kind::Simulation;
    CHECK(dosesToRule(dosed, 0.048, rule) == 6);
    rule.kind = StopRule::Kind::None;
    CHECK(dosesToRule(dosed, 0.048, rule) == std::nullopt);
}

TEST_CASE("rounding in the difference of sums is no mass, a particle is") {
    StopRule rule;
    rule.kind = StopRule::Kind::Simulation;
    CHECK(dosesToRule(std::vector<double>{4e-3, 1e-9, -1e-9, 0}, 0.048, rule) == 4);
    CHECK(dosesToRule(std::vector<double>{4e-3, 1e-6, 0, 0}, 0.048, rule) == std::nullopt);
}

TEST_CASE("a dose count in the rule does not end the counting") {
    StopRule rule;
    rule.maxDoses = 1;
    CHECK(dosesToRule(std::vector<double>{4e-3, 0, 0, 0}, 0.048, rule) == 4);
}
