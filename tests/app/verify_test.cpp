// `vkdose test verify` as a user meets it. Its families of known answers run in tests/device.

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose::test;

TEST_CASE("verify writes what it prints") {
    const Sandbox box;
    const auto outcome = box.vkdose("test verify --backend reference --only integrator/free-fall");
    CHECK(outcome.code == 0);
    CHECK(outcome.out.find("3 of 3 known answers met") != std::string::npos);
    CHECK(readText(box / "out/verify/verify.md").find("3 of 3 known answers met on reference") != std::string::npos);
    const auto json = nlohmann::json::parse(readText(box / "out/verify/verify.json"));
    CHECK(json["results"].size() == 3);
    CHECK(json["results"][0]["case"] == "integrator/free-fall");
}

TEST_CASE("verify lists its cases without a device") {
    const Sandbox box;
    const auto all = box.vkdose("test verify --list", "VK_ICD_FILENAMES=/nowhere ");
    CHECK(all.code == 0);
    CHECK(all.out.find("integrator/free-fall ") != std::string::npos);
    const auto some = box.vkdose("test verify --list --only collisions/head-on-damped");
    CHECK(some.code == 0);
    CHECK(some.out.substr(0, 26) == "collisions/head-on-damped ");
    CHECK(std::count(some.out.begin(), some.out.end(), '\n') == 1);
    CHECK(box.files().empty());
}

TEST_CASE("verify tells an unknown case from a known one") {
    const Sandbox box;
    const auto outcome = box.vkdose("test verify --backend reference --only colisions");
    CHECK(outcome.code == 2);
    CHECK(outcome.err.find("collisions/head-on") != std::string::npos);
    CHECK(box.files().empty());
    CHECK(box.vkdose("test verify --backend reference --device llvmpipe").code == 2);
}
