// Maps of fields in a browser: what stands where, and that they and the player lead each other.
#include "host/report/free_surface_report.h"
#include "tests/report/browser.h"
#include "tests/report/fields.h"
#include "tests/report/folders.h"
#include "tests/report/frames.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::report;
using namespace vkdose::test;

namespace {

/// The folder of a run whose maps are at 0.1, 0.2 and 0.3 s.
std::filesystem::path writeRunWithFields(const Sandbox& box) {
    auto folder = writeRun(box, "why");
    const Case c = caseWithFields(false);
    box.write("run/case.toml",
              readText(folder / "case.toml") +
                  "\n[[field]]\nname = \"plane\"\nlow = [-1e-3, -7e-3, 0]\nhigh = [1e-3, 5e-3, 16e-3]\n"
                  "cells = [1, 3, 4]\nwidth_mm = 2\n");
    writeMaps(box, c, 3);
    return folder;
}

}  // namespace

TEST_CASE("a browser draws the maps of a run's fields") {
    if (browserMissing()) return;
    const Sandbox box;
    const Json seen = probed(drawn(box, runJson(writeRunWithFields(box), {}), kNoWebGl, readProbe("fields_probe.js")));
    REQUIRE(seen["state"] == "ready");
    CHECK(seen["first"]["text"] == "t = 0.100 s, settling; map 1 of 3");
    CHECK(seen["quantity"] == "density [kg/m³]");
    // Four by three; nothing in the rear's uppermost cell, the same everywhere else in a row, denser upwards.
    const Json& first = seen["first"]["pixels"];
    REQUIRE(first.size() == 12);
    CHECK(first[0] == "none");
    for (const int i : {1, 2, 3}) CHECK(first[i] == "251,223,79");  // the ramp's end
    for (const int i : {5, 6, 7}) CHECK(first[i] == first[4]);
    for (const int i : {9, 10, 11}) CHECK(first[i] == first[8]);
    CHECK(first[4] != first[8]);
    // Moved by its slider. By speed the fastest cell, of z and the upper row, has the end of the ramp.
    CHECK(seen["moved"]["text"] == "t = 0.300 s, dose 2, the coil turns; map 3 of 3");
    CHECK(seen["speed"]["quantity"] == "speed in the plane [m/s]");
    CHECK(seen["speed"]["pixels"][3] == "251,223,79");
    CHECK(seen["speed"]["pixels"][8] == "47,75,148");  // at rest
    // Arrows where it moves: not at rest, not where nothing is. With 3 u along z and 2 u down the wall: to the lower
    // right.
    CHECK(seen["arrows"].size() == 10);
    double right = 0, down = 0;
    for (const Json& a : seen["arrows"]) {
        right = std::max(right, a[0].get<double>());
        down = std::max(down, a[1].get<double>());
    }
    CHECK(right > 0);
    CHECK(down > 0);
    for (const Json& a : seen["arrows"]) {
        CHECK(a[0] >= 0);
        CHECK(a[1] >= 0);
    }
    // True to scale: 16 mm by 12.
    CHECK(near(seen["shape"], 16.0 / 12, 1, 0.02));
}

TEST_CASE("the player leads the maps, and a map's slider the player") {
    if (browserMissing()) return;
    const Sandbox box;
    Particles p;
    p.add({0, 0, 8e-3}, 1e-3);
    const FrameSource frames = sourceOf({frameOf(0.05, 0, 0, p), frameOf(0.21, 1, 0, p), frameOf(0.5, 2, 0, p)});
    const Json seen =
        probed(drawn(box, runJson(writeRunWithFields(box), {}, frames, {}), kWebGl, readProbe("fields_probe.js")));
    REQUIRE(seen["state"] == "ready");
    REQUIRE(seen["player"] == "ready");
    CHECK(seen["first"]["text"] == "t = 0.100 s, settling; map 1 of 3");
    CHECK(seen["led"]["text"] == "t = 0.200 s, dose 1, the coil turns; map 2 of 3");
    CHECK(seen["leads"]["text"] == "t = 0.300 s, dose 2, the coil turns; map 3 of 3");
    CHECK_THAT(seen["leads"]["player"].get<std::string>(), Catch::Contains("t = 0.210 s"));  // nearest to 0.3 s
}

TEST_CASE("a map too fine for the page says so, and the rest is there") {
    if (browserMissing()) return;
    const Sandbox box;
    Json data = runJson(writeRunWithFields(box), {});
    data["fields"]["maps"][0]["stream"] = nullptr;
    const std::string dom = drawn(box, data);
    CHECK(dom.find("too fine for a page") != std::string::npos);
    CHECK(dom.find("data-state=\"ready\"") != std::string::npos);
}
