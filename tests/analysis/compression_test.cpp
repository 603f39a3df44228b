// Uniaxial compression, on laws whose work and recovery are known.
#include "host/analysis/compression.h"

#include <cmath>

#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr double kMass = 2e-3, kArea = 3e-4;
constexpr double kLoose = 20e-3, kPressed = 16e-3;   // gaps: where the powder begins to press, and the smallest [m]
constexpr double kLoading = 5e3, kUnloading = 20e3;  // springs [N/m]

/// Force of a bed that loads on one spring and unloads on a stiffer one.
double force(double gap, bool loading) {
    const double most = kLoading * (kLoose - kPressed);
    return loading ? kLoading * std::max(0.0, kLoose - gap) : std::max(0.0, most - kUnloading * (gap - kPressed));
}

std::vector<PistonSample> pressing(int lines) {
    std::vector<PistonSample> samples{{25e-3, 0}};
    const double down = (25e-3 - kPressed) / lines;
    for (int i = 1; i <= lines; ++i) {
        const double gap = 25e-3 - down * i;
        samples.push_back({gap, force(gap + down / 2, true)});
    }
    for (int i = 1; i <= lines; ++i) {
        const double gap = kPressed + down * i;
        samples.push_back({gap, force(gap - down / 2, false)});
    }
    return samples;
}

}  // namespace

TEST_CASE("a bed of two springs: stress, densities, work and recovery in closed form") {
    const auto c = compressionOf(pressing(900), kMass, kArea);
    REQUIRE(c);
    const double most = kLoading * (kLoose - kPressed), way = kLoose - kPressed, back = most / kUnloading;
    // A line is a 900th of 9 mm: 0.25 % of the way of the loading, 1 % of that of the unloading.
    CHECK(nearRelative(c->maxStress, most / kArea, 0.002));
    CHECK(nearRelative(c->loadedDensity, kMass / (kArea * kPressed), 1e-12));
    CHECK(nearRelative(c->work, 0.5 * most * way, 1e-4));
    CHECK(nearRelative(c->returned, 0.5 * most * back, 1e-3));
    // 1 % of the largest stress lies 1 % of the spring's way before its end.
    CHECK(nearRelative(c->looseDensity, kMass / (kArea * (kLoose - 0.01 * way)), 1e-4));
    CHECK(nearRelative(c->recovery, 0.99 * back / kPressed, 0.003));
    CHECK(nearRelative(c->releasedDensity, kMass / (kArea * (kPressed + 0.99 * back)), 1e-4));
}

TEST_CASE("a bed that is not let go has no recovery, one that is never touched no figure") {
    std::vector<PistonSample> held = pressing(900);
    held.resize(901);
    const auto c = compressionOf(held, kMass, kArea);
    REQUIRE(c);
    CHECK(std::isnan(c->recovery));
    CHECK(std::isnan(c->releasedDensity));
    CHECK(c->returned == 0);
    CHECK(c->work > 0);
    CHECK_FALSE(compressionOf({{1, 0}, {0.9, 0}, {0.8, 0}}, kMass, kArea));
    CHECK_FALSE(compressionOf({{1, 0}, {0.9, 1}}, kMass, kArea));
}
