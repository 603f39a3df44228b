// Rates of discharge by hand.
#include "host/analysis/discharge.h"

#include <cmath>

#include "tests/support/catch.h"

using namespace vkdose;

namespace {

/// Nothing until 0.1 s, then a rate that changes by `change` from the middle of its second on [kg/s].
std::vector<DischargeSample> runsOut(double rate, double change) {
    std::vector<DischargeSample> samples;
    for (int i = 0; i <= 110; ++i) {
        const double t = 0.01 * i;
        samples.push_back({t, rate * std::max(0.0, t - 0.1) + change * std::max(0.0, t - 0.6)});
    }
    return samples;
}

}  // namespace

TEST_CASE("a steady discharge has its rate, and no error") {
    const auto d = dischargeOf(runsOut(0.02, 0), 0.1, 1.1);
    REQUIRE(d);
    CHECK(d->rate == Approx(0.02));
    CHECK(d->error < 1e-9);
    // Before it begins the line would be flatter.
    CHECK(dischargeOf(runsOut(0.02, 0), 0, 1.1)->rate < 0.0199);
}

TEST_CASE("a discharge that changes has the error of its quarters") {
    const auto d = dischargeOf(runsOut(0.02, 0.01), 0.105, 1.095);
    REQUIRE(d);
    CHECK(d->rate == Approx(0.025).epsilon(0.01));
    // Quarters of 0.02, 0.02, 0.03, 0.03 kg/s: a deviation of 0.00577, and half of that.
    CHECK(d->error == Approx(0.00289).epsilon(0.03));
}

TEST_CASE("no discharge where nothing runs out, and from too few lines") {
    CHECK_FALSE(dischargeOf(runsOut(0, 0), 0, 1.1));
    CHECK_FALSE(dischargeOf(runsOut(0.02, 0), 0.5, 0.56));
    CHECK(dischargeOf(runsOut(0.02, 0), 0.495, 0.575));
    CHECK_FALSE(dischargeOf({}, 0, 1));
}

TEST_CASE("Beverloo's constant is that of the rate it was made of") {
    const double rate = 0.58 * 800 * std::sqrt(9.81) * std::pow(12e-3 - 1.5 * 2e-3, 2.5);
    CHECK(beverlooConstant(rate, 800, 9.81, 12e-3, 2e-3) == Approx(0.58));
    CHECK(std::isnan(beverlooConstant(rate, 800, 9.81, 3e-3, 2e-3)));
}
