#include "host/report/player_data.h"

#include "host/analysis/free_surface.h"
#include "host/analysis/overlap.h"
#include "host/core/error.h"
#include "host/core/random.h"
#include "host/report/deflate.h"
#include "host/report/page.h"
#include "tests/report/folders.h"
#include "tests/report/frames.h"
#include "tests/report/stream.h"
#include "tests/support/catch.h"
#include "tests/support/mini_case.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::report;
using namespace vkdose::test;

namespace {

double random01(std::uint64_t i) {
    return uniforms(3, Stream::Jitter, i)[0];
}

Vec3 somewhere(const Box& box, std::uint64_t i) {
    return box.low + Vec3(random01(3 * i), random01(3 * i + 1), random01(3 * i + 2)) * (box.high - box.low);
}

/// Particles all over the domain, with speeds of every magnitude; other ones for another `salt`.
Particles anywhere(const Case& c, std::size_t n, std::uint64_t salt) {
    Particles p;
    for (std::size_t i = 0; i < n; ++i) {
        const double speed = std::pow(10.0, -6 + 8 * random01(1000 * salt + 7 * i));
        p.add(somewhere(c.world.domain, 1'000'000 * salt + i), (0.9 + 0.4 * random01(i)) * 1e-3, {0, 0, speed});
    }
    return p;
}

}  // namespace

TEST_CASE("base64") {
    CHECK(base64("") == "");
    CHECK(base64("f") == "Zg==");  // the examples of RFC 4648
    CHECK(base64("fo") == "Zm8=");
    CHECK(base64("foobar") == "Zm9vYmFy");
    CHECK(fromBase64(base64("\xff\x00\x80!")) == std::string("\xff"));  // the literal ends at its zero
}

TEST_CASE("frames come out of the page's stream as exact as it says") {
    const Case c = mini();
    constexpr std::size_t kParticles = 211, kColumns = 13;
    std::vector<Frame> frames;
    for (int f = 0; f < 4; ++f) frames.push_back(frameOf(0.1 * f, f / 2, -0.5 * f, anywhere(c, kParticles, f)));
    frames[0].particles.position[0] = c.world.domain.low;
    frames[1].particles.position[0] = c.world.domain.high;
    for (Frame& f : frames) f.particles.radius = frames[0].particles.radius;
    for (int f = 2; f < 4; ++f) frames[f].particles.status[5] = Status::Dosed;
    frames[3].particles.status[6] = Status::Lost;
    for (int f = 0; f < 2; ++f) frames[f].particles.status[7] = Status::Waiting;

    const Json j = playerJson(c, sourceOf(frames), kColumns);
    CHECK(j["particles"] == kParticles);
    CHECK(j["stored"] == 4);
    CHECK(j["every"] == 1);
    CHECK(j["frames"]["time_s"] == Json({0.0, 0.1, 0.2, 0.1 * 3}));
    CHECK(j["frames"]["dose"] == Json({0, 0, 1, 1}));
    CHECK(j["frames"]["phase"] == Json({0, 0, 1, 1}));
    CHECK(j["frames"]["coil_angle_rad"] == Json({0.0, -0.5, -1.0, -1.5}));
    CHECK(j["frames"]["settled"] == 1);

    Bytes bytes(j["stream"].get<std::string>());
    const auto radii = bytes.words(kParticles);
    const double least = j["radius_m"][0], largest = j["radius_m"][1];
    for (std::size_t i = 0; i < kParticles; ++i)
        CHECK(near(least + (largest - least) * radii[i] / 65535, frames[0].particles.radius[i], largest - least,
                   0.5001 / 65535));
    std::vector<int> place[3], speed(kParticles, 0), overlap(kParticles, 0), surface(kColumns, 0);
    for (auto& axis : place) axis.assign(kParticles, 0);
    for (const Frame& frame : frames) {
        const Particles& p = frame.particles;
        const std::vector<double> ratio = overlapRatios(p, c.world, frame.coilAngle);
        for (auto& axis : place) bytes.wordsOnTop(axis);
        bytes.levelsOnTop(speed);
        bytes.levelsOnTop(overlap);
        bytes.wordsOnTop(surface);
        for (std::size_t i = 0; i < kParticles; ++i) {
            if (p.status[i] != Status::Active) {
                CHECK(speed[i] == 0);
                continue;
            }
            const Vec3 size = c.world.domain.high - c.world.domain.low;
            for (int k = 0; k < 3; ++k)  // half a step; rounding in double precision on top
                CHECK(near(c.world.domain.low[k] + size[k] * place[k][i] / 65535, p.position[i][k], size[k],
                           0.5001 / 65535));
            const double v = glm::length(p.velocity[i]);
            if (v < 1e-5)
                CHECK(speed[i] == 0);
            else if (v < 10)  // half a level: 10^(6/508)
                CHECK(nearRelative(1e-5 * std::pow(1e6, (speed[i] - 1) / 254.0), v, 0.028));
            else
                CHECK(speed[i] == 255);
            const double most = c.world.maxOverlapRatio;
            CHECK(near(overlap[i] / 255.0, std::sqrt(std::min(ratio[i] / most, 1.0)), 1, 0.5001 / 255));
        }
        const auto profile = surfaceProfile(p, *c.canister, kColumns, Across::Highest);
        const double height = c.world.domain.high.y - c.world.domain.low.y;
        for (std::size_t i = 0; i < kColumns; ++i)
            CHECK(near(surface[i] / 65535.0, profile.height[i] / height, 1, 0.5001 / 65535));
    }
    const auto came = bytes.words(kParticles), gone = bytes.words(kParticles);
    CHECK(came[7] == 2);
    CHECK(std::count(came.begin(), came.end(), 0) == kParticles - 1);
    CHECK(gone[5] == 2);
    CHECK(gone[6] == 3);
    CHECK(std::count(gone.begin(), gone.end(), 65535) == kParticles - 2);
    CHECK(bytes.over());
}

