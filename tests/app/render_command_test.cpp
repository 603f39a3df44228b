// vkdose render, as a user calls it: which states it draws, what it says no to, films. What a picture shows is tested
// in tests/render.

#include <cairo/cairo.h>

#include <memory>

#include "host/app/exit_code.h"
#include "host/app/run_states.h"
#include "host/output/end_state.h"
#include "host/output/frame_writer.h"
#include "host/output/run_folder.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"
#include "tests/support/mini_case.h"

using namespace vkdose;
using namespace vkdose::test;

namespace fs = std::filesystem;

namespace {

/// A picture read back.
struct Png {
    explicit Png(const fs::path& file)
        : surface(cairo_image_surface_create_from_png(file.c_str()), cairo_surface_destroy) {
        REQUIRE(cairo_surface_status(surface.get()) == CAIRO_STATUS_SUCCESS);
        width = cairo_image_surface_get_width(surface.get());
        height = cairo_image_surface_get_height(surface.get());
    }
    /// Pixels that are clearly coloured and lie left of `right`: powder, not the colour bar.
    int coloured(double right) const {
        int count = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < right * width; ++x) {
                const unsigned char* p = cairo_image_surface_get_data(surface.get()) +
                                         std::ptrdiff_t(y) * cairo_image_surface_get_stride(surface.get()) +
                                         std::ptrdiff_t(x) * 4;
                const auto [low, high] = std::minmax({p[0], p[1], p[2]});
                count += high - low > 40;
            }
        return count;
    }
    std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface;
    int width, height;
};

Particles threeSpheres() {
    Particles p;
    p.add({0, 5e-3, 4e-3}, 1.2e-3);
    p.add({0, 5e-3, 8e-3}, 1.2e-3, {0, 0, 0.05});
    p.add({0, 5e-3, 12e-3}, 1.2e-3, {0, 0, 0.1});
    return p;
}

/// A run that is over and kept no frames; its coil has conveyed for 1.5 rad.
void writeEnd(const Sandbox& box) {
    fs::create_directories(box / "run");
    box.write("run/case.toml", mini().resolved);
    writeParticles(box / "run/particles.csv", threeSpheres());
    box.write("run/summary.json",
              R"({"simulated_time_s": 0.95, "steps": 47500, "coil_angle_rad": -1.5, "doses": [{}, {}]})");
}

/// A run of two doses with a frame every 0.1 s: after 0.2 s of settling one sphere leaves in each of the first dose's
/// turning and resting, the last never.
void writeFrames(const Sandbox& box) {
    fs::create_directories(box / "run");
    box.write("run/case.toml", mini().resolved);
    FrameWriter writer(box / "run", mini(), 0);
    for (int k = 0; k <= 8; ++k) {
        Frame f;
        f.step = std::uint64_t(k) * 1000;
        f.time = 0.1 * k;
        f.phase = k <= 2 ? Phase::Settle : k % 3 == 2 ? Phase::Rest : Phase::Rotate;  // 3 4 | 5 | 6 7 | 8
        f.dose = k <= 2 ? 0 : k <= 5 ? 1 : 2;
        f.coilAngle = -0.3 * k;
        f.particles = threeSpheres();
        for (Vec3& x : f.particles.position) x.y -= 0.5e-3 * k;
        if (k >= 4) f.particles.status[2] = Status::Dosed;
        if (k >= 5) f.particles.status[1] = Status::Dosed;
        writer.put(f);
    }
    writer.store();
}

/// A program called ffmpeg that keeps what it is told and given; `ending` is shell.
std::string standIn(const Sandbox& box, const std::string& ending) {
    fs::create_directories(box / "bin");
    const fs::path program = box.write("bin/ffmpeg", "#!/bin/sh\necho \"$@\" > told.txt\ncat > given.raw\n" + ending);
    fs::permissions(program, fs::perms::owner_all);
    return "PATH=\"$PWD/bin:$PATH\"; export PATH; ";
}

}  // namespace

TEST_CASE("render: the end of a run that kept no frames") {
    const Sandbox box;
    writeEnd(box);
    const Frame end = readEndState(box / "run", mini());
    CHECK(end.time == 0.95);
    CHECK(end.dose == 2);
    CHECK(end.coilAngle == -1.5);  // a right-handed coil conveys clockwise
    REQUIRE(end.particles.size() == 3);
    CHECK(end.particles.velocity[2].z == 0.1);

    const auto outcome = box.vkdose("render run --no-coil --size 317x211");
    CHECK(outcome.err.empty());
    CHECK(outcome.code == kOk);
    CHECK(outcome.out == "run/picture.png\n");
    const Png picture(box / "run/picture.png");
    CHECK(picture.width == 317);
    CHECK(picture.height == 211);
    const int powder = picture.coloured(0.6);
    CHECK(powder > 50);
    CHECK(box.vkdose("render run --no-coil --size 317x211 --out again.png --time 0.95 --validation").code == kOk);
    const bool same = readText(box / "again.png") == readText(box / "run/picture.png");
    CHECK(same);
    CHECK(box.vkdose("render run --view cut --color overlap --out cut.png").code == kOk);
    CHECK(Png(box / "cut.png").height > 500);
}

