// What the program sets in the environment of lavapipe.

#include <algorithm>
#include <cstdlib>
#include <string>

#include "host/app/backends.h"
#include "host/vk/driver_variable.h"
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

TEST_CASE("drivers keep no passes while the length of lavapipe's vectors is set") {
    constexpr const char *kNoCache = "MESA_SHADER_CACHE_DISABLE", *kWidth = "LP_NATIVE_VECTOR_WIDTH";
    for (const char* variable : {kNoCache, kWidth})
        if (std::getenv(variable) != nullptr) FAIL("this test needs " << variable << " to be unset");
    const auto kept = [] {
        (void)vk::listDevices();  // loads the drivers
        return std::getenv(kNoCache) == nullptr;
    };
    CHECK(kept());
    setenv(kWidth, "128", 1);
    CHECK_FALSE(kept());
    unsetenv(kWidth);
    CHECK(kept());
}

TEST_CASE("what is set for a driver is not handed on to other processes, and what the user has set is") {
    constexpr const char *kOurs = "VKDOSE_TEST_OURS", *kUsers = "VKDOSE_TEST_USERS";
    const auto handedOn = [](const std::string& variable) {
        const std::vector<std::string> all = vk::usersEnvironment();
        return std::find(all.begin(), all.end(), variable) != all.end();
    };
    setenv(kUsers, "1", 1);
    vk::setForDriver(kOurs, "2", true);
    vk::setForDriver(kUsers, "2", true);
    CHECK(std::getenv(kOurs) == std::string("2"));
    CHECK_FALSE(handedOn("VKDOSE_TEST_OURS=2"));
    CHECK(handedOn("VKDOSE_TEST_USERS=1"));
    vk::setForDriver(kOurs, "2", false);
    vk::setForDriver(kUsers, "2", false);
    CHECK(std::getenv(kOurs) == nullptr);
    CHECK(handedOn("VKDOSE_TEST_USERS=1"));
    unsetenv(kUsers);
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
