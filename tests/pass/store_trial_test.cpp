// The trial by which passes store plainly or packed.
#include "host/backend/vulkan/store_trial.h"

#include <cmath>

#include "tests/support/catch.h"

using namespace vkdose;

TEST_CASE("store trial: both ways store the same vectors, and are timed") {
    const vk::Device device(vk::DeviceChoice{});
    if (!device.hasInt64()) {
        CHECK_FALSE(storesFasterPacked(device));
        return;
    }
    const StoreTrial trial = tryStores(device);
    for (const StoreTrial::Way* way : {&trial.plain, &trial.packed}) {
        CHECK(way->seconds > 0);
        CHECK(std::isfinite(way->seconds));
        REQUIRE(way->stored.size() == 2 * 64 * 64);
        for (std::size_t n = 0; n < way->stored.size(); ++n) {
            const float i = float(n / 2), more = n % 2 == 0 ? 0.0F : 1.0F;
            const gpu::vec4 v = way->stored[n];
            if (v != gpu::vec4(i + more, 0.5F * i + more, 0.25F * i + more, 0.125F * i + more)) FAIL("vector " << n);
        }
    }
    CHECK(storesFasterPacked(device) == storesFasterPacked(device));
}
