// The player in a browser, on a scene whose picture is known.
#include "host/core/error.h"
#include "host/report/free_surface_report.h"
#include "host/report/player_bodies.h"
#include "tests/report/browser.h"
#include "tests/report/folders.h"
#include "tests/report/frames.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::report;
using namespace vkdose::test;

namespace {

constexpr double kRadius = 1.3e-3;
constexpr double kMiddle = 10.5e-3;  // of canister and throat, along

/// In cases/mini.toml, whose canister is 14 mm wide and, with its throat, 21 mm long. A fast sphere (yellow) on the
/// floor in the middle of what the player shows at first; a slow one (blue) at the rear that goes to the outlet; then
/// only that one is left.
std::vector<Frame> scene() {
    Particles p;
    p.add({0, kRadius - 7e-3, kMiddle}, kRadius, {0, 0, 1});
    p.add({0, kRadius - 7e-3, 2e-3}, 0.9 * kRadius);
    std::vector<Frame> frames{frameOf(0.05, 0, 0, p)};
    p.position[1].z = 19e-3;
    frames.push_back(frameOf(0.3, 1, -kPi, p));
    p.status[0] = Status::Dosed;
    frames.push_back(frameOf(0.5, 2, -kPi, p));
    return frames;
}

Json dataOf(const Sandbox& box) {
    Json data = runJson(writeRun(box, "why"), {}, sourceOf(scene()), {});
    // A short piece of wire where it hides nothing: over the axis at first, under it once it has turned by half.
    data["player"]["coil"] = {{"radius", 2.5e-3}, {"pitch", 7e-3},          {"wire", 0.8e-3}, {"length", 0.35e-3},
                              {"z_start", 15e-3}, {"start_angle", kPi / 2}, {"hand", 1}};
    return data;
}

double area(const Json& seen, const char* colour) {
    return seen[colour]["n"];
}

}  // namespace

