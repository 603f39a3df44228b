// Whole runs of the program on the device, beside the reference.

#include <nlohmann/json.hpp>

#include "tests/app/sandbox.h"
#include "tests/support/catch.h"
#include "tests/support/places.h"

using namespace vkdose::test;

namespace {

const std::string kMini = "'" + sourceDir() + "/cases/mini.toml' ";

/// A machine without a device fails these tests: a skipped one would look like a pass.
void requireVulkan(const Sandbox& box) {
    REQUIRE(box.vkdose("devices").code == 0);
}

}  // namespace

TEST_CASE("a mini dose ends with a closed ledger on every backend") {
    const Sandbox box;
    requireVulkan(box);
    for (const std::string backend : {"reference", "vulkan"}) {
        const auto o = box.vkdose("run " + kMini + "--set stop.max_doses=1 --out " + backend + " --backend " + backend);
        CAPTURE(backend, o.err, o.out);
        REQUIRE(o.code == 0);
        CHECK_THAT(o.out,
                   Catch::Contains("closed") && Catch::Contains("particle-steps/s") && Catch::Contains("closed form"));
        const auto summary = nlohmann::json::parse(readText(box / backend / "summary.json"));
        const auto& ledger = summary["ledger"];
        CHECK(ledger["lost_count"] == 0);
        CHECK(ledger["canister_count"].get<int>() + ledger["throat_count"].get<int>() +
                  ledger["dosed_count"].get<int>() ==
              summary["inputs"]["particles"].get<int>());
        CHECK(ledger["worst_relative_mass_error"].get<double>() < 1e-6);
        CHECK(ledger["throat_count"].get<int>() > 0);  // the coil conveyed
        CHECK(ledger["dosed_count"].get<int>() > 0);
        CHECK(summary["doses"].size() == 1);
        CHECK(summary["doses"][0]["complete"] == true);
        CHECK_THAT(summary["backend"].get<std::string>(), Catch::StartsWith(backend));
    }
}

TEST_CASE("a run under the validation layer is clean") {
    const Sandbox box;
    requireVulkan(box);
    const auto o = box.vkdose("run " + kMini +
                              "--set settle.time_s=0.01 --set dose.rotate_s=0.005 --set dose.rest_s=0.002 --set "
                              "stop.max_doses=2 --validation --quiet --out out");
    if (unvalidated()) return;
    CHECK(o.err.find("not installed") == std::string::npos);  // the layer must be there to listen
    CHECK(o.code == 0);
    CHECK(o.err == "");
}

TEST_CASE("compare finds the backends in agreement, and tells when they are not") {
    const Sandbox box;
    requireVulkan(box);
    const auto o = box.vkdose("test compare " + kMini + "--set contact.k=8000 --time 0.06 --twins 1");
    CAPTURE(o.out, o.err);
    CHECK(o.code == 0);
    CHECK_THAT(o.out, Catch::Contains("the backends agree") && Catch::Contains("kinetic energy, settling"));
    CHECK(box.files().empty());
}

TEST_CASE("a spring of a contact that bears nothing for a while is the same on both backends") {
    const Sandbox box;
    requireVulkan(box);
    // A sphere bounces on a plane while it slides. On the way up the plastic contact bears nothing before it opens, and
    // the dashpot leaves something in the spring.
    box.write("one.csv", "x,y,z,r,vx,vy,vz\n0,1.00001e-3,0,1e-3,0.02,-0.1,0\n");
    box.write(
        "slide.toml",
        "boundaries = \"list\"\ngravity = [0, -98.1, 0]\n[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\n"
        "[particles]\ndensity = 2000.0\nlist = \"one.csv\"\n[contact]\nk = 1000.0\nk1_over_k = 0.2\nkc_over_k = 0.0\n"
        "plasticity_depth = 0.005\nrestitution = 0.4\nfriction = 1.0\n[settle]\ntime_s = 0.004\n"
        "[sensors]\ninterval_s = 0.00002\nenergy = true\n");
    const auto o = box.vkdose("test compare slide.toml --twins 3");
    CAPTURE(o.out, o.err);
    CHECK(o.code == 0);
    CHECK_THAT(o.out, Catch::Contains("the backends agree"));
}

TEST_CASE("compare does not say that backends agree where chaos leaves nothing of the packing to judge") {
    const Sandbox box;
    requireVulkan(box);
    // A handful of spheres that nothing slows down fly about for as long as they like.
    std::string wild = "--set particles.mass_g=0.05 --set settle.time_s=0.4 --time 0.4";
    for (const char* none : {"settle.kc_over_k=0", "contact.kc_over_k=0", "contact.friction=0", "contact.damping=1e-9",
                             "contact.wall.friction=0", "contact.rolling_friction=0", "contact.k1_over_k=1"})
        wild += std::string(" --set ") + none;
    const auto o = box.vkdose("test compare " + kMini + wild);
    CAPTURE(o.out, o.err);
    CHECK(o.code == 1);
    CHECK_THAT(o.out, Catch::Contains("\nUNDECIDED: ") && !Catch::Contains("backends agree"));
}
