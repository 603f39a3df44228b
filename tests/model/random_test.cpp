#include "host/core/random.h"
#include "tests/support/catch.h"

using namespace vkdose;

TEST_CASE("random numbers are Philox4x32-10, bit for bit") {
    // Known answer of the algorithm for counter 0, key 0: 6627e8d5 e169c58d bc57ac4c 9b00dbd8.
    const auto [u, v] = uniforms(0, static_cast<Stream>(0), 0, 0);
    CHECK(u == (static_cast<double>(0x6627e8d5e169c58dULL >> 11U) + 0.5) * 0x1p-53);
    CHECK(v == (static_cast<double>(0xbc57ac4c9b00dbd8ULL >> 11U) + 0.5) * 0x1p-53);
    // From an independent implementation: every part of counter and key is used.
    const auto [a, b] = uniforms(7, Stream::Jitter, (1ULL << 33U) + 5, 3);
    CHECK(a == 0.6587225286058129);
    CHECK(b == 0.1361113899734307);
}

TEST_CASE("random numbers stay inside the open interval and fill it evenly") {
    constexpr int kDraws = 20000;
    double sum = 0;
    double squares = 0;
    for (int i = 0; i < kDraws; ++i) {
        const auto [u, v] = uniforms(1, Stream::Radius, static_cast<std::uint64_t>(i));
        REQUIRE((u > 0 && u < 1 && v > 0 && v < 1));
        sum += u + v;
        squares += u * u + v * v;
    }
    // Standard error of the mean of 40000 draws: 0.2887 / 200 = 0.0014; of the mean square 0.298 / 200 = 0.0015.
    CHECK(sum / (2 * kDraws) == Approx(0.5).margin(4 * 0.0014));
    CHECK(squares / (2 * kDraws) == Approx(1.0 / 3).margin(4 * 0.0015));
}