TEST_CASE("a browser plays the frames of a run") {
    if (browserMissing()) return;
    const Sandbox box;
    const Json data = dataOf(box);
    const std::string probe = readProbe("player_probe.js");
    const Json seen = probed(drawn(box, data, kWebGl, probe));
    REQUIRE(seen["state"] == "ready");

    // At first: yellow in the middle of the picture, blue left of it and no lower than the perspective makes it.
    const Json& first = seen["first"];
    CHECK(first["text"] == "t = 0.050 s, settling; frame 1 of 3");
    REQUIRE(area(first, "yellow") > 500);
    CHECK(near(first["yellow"]["x"], 0.5, 1, 0.01));  // a hundredth of the picture: what the light side weighs more
    CHECK(near(first["yellow"]["y"], 0.5, 1, 0.01));
    REQUIRE(area(first, "blue") > 200);
    CHECK(first["blue"]["x"] < 0.35);
    // Moved by the slider: blue on the right now, yellow where it was; then yellow is gone.
    CHECK(seen["moved"]["text"] == "t = 0.300 s, dose 1, the coil turns; frame 2 of 3");
    CHECK(seen["moved"]["blue"]["x"] > 0.65);
    CHECK(area(seen["moved"], "yellow") == area(first, "yellow"));
    // The wire goes down by 5 mm where the picture shows 25 mm from left to right; the canister's grey lines stay.
    CHECK(area(first, "steel") > 100);
    CHECK(first["steel"]["y"].get<double>() - seen["moved"]["steel"]["y"].get<double>() > 0.1);
    CHECK(area(seen["gone"], "yellow") == 0);
    CHECK(area(seen["gone"], "blue") == area(seen["moved"], "blue"));

    // A cut across the middle halves yellow (seen at an angle: not just), one behind it hides it, both spare blue.
    CHECK(seen["place"] == "z = 10.5 mm");
    CHECK(area(seen["halved"], "yellow") > 0.3 * area(first, "yellow"));
    CHECK(area(seen["halved"], "yellow") < 0.9 * area(first, "yellow"));
    CHECK(area(seen["hidden"], "yellow") == 0);
    CHECK(area(seen["hidden"], "blue") == area(first, "blue"));
    // Cut along its middle from the side, yellow shows a section as wide as itself, seen at an angle.
    CHECK(area(seen["section"], "yellow") > 0.7 * area(first, "yellow"));
    CHECK(area(seen["section"], "yellow") < area(first, "yellow"));
    CHECK(area(seen["hiddenFromSide"], "yellow") == 0);  // the plane is behind it now
    CHECK(area(seen["hiddenFromAbove"], "yellow") == 0);

    // The view: nearer by 1.2, turned, and back again.
    CHECK(near(area(seen["nearer"], "yellow") / area(first, "yellow"), 1.44, 1.44, 0.05));  // whole pixels; perspective
    CHECK(seen["turned"]["blue"]["x"] != seen["nearer"]["blue"]["x"]);
    CHECK(seen["reset"]["blue"] == first["blue"]);

    // By radius the large one is yellow, the small one blue, as by speed; the legend says what is shown.
    CHECK(seen["quantity"] == "radius [mm]");
    CHECK(area(seen["radius"], "yellow") == area(first, "yellow"));

    // Charts: a rule at the frame's time of 0.7 s, and at its dose (from 0.5 to 4.5); none before the first dose.
    CHECK(near(seen["rule"], 0.3 / 0.7, 1, 1e-6));
    CHECK(near(seen["doseRule"], 0.5 / 4, 1, 1e-6));
    CHECK(seen["settledRule"].is_null());
    // A click in a chart leads to the frame nearest in time, or to the first of the dose.
    CHECK(seen["byTime"]["text"] == "t = 0.500 s, dose 2, the coil turns; frame 3 of 3");
    CHECK(seen["byDose"]["text"] == "t = 0.300 s, dose 1, the coil turns; frame 2 of 3");
    CHECK(seen["nextDose"]["text"] == "t = 0.500 s, dose 2, the coil turns; frame 3 of 3");
    // Played from the end it begins again, and ends there, in the time that it took.
    REQUIRE(seen["played"].size() == 3);
    const char* const steps[] = {"first", "moved", "gone"};
    for (int i = 0; i < 3; ++i) CHECK(seen["played"][i][1] == seen[steps[i]]["text"]);
    const double shownFor = seen["played"][2][0].get<double>() - seen["played"][0][0].get<double>();
    CHECK(near(shownFor, 450, 10, 1.01));  // [ms], to a picture

    // The browser unpacked the bytes that were packed.
    const Case c = loadCase(VKDOSE_SOURCE_DIR "/cases/mini.toml");
    const Vec3 low = c.world.domain.low, size = c.world.domain.high - low;
    const std::vector<Frame> frames = scene();
    for (std::size_t f = 0; f < frames.size(); ++f)
        for (std::size_t i = 0; i < 2; ++i)
            for (int k = 0; k < 3; ++k)
                CHECK(near(low[k] + size[k] * seen["positions"][3 * (2 * f + i) + k].get<double>() / 65535,
                           frames[f].particles.position[i][k], size[k], 0.5001 / 65535));
    CHECK(seen["here"] == Json({{true, true, false}, {true, true, true}}));
    CHECK(seen["speeds"][1] == 0);
    CHECK(seen["speeds"][4] == 0);  // gone
    CHECK(near(1e-5 * std::pow(1e6, (seen["speeds"][0].get<double>() - 1) / 254), 1, 1, 0.028));
    const Json& settled = data["surface"]["states"][0]["height_m"];
    for (std::size_t i = 0; i < settled.size(); ++i)
        CHECK(near(seen["heights"][i].get<double>() / 65535, settled[i].get<double>() / size.y, 1, 0.5001 / 65535));
}