TEST_CASE("a property of a user's law has 8 bits from its least to its largest value in each frame") {
    Case c = mini();
    c.world.properties = {"heat", "charge"};
    constexpr std::size_t kParticles = 17;
    std::vector<Frame> frames;
    for (int f = 0; f < 3; ++f) {
        Frame& frame = frames.emplace_back(frameOf(0.1 * f, 0, 0, anywhere(c, kParticles, f)));
        frame.particles.radius = frames[0].particles.radius;
        for (std::size_t i = 0; i < kParticles && f < 2; ++i)  // the last frame is of a run without them
            frame.particles.properties.push_back({std::sqrt(double(i) + f), -1.5, 0, 0});
    }
    const Json j = playerJson(c, sourceOf(frames), 0);
    REQUIRE(j["properties"].size() == 2);
    CHECK(j["properties"][0]["name"] == "heat");
    CHECK(j["properties"][1]["low"] == Json({-1.5, -1.5, 0.0}));
    CHECK(j["properties"][1]["high"] == Json({-1.5, -1.5, 0.0}));
    Bytes bytes(j["stream"].get<std::string>());
    (void)bytes.words(kParticles);
    std::vector<int> heat(kParticles, 0), charge(kParticles, 0);
    for (std::size_t f = 0; f < 3; ++f) {
        (void)bytes.levels((3 * 2 + 2) * kParticles);  // places, speed, overlap
        bytes.levelsOnTop(heat);
        bytes.levelsOnTop(charge);
        const double low = j["properties"][0]["low"][f], high = j["properties"][0]["high"][f];
        for (std::size_t i = 0; i < kParticles && f < 2; ++i) {
            CHECK(near(low + (high - low) * heat[i] / 255, frames[f].particles.properties[i][0], high - low,
                       0.501 / 255));
            CHECK(charge[i] == 0);
        }
    }
    (void)bytes.words(2 * kParticles);
    CHECK(bytes.over());
}