TEST_CASE("render: what cannot be drawn is told, and nothing is written") {
    const Sandbox box;
    writeEnd(box);
    fs::create_directories(box / "empty");
    fs::create_directories(box / "begun");
    box.write("begun/case.toml", mini().resolved);
    const auto refused = [&](const std::string& arguments, const std::string& why, int code = kBadInput) {
        const auto outcome = box.vkdose("render " + arguments);
        INFO(arguments);
        CHECK(outcome.code == code);
        CHECK_THAT(outcome.err, Catch::Contains(why));
        CHECK_FALSE(fs::exists(box / "run/picture.png"));
    };
    refused("nowhere", "neither a file nowhere nor a case of that name");
    refused("no/where", "no/where");
    refused("run --set coil.speed_rpm=60", "is the folder of a run, whose case is what it was");
    refused("empty", "it holds no case.toml");
    refused("begun", "begun holds neither frames nor an end");
    refused("run --time 0.5", "no frame at 0.5 s: the run kept none");
    refused("run --panels", "kept no frames");
    refused("run --movie film", "kept no frames");
    refused("run --color fill-layer", "kept no frames");
    refused("run --color heat", "heat");
    refused("run --view top", "top");
    refused("run --out p.jpg", "writes a PNG picture; give a name that ends in .png");
    refused("run --size 10x10", "64 to 16384");
    refused("run --size 640", "--size 1280x720");
    refused("run --size 640x480x3", "--size 1280x720");
    refused("run --color speed --from 3 --to 2", "range is empty");
    refused("run --from -1", "logarithmic");
    refused("run --time 0.95 --panels", "excludes");
    refused("run --rate 10", "requires");
    refused("run --device nosuchdevice", "nosuchdevice", kDeviceError);
    refused("run --size 80x64 --out no/such/folder.png", "cannot write", kOutputError);
    box.write("run/summary.json", "{}");
    refused("run", "simulated_time_s", kOutputError);
}

TEST_CASE("render: a case before it runs") {
    const Sandbox box;
    box.write("small.toml", readText(fs::path(VKDOSE_SOURCE_DIR) / "cases/mini.toml"));
    const auto outcome = box.vkdose("render small.toml --size 320x240");
    CHECK(outcome.err.empty());
    REQUIRE(outcome.code == kOk);
    CHECK(outcome.out == "small.png\n");
    const int powder = Png(box / "small.png").coloured(0.6);
    CHECK(powder > 50);

    // By its name, and with a value replaced: twice the powder is seen.
    CHECK(box.vkdose("render mini --size 320x240 --out same.png").code == kOk);
    const bool same = readText(box / "same.png") == readText(box / "small.png");
    CHECK(same);
    CHECK(box.vkdose("render mini --size 320x240 --set particles.mass_g=0.2 --out less.png").code == kOk);
    CHECK(Png(box / "less.png").coloured(0.6) < powder / 2);

    const auto refused = [&](const std::string& arguments, const std::string& why) {
        INFO(arguments);
        const auto told = box.vkdose("render small.toml " + arguments);
        CHECK(told.code == kBadInput);
        CHECK_THAT(told.err, Catch::Contains(why));
    };
    refused("--panels", "only its start can be drawn");
    refused("--movie film", "only its start can be drawn");
    refused("--color fill-layer", "kept no frames");
    refused("--out small.toml", "small.toml");
    refused("--set coil.speed=1", "coil.speed");
}

TEST_CASE("render: which state is drawn") {
    const Sandbox box;
    writeFrames(box);
    const RunStates states(box / "run");
    REQUIRE(states.entries().size() == 9);
    CHECK(states.at(0.41) == 4);
    CHECK(states.at(0.36) == 4);
    CHECK(states.at(0.85) == 8);  // no further off than the next one would be
    CHECK(states.settled() == 2);
    // The settled bed, the last of the first turning, half of the two that leave, a tenth left: the last.
    CHECK(states.story() == std::vector<std::size_t>{2, 4, 8});
    CHECK(states.read(5).particles.status[1] == Status::Dosed);
    CHECK(states.read(5).coilAngle == -1.5);

    const auto powder = [&](const std::string& arguments) {
        const auto outcome = box.vkdose("render run --no-coil --color radius --size 331x211 --out p.png " + arguments);
        CHECK(outcome.err.empty());
        REQUIRE(outcome.code == kOk);
        return Png(box / "p.png").coloured(0.65);
    };
    // Spheres as large as each other: their pixels count those that are left. The content decides the size of a pixel,
    // and that is the canister's: the same for all, for these lie below the throat's top.
    const int three = powder("--time 0.2"), two = powder("--time 0.4"), one = powder("--time 0.5");
    CHECK(two == Approx(2.0 / 3 * three).epsilon(0.05));
    CHECK(one == Approx(1.0 / 3 * three).epsilon(0.1));
    CHECK(powder("") == Approx(one).epsilon(0.1));  // the end
    const auto refused = box.vkdose("render run --time 1");
    CHECK(refused.code == kBadInput);
    CHECK_THAT(refused.err, Catch::Contains("no frame at 1 s; 9 frames reach from 0 to 0.8 s"));
}