TEST_CASE("without WebGL the page says so and shows the rest") {
    if (browserMissing()) return;
    const Sandbox box;
    const std::string probe = readProbe("player_probe.js");
    const std::string dom = drawn(box, dataOf(box), kNoWebGl, probe);
    const Json seen = probed(dom);
    CHECK(seen["state"] == "failed");
    CHECK_THAT(seen["text"].get<std::string>(),
               Catch::Contains("cannot be shown here: this browser offers no WebGL 2"));
    CHECK(dom.find("data-state=\"ready\"") != std::string::npos);
    CHECK(count(dom, "<figure") == 8);  // the player's, two of doses, the surface, torque, power, velocity, the ledger
}

namespace {

std::vector<Frame> framesAt(const std::vector<double>& times) {
    std::vector<Frame> frames(times.size());
    for (std::size_t i = 0; i < times.size(); ++i) frames[i].time = times[i];
    return frames;
}

}  // namespace

TEST_CASE("the player shows what a user's law gives particles in colours of one scale for all frames") {
    if (browserMissing()) return;
    const Sandbox box;
    Json data = dataOf(box);
    Case c = loadCase(VKDOSE_SOURCE_DIR "/cases/mini.toml");
    c.world.properties = {"heat"};
    std::vector<Frame> frames = scene();  // the fast sphere is cold, the slow one hot
    for (Frame& f : frames) f.particles.properties = {{-40, 0, 0, 0}, {60, 0, 0, 0}};
    data["player"] = playerJson(c, sourceOf(frames), data["surface"]["z_m"].size());
    const Json seen = probed(drawn(box, data, kWebGl, readProbe("player_probe.js")));
    REQUIRE(seen["state"] == "ready");
    CHECK(seen["ownQuantity"] == "heat");
    CHECK(seen["first"]["yellow"]["x"] > 0.4);
    REQUIRE(area(seen["own"], "yellow") > 100);
    CHECK(seen["own"]["yellow"]["x"] < 0.35);
    CHECK(seen["own"]["blue"]["x"] > 0.4);
}

TEST_CASE("the player shows a body where its motion has brought it") {
    if (browserMissing()) return;
    const Sandbox box;
    Json data = dataOf(box);
    data["player"]["coil"] = nullptr;
    // A ball that goes from the rear to the outlet: 3 mm along in the first frame, 18 mm in the second.
    Case c = loadCase(VKDOSE_SOURCE_DIR "/cases/mini.toml");
    RigidBody ball;
    ball.name = "ball";
    ball.shapes = {geometry::Ball{Vec3(0, 2e-3, 0), 2e-3}};
    ball.course.motion = geometry::Slide{{0, 0, 0.06}};
    c.world.bodies = {ball};
    data["player"]["bodies"] = bodiesJson(c, framesAt({0.05, 0.3, 0.5}), scene()[0]);
    CHECK_FALSE(data["player"]["bodies"][0]["pane"]);
    const Json seen = probed(drawn(box, data, kWebGl, readProbe("player_probe.js")));
    REQUIRE(seen["state"] == "ready");
    REQUIRE(area(seen["first"], "steel") > 200);
    // The picture shows about 25 mm from left to right.
    const double way = seen["moved"]["steel"]["x"].get<double>() - seen["first"]["steel"]["x"].get<double>();
    CHECK(way > 0.4);
    CHECK(way < 0.8);

    // A box around all of it is a pane: blue shows through.
    c.world.bodies[0].shapes = {geometry::Block{{-8e-3, -8e-3, -1e-3}, {8e-3, 8e-3, 22e-3}, true}};
    c.world.bodies[0].course.motion = geometry::Rest{};
    data["player"]["bodies"] = bodiesJson(c, framesAt({0.05, 0.3, 0.5}), scene()[0]);
    CHECK(data["player"]["bodies"][0]["pane"]);
    const Json through = probed(drawn(box, data, kWebGl, readProbe("player_probe.js")));
    REQUIRE(through["state"] == "ready");
    CHECK(area(through["first"], "blue") > 100);
}
