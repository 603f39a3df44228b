#include "host/report/free_surface_report.h"

#include "host/analysis/free_surface.h"
#include "host/core/json.h"
#include "tests/report/faults.h"
#include "tests/report/folders.h"
#include "tests/report/frames.h"
#include "tests/support/catch.h"
#include "tests/support/mini_case.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::report;
using namespace vkdose::test;

namespace {

/// One sphere in the canister, its middle so high [m, y].
Particles at(double y) {
    Particles p;
    p.add({0, y, 8e-3}, 2e-3);
    return p;
}

/// The settled bed, two frames of the first dose, one of the second.
FrameSource run() {
    return sourceOf({frameOf(0.1, 0, 0, at(9e-3)), frameOf(0.2, 1, 0, at(7e-3)), frameOf(0.3, 1, 0, at(5e-3)),
                     frameOf(0.4, 2, 0, at(3e-3))});
}

}  // namespace

TEST_CASE("the surface of a run: settled, and at the last frame of each dose") {
    const Case c = mini();
    const Json j = surfaceJson(c, run(), {}, 0, {});
    REQUIRE(j["states"].size() == 3);
    CHECK(j["length_m"] == 0.016);
    CHECK(j["z_m"].size() == 8);  // of a mean radius each
    const double heights[] = {9e-3, 5e-3, 3e-3}, times[] = {0.1, 0.3, 0.4};
    for (int i = 0; i < 3; ++i) {
        CHECK(j["states"][i]["dose"] == i);
        CHECK(j["states"][i]["time_s"] == times[i]);
        CHECK(j["states"][i]["height_m"] ==
              jsonNumbers(surfaceProfile(at(heights[i]), *c.canister, 8, Across::Highest).height));
    }
    CHECK(j["z_m"] == jsonNumbers(surfaceProfile(at(0), *c.canister, 8, Across::Highest).z));
}

TEST_CASE("the surface of a run without frames is that of its end, and of nothing there is none") {
    Case c = mini();
    const Json j = surfaceJson(c, {}, at(2e-3), 7, {});
    REQUIRE(j["states"].size() == 1);
    CHECK(j["states"][0]["dose"] == 7);
    CHECK(j["states"][0]["height_m"] == jsonNumbers(surfaceProfile(at(2e-3), *c.canister, 8, Across::Highest).height));
    CHECK(surfaceJson(c, {}, {}, 0, {}).is_null());
    CHECK(surfaceJson(c, {}, Particles{}, 0, {}).is_null());
    c.canister.reset();
    CHECK(surfaceJson(c, run(), at(0), 7, {}).is_null());
}

TEST_CASE("a photograph stands beside the state of its dose, or the last") {
    const Sandbox box;
    const auto csv = box.write("photo.csv", "z_mm,height_mm\n1,12.5\n2,\n3,11\n");
    const Json j = surfaceJson(mini(), run(), {}, 0, {{csv, 1}, {csv, {}}, {csv, 0}});
    REQUIRE(j["photographs"].size() == 3);
    const Json& first = j["photographs"][0];
    CHECK(first["name"] == "photo.csv");
    CHECK(near(first["z_m"][2], 3e-3, 1e-3, 1e-12));
    CHECK(near(first["height_m"][0], 12.5e-3, 1e-3, 1e-12));
    CHECK(first["height_m"][1].is_null());
    CHECK(first["dose"] == 1);
    CHECK(j["photographs"][1]["dose"] == 2);
    CHECK(j["photographs"][2]["dose"] == 0);
}

TEST_CASE("a photograph that does not fit is refused with what would be right") {
    const Sandbox box;
    const auto csv = box.write("photo.csv", "z_mm,height_mm\n1,12\n");
    const auto report = [&](const FrameSource& frames, const Photograph& photograph) {
        return faultOf([&] { surfaceJson(mini(), frames, {}, 0, {photograph}); });
    };
    CHECK_THAT(report(run(), {csv, 3}),
               Catch::Contains("photo.csv: --profile = @3: the run kept no state of this dose; "
                               "give one of 0, 1, 2 (0 is the settled bed)"));
    CHECK_THAT(report({}, {csv, {}}), Catch::Contains("the run has no surface to stand beside"));
    CHECK_THAT(report(run(), {box / "none.csv", {}}), Catch::Contains("none.csv"));
    CHECK_THAT(report(run(), {box.write("a.csv", "z,height_mm\n1,2\n"), {}}), Catch::Contains("z_mm"));
    CHECK_THAT(report(run(), {box.write("b.csv", "z_mm,height_mm\n,2\n"), {}}), Catch::Contains("z_mm"));
    CHECK_THAT(report(run(), {box.write("c.csv", "z_mm,height_mm\nx,2\n"), {}}), Catch::Contains("z_mm"));
}

TEST_CASE("a photograph that is longer than the canister is refused") {
    const Sandbox box;
    const auto report = [&](const std::string& rows) {
        const auto csv = box.write("photo.csv", "z_mm,height_mm\n" + rows);
        return faultOf([&] { surfaceJson(mini(), run(), {}, 0, {{csv, 1}}); });
    };
    CHECK_THAT(report("0,5\n20,6\n"),
               Catch::Contains("runs from 0 to 20 mm, the canister from 0 to 16 mm") && Catch::Contains("--length-mm"));
    CHECK_THAT(report("-4,5\n8,6\n"), Catch::Contains("runs from -4 to 8 mm"));
    const auto csv = box.write("photo.csv", "z_mm,height_mm\n-0.1,5\n16.2,6\n");  // cut a little wide
    CHECK(surfaceJson(mini(), run(), {}, 0, {{csv, 1}})["photographs"].size() == 1);
}

TEST_CASE("a photograph's dose stands after an @") {
    CHECK(photographOf("a/photo.csv").file == "a/photo.csv");
    CHECK(!photographOf("a/photo.csv").dose);
    CHECK(photographOf("a/photo.csv@12").file == "a/photo.csv");
    CHECK(photographOf("a/photo.csv@12").dose == 12);
    CHECK(photographOf("me@home/photo.csv@0").file == "me@home/photo.csv");
    for (const char* wrong : {"photo.csv@", "photo.csv@two", "photo.csv@-1", "photo.csv@1.5", "photo.csv@nan"})
        CHECK_THAT(faultOf([&] { photographOf(wrong); }), Catch::Contains("give FILE.csv or FILE.csv@DOSE"));
    const Sandbox box;  // a file so named is a file
    const std::string odd = box.write("photo@3", "").string();
    CHECK(photographOf(odd).file == odd);
    CHECK(!photographOf(odd).dose);
}
