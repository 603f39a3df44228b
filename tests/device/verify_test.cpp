// The known answers of `vkdose test verify`, family by family on the device.

#include <nlohmann/json.hpp>

#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose::test;

namespace {

/// VKDOSE_TEST_DEVICE chooses the device, as in the other tests that use one.
std::string device() {
    const char* name = std::getenv("VKDOSE_TEST_DEVICE");
    return name == nullptr ? "" : " --device '" + std::string(name) + "'";
}

void requireGreen(const std::string& family) {
    const Sandbox box;
    const auto outcome = box.vkdose("test verify --only " + family + "/ --out found" + device());
    INFO(outcome.out << outcome.err);
    CHECK(outcome.code == 0);
    const auto json = nlohmann::json::parse(readText(box / "found/verify.json"));
    CHECK(json["backend"].get<std::string>().find("vulkan") == 0);
    CHECK(json["checks"] > 0);
    CHECK(json["failures"] == 0);
}

}  // namespace

TEST_CASE("verify on the device: integrator") {
    requireGreen("integrator");
}
TEST_CASE("verify on the device: increments") {
    requireGreen("increments");
}
TEST_CASE("verify on the device: collisions") {
    requireGreen("collisions");
}
TEST_CASE("verify on the device: sliding") {
    requireGreen("sliding");
}
TEST_CASE("verify on the device: rolling") {
    requireGreen("rolling");
}
TEST_CASE("verify on the device: torsion") {
    requireGreen("torsion");
}
TEST_CASE("verify on the device: coil") {
    requireGreen("coil");
}
TEST_CASE("verify on the device: bed") {
    requireGreen("bed");
}
TEST_CASE("verify on the device: momentum") {
    requireGreen("momentum");
}
TEST_CASE("verify on the device: energy") {
    requireGreen("energy");
}
TEST_CASE("verify on the device: size ratio") {
    requireGreen("size-ratio");
}
