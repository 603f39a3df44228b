#include "host/model/size_distribution.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/catch.h"

using namespace vkdose;
using Kind = SizeDistribution::Kind;

namespace {

constexpr std::size_t kDraws = 40000;

struct Sample {
    std::vector<double> radii;
    std::uint64_t redrawn = 0;

    explicit Sample(const SizeDistribution& size, std::uint64_t seed = 11) {
        for (std::size_t i = 0; i < kDraws; ++i) radii.push_back(drawRadius(size, seed, i, redrawn));
    }
    double moment(int power) const {
        double sum = 0;
        for (const double r : radii) sum += std::pow(r, power);
        return sum / static_cast<double>(kDraws);
    }
    /// Fraction of the sample's volume in spheres smaller than r.
    double finer(double r) const {
        double below = 0;
        double all = 0;
        for (const double a : radii) {
            all += a * a * a;
            if (a < r) below += a * a * a;
        }
        return below / all;
    }
};

SizeDistribution uniform() {
    SizeDistribution size;
    size.kind = Kind::Uniform;
    size.radiusMin = 0.625e-3;
    size.radiusMax = 1.875e-3;
    return size;
}

}  // namespace

TEST_CASE("uniform radii: the same draws everywhere") {
    // 0.625 mm + u 1.25 mm with u from an independent Philox: seed 1, indices 0 to 3.
    const double expected[] = {0.0007152544151517957, 0.0007070236946053546, 0.0009240962467709293,
                               0.0017300677808827418};
    std::uint64_t redrawn = 0;
    for (std::uint64_t i = 0; i < 4; ++i)
        CHECK(drawRadius(uniform(), 1, i, redrawn) == Approx(expected[i]).epsilon(1e-15));
    CHECK(redrawn == 0);
}

TEST_CASE("uniform radii: moments") {
    const Sample sample(uniform());
    // Relative standard errors: 0.29 / 200 of the mean, 0.75 / 200 of the mean cube.
    CHECK(sample.moment(1) == Approx(1.25e-3).epsilon(4 * 0.29 / 200));
    CHECK(meanRadius(uniform()) == Approx(1.25e-3));
    CHECK(meanCubedRadius(uniform()) == Approx(10 * std::pow(0.625e-3, 3)));  // (3^4 - 1)/(4 * 2) = 10
    CHECK(sample.moment(3) == Approx(meanCubedRadius(uniform())).epsilon(4 * 0.75 / 200));
}

TEST_CASE("fixed radius") {
    SizeDistribution size;
    size.radius = 1e-3;
    const Sample sample(size);
    CHECK(*std::min_element(sample.radii.begin(), sample.radii.end()) == 1e-3);
    CHECK(*std::max_element(sample.radii.begin(), sample.radii.end()) == 1e-3);
}

TEST_CASE("normal radii: moments and truncation") {
    SizeDistribution size;
    size.kind = Kind::Normal;
    size.radius = 1e-3;
    size.deviation = 0.1e-3;
    size.radiusMin = 0.8e-3;
    size.radiusMax = 1.2e-3;
    const Sample sample(size);
    CHECK(*std::min_element(sample.radii.begin(), sample.radii.end()) >= 0.8e-3);
    CHECK(*std::max_element(sample.radii.begin(), sample.radii.end()) <= 1.2e-3);
    CHECK(sample.moment(1) == Approx(1e-3).epsilon(4 * 0.1 / 200));
    // A normal cut at two deviations keeps 95.45 % and 0.8796 of its deviation.
    const double deviation = std::sqrt(sample.moment(2) - std::pow(sample.moment(1), 2));
    CHECK(deviation == Approx(0.8796 * 0.1e-3).epsilon(0.015));
    CHECK(acceptance(size) == Approx(0.9545).epsilon(1e-4));
    // 40000 / 0.9545 - 40000 = 1907 draws in vain, with a deviation of about 45.
    CHECK(static_cast<double>(sample.redrawn) == Approx(1907).margin(4 * 45));
}

TEST_CASE("lognormal radii: median and spread") {
    SizeDistribution size;
    size.kind = Kind::Lognormal;
    size.radius = 1e-3;
    size.deviation = 0.3;
    size.radiusMin = 1e-5;
    size.radiusMax = 1e-1;
    Sample sample(size);
    CHECK(sample.redrawn == 0);
    CHECK(sample.moment(1) == Approx(meanRadius(size)).epsilon(4 * 0.31 / 200));
    CHECK(meanRadius(size) == Approx(1e-3 * std::exp(0.045)));
    CHECK(sample.moment(3) == Approx(meanCubedRadius(size)).epsilon(4 * 1.1 / 200));
    std::nth_element(sample.radii.begin(), sample.radii.begin() + kDraws / 2, sample.radii.end());
    CHECK(sample.radii[kDraws / 2] == Approx(1e-3).epsilon(4 * 1.25 * 0.3 / 200));
}

TEST_CASE("quantiles: the drawn volume has the quantiles of the powder") {
    SizeDistribution size;
    size.kind = Kind::Quantiles;
    size.r10 = 0.6e-3;
    size.r50 = 1.0e-3;
    size.r90 = 1.5e-3;
    size.radiusMin = finestRadius(size);
    size.radiusMax = coarsestRadius(size);
    CHECK(finerVolume(size, size.r10) == Approx(0.1));
    CHECK(finerVolume(size, size.r50) == Approx(0.5));
    CHECK(finerVolume(size, size.r90) == Approx(0.9));
    CHECK(finerVolume(size, size.radiusMin) == Approx(0).margin(1e-12));
    CHECK(finerVolume(size, size.radiusMax) == Approx(1));
    const Sample sample(size);
    // A volume fraction of a sample of spheres of unequal volume: error about 0.5 * 1.5 / 200.
    CHECK(sample.finer(size.r10) == Approx(0.1).margin(0.015));
    CHECK(sample.finer(size.r50) == Approx(0.5).margin(0.015));
    CHECK(sample.finer(size.r90) == Approx(0.9).margin(0.015));
    CHECK(sample.moment(1) == Approx(meanRadius(size)).epsilon(0.01));
    CHECK(sample.moment(3) == Approx(meanCubedRadius(size)).epsilon(0.03));
}

TEST_CASE("quantiles: truncation keeps the shape in between") {
    SizeDistribution size;  // the cocoa of the paper, scaled up by 13.6: a span of 1:31 that no bed can hold whole
    size.kind = Kind::Quantiles;
    size.scaleUp = 13.6;
    size.r10 = 0.5 * 31.55e-6 * 13.6;
    size.r50 = 0.5 * 184e-6 * 13.6;
    size.r90 = 0.5 * 979.19e-6 * 13.6;
    size.radiusMin = 0.6e-3;
    size.radiusMax = 2.4e-3;
    const Sample sample(size);
    CHECK(*std::min_element(sample.radii.begin(), sample.radii.end()) >= size.radiusMin);
    CHECK(*std::max_element(sample.radii.begin(), sample.radii.end()) <= size.radiusMax);
    const double low = finerVolume(size, size.radiusMin);
    const double high = finerVolume(size, size.radiusMax);
    for (const double r : {0.8e-3, 1.25e-3, 1.8e-3})
        CHECK(sample.finer(r) == Approx((finerVolume(size, r) - low) / (high - low)).margin(0.02));
}
