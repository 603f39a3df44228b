// What the program sets in the environment of lavapipe.

#include <cstdlib>
#include <string>

#include "host/app/backends.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// What a variable is once a backend for so many particles was opened.
std::string set(const char* variable, std::size_t particles) {
    makeBackend({"reference", "", false}, particles);
    const char* value = std::getenv(variable);
    return value == nullptr ? "" : value;
}

}  // namespace

TEST_CASE("lavapipe gets short vectors for a bed that it cannot bind, on a processor with AVX-512") {
    constexpr const char* kWidth = "LP_NATIVE_VECTOR_WIDTH";
    if (std::getenv(kWidth) != nullptr) FAIL("this test needs " << kWidth << " to be unset");
    CHECK(set(kWidth, 1'000'000).empty());
#ifdef __x86_64__
    CHECK(set(kWidth, 2'000'000) == (__builtin_cpu_supports("avx512f") != 0 ? "128" : ""));
#endif
    CHECK(set(kWidth, 3000).empty());
}

TEST_CASE("lavapipe keeps no passes of short vectors") {
    constexpr const char* kNoCache = "MESA_SHADER_CACHE_DISABLE";
    if (std::getenv(kNoCache) != nullptr) FAIL("this test needs " << kNoCache << " to be unset");
    CHECK(set(kNoCache, 3000).empty());
#ifdef __x86_64__
    CHECK(set(kNoCache, 2'000'000) == (__builtin_cpu_supports("avx512f") != 0 ? "true" : ""));
#endif
    CHECK(set(kNoCache, 3000).empty());
}

TEST_CASE("passes that lavapipe has kept for vectors of one length are not taken for another") {
    const Sandbox box;
    const std::string kept = "MESA_SHADER_CACHE_DIR=kept ", run = "run " VKDOSE_SOURCE_DIR "/cases/mini.toml --quiet ";
    // The energy book makes other passes of the same parts, some of which are kept by then.
    const std::string brief = "--set stop.end_time_s=0.002 ", booked = brief + "--set sensors.energy=true ";
    REQUIRE(box.vkdose(run + brief + "--out before", kept).code == 0);
    REQUIRE(box.vkdose(run + booked + "--out plain", "MESA_SHADER_CACHE_DIR=other ").code == 0);
    const auto o = box.vkdose(run + booked + "--out short", kept + "LP_NATIVE_VECTOR_WIDTH=128 ");
    CAPTURE(o.err);
    REQUIRE(o.code == 0);
    CHECK(readText(box / "short/particles.csv") == readText(box / "plain/particles.csv"));
}
