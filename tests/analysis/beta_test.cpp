#include "host/analysis/beta.h"

#include <cmath>

#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using vkdose::test::nearRelative;

namespace {

constexpr double kRounding = 1e-12;  // of the value: a dozen additions in double precision

std::vector<double> grams(std::vector<double> masses) {
    for (double& m : masses) m *= 1e-3;
    return masses;
}

}  // namespace

TEST_CASE("equal doses: beta is the dose, whatever came out before the first") {
    const Slope s = betaOf(grams({1.2, 4.9, 8.6, 12.3}));  // 3.7 g each on top of 1.2 g
    CHECK(s.doses == 4);
    CHECK(nearRelative(s.beta, 3.7e-3, kRounding));
    CHECK(s.standardError < 1e-12 * s.beta);
}

TEST_CASE("beta and its error by hand") {
    // Points (1, 4), (2, 9), (3, 15), (4, 18): sum (n - 2.5) M = -6 - 4.5 + 7.5 + 27 = 24, over 5: 4.8 g/dose.
    // As a mean of the doses 5, 6, 3 with weights 0.3, 0.4, 0.3: 1.5 + 2.4 + 0.9 = 4.8. Their sample variance is
    // (1/9 + 16/9 + 25/9) / 2 = 7/3, the sum of squared weights 0.34.
    Window window;
    window.cumulativeBelow = 0.02;
    const Slope s = betaOf(grams({4, 9, 15, 18}), window);
    CHECK(s.doses == 4);
    CHECK(nearRelative(s.beta, 4.8e-3, kRounding));
    CHECK(nearRelative(s.standardError, std::sqrt(7.0 / 3 * 0.34) * 1e-3, kRounding));
}

TEST_CASE("the error of beta is what scatter of independent doses makes it") {
    // Doses of +1 or -1 g about 4 g, all 2^4 series of four: the variance of beta over the series is exactly
    // sum c_j^2 g^2, and the mean of the squared standard errors is the same, because s^2 is unbiased.
    double variance = 0, claimed = 0;
    Window window;
    window.cumulativeBelow = 100;
    for (int series = 0; series < 16; ++series) {
        std::vector<double> cumulative{0};
        for (int j = 0; j < 4; ++j) cumulative.push_back(cumulative.back() + (series >> j & 1 ? 5 : 3));
        const Slope s = betaOf(cumulative, window);
        variance += (s.beta - 4) * (s.beta - 4) / 16;
        claimed += s.standardError * s.standardError / 16;
    }
    CHECK(nearRelative(claimed, variance, 1e-12));
}

TEST_CASE("the window ends below its bound, at its last dose, and begins at its first") {
    const std::vector<double> cumulative = grams({4, 8, 12, 15, 16, 17});
    CHECK(betaOf(cumulative).doses == 3);  // less than 15 g, and 15 is not less
    Window window;
    window.cumulativeBelow = 1;
    window.from = 3;
    window.to = 5;
    const Slope s = betaOf(cumulative, window);
    CHECK(s.doses == 3);
    CHECK(nearRelative(s.beta, 2e-3, kRounding));  // (12, 15, 16): (16 - 12) / 2
    CHECK(nearRelative(beforeSaturation(0.08).cumulativeBelow, 0.064, kRounding));
}

TEST_CASE("too few doses give no slope, and say so") {
    CHECK(betaOf({}).doses == 0);
    const Slope one = betaOf(grams({12, 24}));  // two coils: the paper's own window holds a single point
    CHECK(one.doses == 1);
    CHECK(std::isnan(one.beta));
    const Slope two = betaOf(grams({4, 9}));
    CHECK(nearRelative(two.beta, 5e-3, kRounding));
    CHECK(std::isnan(two.standardError));
    Window late;
    late.from = 5;
    CHECK(betaOf(grams({4, 9}), late).doses == 0);
}

TEST_CASE("only complete doses count") {
    std::vector<Dose> doses(3);
    for (int i = 0; i < 3; ++i) {
        doses[i].cumulative = 0.004 * (i + 1);
        doses[i].complete = i < 2;
    }
    CHECK(cumulativeMasses(doses) == std::vector<double>{0.004, 0.008});
}

TEST_CASE("mean and standard error over seeds by hand") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Estimate e = estimateOf(std::vector<double>{3, nan, 5, 4});
    CHECK(e.count == 3);
    CHECK(nearRelative(e.mean, 4, kRounding));
    CHECK(nearRelative(e.standardError, 1 / std::sqrt(3.0), kRounding));
    CHECK(std::isnan(estimateOf(std::vector<double>{3}).standardError));
    CHECK(std::isnan(estimateOf({}).mean));
}
