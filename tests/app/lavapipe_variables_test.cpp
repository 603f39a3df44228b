// What the program sets in the environment of lavapipe.

#include <cstdlib>
#include <string>

#include "host/app/backends.h"
#include "tests/support/catch.h"

using namespace vkdose;

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
