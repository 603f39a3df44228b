#include "host/play/backend_choice.h"

#include "host/core/error.h"
#include "tests/support/catch.h"

using namespace vkdose;

TEST_CASE("backends have names, and what makes no sense is refused") {
    CHECK(openBackend({"reference", "", false})->description() == "reference");
    CHECK_THROWS_AS(openBackend({"reference", "0", false}), UsageError);
    CHECK_THROWS_AS(openBackend({"cuda", "", false}), UsageError);
    CHECK_THROWS_AS(openEnsemble({"reference", "", false}), UsageError);
    CHECK_THROWS_AS(openBackend({"vulkan", "no such device", false}), DeviceError);
}