TEST_CASE("render: panels, and layers by the height in the settled bed") {
    const Sandbox box;
    writeFrames(box);
    const auto same = [&](const char* a, const char* b) { return readText(box / a) == readText(box / b); };
    CHECK(box.vkdose("render run --panels --size 480x160 --out story.png").code == kOk);
    CHECK(box.vkdose("render run --time 0.2 0.4 0.8 --size 480x160 --out told.png").code == kOk);
    CHECK(same("story.png", "told.png"));
    CHECK(box.vkdose("render run --time 0.2 0.5 0.8 --size 480x160 --out other.png").code == kOk);
    CHECK_FALSE(same("story.png", "other.png"));
    const auto layers = box.vkdose("render run --color fill-layer --view cut --time 0.3 --size 160x160 --out l.png");
    CHECK(layers.err.empty());
    CHECK(layers.code == kOk);
}

TEST_CASE("render: a film is handed to ffmpeg picture by picture") {
    const Sandbox box;
    writeFrames(box);
    const std::string path = standIn(box, "exit 0");
    auto outcome = box.vkdose("render run --movie film.mp4 --size 160x120 --rate 12.5", path);
    CHECK(outcome.err.empty());
    CHECK(outcome.code == kOk);
    CHECK(outcome.out == "9 pictures in film.mp4\n");
    const std::string told = readText(box / "told.txt"), given = readText(box / "given.raw");
    CHECK_THAT(told, Catch::Contains("-s 160x120") && Catch::Contains("-framerate 12.5") &&
                         Catch::Contains((box / "film.mp4").string()));
    constexpr std::size_t kBytes = 160UL * 120 * 4;  // of a picture
    CHECK(given.size() == 9 * kBytes);
    // The same states as single pictures.
    CHECK(box.vkdose("render run --movie film --size 160x120").code == kOk);
    for (const int k : {0, 8}) {
        const Png png(box / ("film/frame_00000" + std::to_string(k) + ".png"));
        const unsigned char* data = cairo_image_surface_get_data(png.surface.get());
        int differ = 0;
        for (std::size_t i = 0; i < kBytes; ++i)
            differ += i % 4 != 3 && data[i] != static_cast<unsigned char>(given[k * kBytes + i]);
        CHECK(differ == 0);
    }
    // A second film into the same folder would leave a mixture of both.
    const std::string first = readText(box / "film/frame_000000.png");
    outcome = box.vkdose("render run --movie film --size 80x60");
    CHECK(outcome.code == kOutputError);
    CHECK_THAT(outcome.err, Catch::Contains("film holds frame_00000") && Catch::Contains("name another folder"));
    CHECK(readText(box / "film/frame_000000.png") == first);

    standIn(box, "echo 'no such codec' >&2; exit 1");
    outcome = box.vkdose("render run --movie film.mp4 --size 160x120", path);
    CHECK(outcome.code == kOutputError);
    CHECK_THAT(outcome.err, Catch::Contains("ffmpeg could not write film.mp4: no such codec"));
    box.write("bin/ffmpeg", "#!/bin/sh\necho 'no room' >&2; exit 1\n");  // without taking a single picture
    outcome = box.vkdose("render run --movie film.mp4 --size 320x240", path);
    CHECK(outcome.code == kOutputError);
    CHECK_THAT(outcome.err, Catch::Contains("no room"));
    outcome = box.vkdose("render run --movie film.mp4 --size 160x120", "PATH=/nowhere; export PATH; ");
    CHECK(outcome.code == kBadInput);
    CHECK_THAT(outcome.err, Catch::Contains("install it (Debian: ffmpeg)"));
    CHECK(box.vkdose("render run --movie film.mp4 --size 161x120", path).code == kBadInput);  // an odd width
}

TEST_CASE("render: a film that players understand") {
    if (std::system("command -v ffmpeg ffprobe > /dev/null") != 0) {
        WARN("skipped: ffmpeg is not installed (tools/packages-film)");
        return;
    }
    const Sandbox box;
    writeFrames(box);
    CHECK(box.vkdose("render run --movie film.mp4 --size 160x120 --rate 5").code == kOk);
    const std::string probe =
        "ffprobe -v error -count_frames -select_streams v -show_entries "
        "stream=width,height,nb_read_frames,r_frame_rate -of csv=p=0 '" +
        (box / "film.mp4").string() + "' > '" + (box / "probe.txt").string() + "'";
    REQUIRE(std::system(probe.c_str()) == 0);
    CHECK(readText(box / "probe.txt") == "160,120,5/1,9\n");
}
