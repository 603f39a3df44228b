#include "host/study/seed_scatter.h"

#include <cmath>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "tests/support/catch.h"

using namespace vkdose;

TEST_CASE("the error of a mean is wider, the less is known of its scatter") {
    // Student's t at 95.45 %, from tables, over 2.
    const std::vector<std::pair<int, double>> table{{1, 13.968}, {2, 4.527}, {3, 3.307}, {10, 2.284}, {100, 2.026}};
    for (const auto& [freedom, t] : table)
        CHECK(SeedScatter{3.0, freedom}.errorOfMean(9) == Approx(t / 2).epsilon(1e-3));
    // Two errors hold the truth in 95 of 100 cases, however few values there are.
    std::mt19937 random(3);
    std::normal_distribution<double> noise;
    for (const int count : {2, 3, 5}) {
        int within = 0;
        for (int i = 0; i < 4000; ++i) {
            std::vector<double> values;
            for (int k = 0; k < count; ++k) values.push_back(noise(random));
            const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
            within += std::abs(mean) <= 2 * scatterOfSeeds({values}).errorOfMean(count) ? 1 : 0;
        }
        CAPTURE(count);
        CHECK(std::abs(within / 4000.0 - 0.9545) < 0.012);  // 3.6 deviations
    }
}