TEST_CASE("frames that do not fit are thinned out evenly, and the last one stays") {
    const Case c = mini();
    std::vector<Frame> frames;
    for (int f = 0; f < 48; ++f) frames.push_back(frameOf(0.1 * f, 0, 0, anywhere(c, 97, f)));
    const FrameSource source = sourceOf(frames);
    const std::size_t whole = playerJson(c, source, 0)["stream"].get<std::string>().size();
    for (const double part : {0.9, 0.4, 0.1}) {
        const auto allowed = static_cast<std::size_t>(part * static_cast<double>(whole));
        const Json j = playerJson(c, source, 0, allowed);
        const int every = j["every"];
        const auto times = j["frames"]["time_s"].get<std::vector<double>>();
        CHECK(j["stream"].get<std::string>().size() <= allowed);
        CHECK(j["stored"] == 48);
        const auto kept = [](int n) { return 1 + 47 / n + (47 % n == 0 ? 0 : 1); };
        int least = 1;  // so many in a row go, if all frames take the same
        while (kept(least) > part * 48) ++least;
        CHECK(every >= least);
        CHECK(every <= least + 1);
        for (std::size_t i = 0; i + 1 < times.size(); ++i) CHECK(times[i] == frames[i * every].time);
        CHECK(times.back() == frames.back().time);
    }
    CHECK(playerJson(c, source, 0, 10)["frames"]["time_s"].size() == 2);  // no fewer, whatever they take
    CHECK(playerJson(c, {}, 0).is_null());
    frames[2].particles = anywhere(c, 96, 2);
    CHECK_THROWS_AS(playerJson(c, sourceOf(frames), 0), CaseError);
}

TEST_CASE("the page of 48 g over 30 s stays below 25 MB even if nothing about the particles can be foretold") {
    const Case c = loadCase(VKDOSE_SOURCE_DIR "/cases/paper-48g.toml");
    // 3234 particles every 0.04 s, anywhere in each frame: no order that could be packed.
    FrameSource source;
    for (int f = 0; f <= 750; ++f) source.entries.push_back({f, 0, 0.04 * f, Phase::Rotate, 1, 0});
    source.read = [&c](const FrameEntry& e) { return frameOf(e.time, 1, 0, anywhere(c, 3234, e.number)); };
    const Sandbox box;
    Json data = runJson(writeRun(box, "large"), {});
    data["player"] = playerJson(c, source, 48);
    CHECK(data["player"]["every"] == 2);  // all of them would be 26 MB
    CHECK(page(data).size() < 25'000'000);
}

TEST_CASE("the player's bodies stand where their clocks have brought them") {
    Case c = mini();
    RigidBody byTime, inPhases;
    byTime.shapes = inPhases.shapes = {geometry::Ball{Vec3(0), 2e-3}};
    byTime.course.motion = inPhases.course.motion = geometry::Turn{Vec3(0, 0, 1), Vec3(0.01, 0, 0), 2.0};
    inPhases.clock = Clock::Phases;
    c.world.bodies = {byTime, inPhases};
    std::vector<Frame> frames{frameOf(0.1, 0, 0, anywhere(c, 5, 0)), frameOf(0.3, 1, 0, anywhere(c, 5, 1))};
    for (Frame& f : frames) {
        f.particles.radius = frames[0].particles.radius;
        f.bodiesMoved = {0, f.time};
    }
    const Json bodies = playerJson(c, sourceOf(frames), 0)["bodies"];
    CHECK(bodies[0]["poses"] == bodies[1]["poses"]);
    frames[1].bodiesMoved[1] = 0.1;
    CHECK(playerJson(c, sourceOf(frames), 0)["bodies"][1]["poses"] != bodies[1]["poses"]);
}
