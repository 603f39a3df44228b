// An interrupted run goes on as if nothing had happened, whatever interrupted it.

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <future>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "host/output/checkpoint.h"
#include "host/output/frames.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"
#include "tests/support/records.h"

using namespace vkdose;
using namespace vkdose::test;
namespace fs = std::filesystem;

namespace {

const std::vector<std::string> kDoses{VKDOSE_SOURCE_DIR "/cases/mini.toml",
                                      "--quiet",
                                      "--set",
                                      "settle.time_s=0.03",
                                      "--set",
                                      "dose.rotate_s=0.08",
                                      "--set",
                                      "dose.rest_s=0.01",
                                      "--set",
                                      "stop.max_doses=2",
                                      "--set",
                                      "checkpoint.time_s=0.006",
                                      "--set",
                                      "sensors.energy=true",
                                      "--set",
                                      "frames.interval_s=0.02",
                                      "--set",
                                      "frames.contacts=true",
                                      "--set",
                                      "field=[{preset=\"outlet\"}, {preset=\"height-profile\", average=true, "
                                      "interval_s=0.02}, {preset=\"mid-plane\", average=true, stress=true}]"};

std::string words(const std::vector<std::string>& list) {
    std::string text;
    for (const std::string& word : list) text += "'" + word + "' ";
    return text;
}

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// The summary without what depends on the clock.
nlohmann::json timeless(const fs::path& file) {
    auto summary = nlohmann::json::parse(readText(file));
    summary.erase("particle_steps_per_second");
    summary.erase("stepping_wall_time_s");
    return summary;
}

void checkSame(const fs::path& a, const fs::path& b) {
    for (const char* name : {"case.toml", "timeseries.csv", "doses.csv", "particles.csv"}) {
        CAPTURE(name);
        CHECK(!readText(a / name).empty());
        CHECK(readText(a / name) == readText(b / name));
    }
    const std::vector<FrameEntry> frames = Frames(a).entries();
    CHECK(frames.size() > 5);
    CHECK(readText(a / "frames/frames.csv") == readText(b / "frames/frames.csv"));
    for (const FrameEntry& e : frames)
        for (const char* kind : {kParticlesFrame, kContactsFrame}) {
            const fs::path file = fs::path("frames") / frameFile(kind, e.number);
            CAPTURE(file);
            CHECK(!readText(a / file).empty());
            CHECK(readText(a / file) == readText(b / file));
        }
    CHECK_FALSE(fs::exists(b / "frames" / frameFile(kParticlesFrame, int(frames.size()))));
    std::size_t fields = 0;
    for (const auto& entry : fs::directory_iterator(a / "fields")) {
        CAPTURE(entry.path());
        CHECK(readText(entry.path()) == readText(b / "fields" / entry.path().filename()));
        ++fields;
    }
    CHECK(fields > 5);  // three, and the maps of the mid-plane
    CHECK(timeless(a / "summary.json") == timeless(b / "summary.json"));
    CHECK_FALSE(fs::exists(b / kCheckpointName));
}

/// Tells one checkpoint from the next: file number and time of writing [ns]; zeros while there is none.
std::array<std::int64_t, 2> identity(const fs::path& file) {
    struct stat info {};
    if (stat(file.c_str(), &info) != 0) return {};
    return {std::int64_t(info.st_ino), std::int64_t(info.st_mtim.tv_sec) * 1000000000 + info.st_mtim.tv_nsec};
}

/// Lets a child write `checkpoints` checkpoints, counts to `spins`, then ends it with `signal`. Its exit status.
int endAfter(pid_t child, const fs::path& file, int checkpoints, int spins, int signal) {
    int status = 0;
    auto last = identity(file);
    while (checkpoints > 0) {
        if (waitpid(child, &status, WNOHANG) == child) return status;
        const auto now = identity(file);
        if (now[0] != 0 && now != last) {
            last = now;
            --checkpoints;
        }
        std::this_thread::yield();
    }
    for (int i = 0; i < spins; ++i) std::atomic_signal_fence(std::memory_order_seq_cst);  // kept by the compiler
    kill(child, signal);
    waitpid(child, &status, 0);
    return status;
}

/// Runs a case into the folder "cut", kills it at random moments and resumes it until it ends well. Counts the kills.
int killedUntilItEnds(const Sandbox& box, const std::vector<std::string>& options, const std::string& backend,
                      unsigned seed) {
    std::mt19937 random(seed);
    const fs::path file = box / "cut" / kCheckpointName;
    pid_t child = box.start(joined({"run", "--backend", backend, "--out", "cut"}, options));
    for (int kills = 0;; ++kills) {
        const int status = endAfter(child, file, 1 + int(random() % 8), int(random() % 5000000), SIGKILL);
        if (WIFEXITED(status)) {
            CHECK(WEXITSTATUS(status) == 0);
            return kills;
        }
        child = box.start({"resume", "--quiet", "cut"});
    }
}

/// A finished checkpoint of a run of a few hundred steps, to be spoilt.
fs::path interrupted(const Sandbox& box) {
    const pid_t child = box.start(joined({"run", "--backend", "reference", "--out", "out"}, kDoses));
    endAfter(child, box / "out" / kCheckpointName, 2, 0, SIGKILL);
    return box / "out" / kCheckpointName;
}

}  // namespace

TEST_CASE("killed again and again at random moments, a run ends with the same bits") {
    const std::string backend = GENERATE(std::string("reference"), std::string("vulkan"));
    const Sandbox box;
    REQUIRE(box.vkdose("run " + words(kDoses) + "--out whole --backend " + backend).code == 0);

    const int kills = killedUntilItEnds(box, kDoses, backend, 3);
    CAPTURE(backend);
    CHECK(kills >= 3);
    checkSame(box / "whole", box / "cut");
}

TEST_CASE("killed at random moments, a run that settles until at rest and doses to a mass ends with the same bits") {
    const std::string backend = GENERATE(std::string("reference"), std::string("vulkan"));
    // Nearly as slow as the fall is slow enough, so that settling ends early; the mass is a sphere's.
    std::vector<std::string> options{VKDOSE_SOURCE_DIR "/cases/mini.toml", "--quiet"};
    for (const char* key : {"settle.until_rest=true", "settle.rest_speed_ratio=0.99", "settle.time_s=0.4",
                            "dose.mass_g=0.001", "dose.max_rotate_s=0.4", "dose.ramp_s=0.01", "dose.reverse_turns=0.1",
                            "dose.rest_s=0.01", "dose.stage=[{speed_rpm=240.0, until=0.5}]", "dose.max_torque_mNm=100",
                            "stop.max_doses=1", "checkpoint.time_s=0.005"}) {
        options.emplace_back("--set");
        options.emplace_back(key);
    }
    const Sandbox box;
    const auto o = box.vkdose("run " + words(options) + "--out whole --backend " + backend);
    CAPTURE(backend, o.err);
    REQUIRE(o.code == 0);
    const auto summary = timeless(box / "whole/summary.json");
    CHECK(summary["settling"]["at_rest"] == true);
    CHECK(summary["settling"]["time_s"].get<double>() < 0.2);
    REQUIRE(summary["doses"].size() == 1);
    CHECK(summary["doses"][0]["stopped_by"] == "mass");
    CHECK(summary["doses"][0]["stop_mass_kg"].get<double>() >= 1e-6);
    CHECK(summary["doses"][0]["rotation_s"].get<double>() < 0.38);

    const int kills = killedUntilItEnds(box, options, backend, 5);
    CHECK(kills >= 3);
    for (const char* name : {"case.toml", "timeseries.csv", "doses.csv", "particles.csv"}) {
        CAPTURE(name);
        CHECK(!readText(box / "whole" / name).empty());
        CHECK(readText(box / "whole" / name) == readText(box / "cut" / name));
    }
    CHECK(timeless(box / "whole/summary.json") == timeless(box / "cut/summary.json"));
}

TEST_CASE("after Ctrl-C or the closing of its terminal a run can be resumed, to the same bits") {
    const int signal = GENERATE(SIGINT, SIGHUP);
    CAPTURE(signal);
    const Sandbox box;
    REQUIRE(box.vkdose("run " + words(kDoses) + "--out whole --backend reference").code == 0);
    const pid_t child = box.start(joined({"run", "--backend", "reference", "--out", "cut"}, kDoses));
    const int status = endAfter(child, box / "cut" / kCheckpointName, 20, 0, signal);
    REQUIRE(WEXITSTATUS(status) == 130);
    const auto early = box.vkdose("run " + words(kDoses) + "--out cut --backend reference");
    CHECK(early.code == 2);
    CHECK_THAT(early.err, Catch::Contains("vkdose resume cut"));
    const auto on = box.vkdose("resume cut");
    CAPTURE(on.err);
    CHECK(on.code == 0);
    checkSame(box / "whole", box / "cut");
    const auto over = box.vkdose("resume cut");
    CHECK(over.code == 2);
    CHECK_THAT(over.err, Catch::Contains("over"));
}

TEST_CASE("interrupted before it makes a step, a resumed run still ends with the same bits") {
    const std::string backend = GENERATE(std::string("reference"), std::string("vulkan"));
    const Sandbox box;
    REQUIRE(box.vkdose("run " + words(kDoses) + "--out whole --backend " + backend).code == 0);
    const pid_t child = box.start(joined({"run", "--backend", backend, "--out", "cut"}, kDoses));
    REQUIRE(WIFSIGNALED(endAfter(child, box / "cut" / kCheckpointName, 8, 0, SIGKILL)));
    const Checkpoint before = readCheckpoint(box / "cut" / kCheckpointName);
    // A parent that is gone interrupts as Ctrl-C would, before anything is computed.
    REQUIRE(box.vkdose("resume cut --quiet --parent 999999").code == 130);
    const Checkpoint after = readCheckpoint(box / "cut" / kCheckpointName);
    CAPTURE(backend);
    CHECK(after.time == before.time);
    checkSameArrays(before.run.run, after.run.run);
    checkSameArrays(before.run.backend, after.run.backend);
    const auto on = box.vkdose("resume cut");
    CAPTURE(on.err);
    CHECK(on.code == 0);
    checkSame(box / "whole", box / "cut");
}

TEST_CASE("the bits do not depend on the number of driver threads") {
    const Sandbox box;
    for (const std::string threads : {"0", "1", "3"}) {
        const auto o = box.vkdose("run " + words(kDoses) + "--out " + threads, "LP_NUM_THREADS=" + threads + " ");
        CAPTURE(o.err);
        REQUIRE(o.code == 0);
    }
    checkSame(box / "0", box / "1");
    checkSame(box / "0", box / "3");
}

TEST_CASE("a full disk ends the run with a message and leaves the last good checkpoint") {
    const Sandbox box;
    // The limit on the size of a file stands in for the end of the disk: enough for checkpoints, not for the series.
    const std::string many = "--set sensors.interval_s=0.0001 --backend reference ";
    REQUIRE(box.vkdose("run " + words(kDoses) + many + "--out whole").code == 0);
    const auto series = fs::file_size(box / "whole/timeseries.csv");
    REQUIRE(series > 150UL * 1024);
    const auto full = box.vkdose("run " + words(kDoses) + many + "--out cut", "ulimit -f 240; ");  // 120 KiB
    CAPTURE(full.err);
    CHECK(full.code == 5);
    CHECK_THAT(full.err, Catch::Contains("timeseries.csv: File too large") && Catch::Contains("vkdose resume cut"));
    const auto on = box.vkdose("resume cut");
    CAPTURE(on.err);
    CHECK(on.code == 0);
    checkSame(box / "whole", box / "cut");

    const std::string unseen = "--set frames.interval_s=0 --backend reference --out ";
    const auto none = box.vkdose("run " + words(kDoses) + unseen + "none", "ulimit -f 20; ");
    CHECK(none.code == 5);
    CHECK_THAT(none.err, Catch::Contains("checkpoint.h5: File too large") && Catch::Contains("no checkpoint"));
    CHECK(fs::exists(box / "none/timeseries.csv"));
    CHECK_FALSE(fs::exists(box / "none/checkpoint.h5.new"));

    // Frames are written while the run goes on, but what happens to them is told all the same.
    const auto frame = box.vkdose("run " + words(kDoses) + "--backend reference --out frame", "ulimit -f 20; ");
    CHECK(frame.code == 5);
    CHECK_THAT(frame.err, Catch::Contains("frames/walls.hdf: File too large"));
    CHECK_FALSE(fs::exists(box / "frame/frames/walls.hdf.new"));
}

TEST_CASE("a checkpoint that cannot be used is refused by name") {
    const Sandbox box;
    const fs::path file = interrupted(box);
    const std::string good = readText(file);
    const auto refused = [&](const std::string& content, const std::string& why) {
        box.write("out/checkpoint.h5", content);
        const auto o = box.vkdose("resume out");
        CAPTURE(o.err);
        CHECK(o.code == 2);
        CHECK_THAT(o.err, Catch::Contains("out/checkpoint.h5") && Catch::Contains(why));
    };
    refused("", "not a checkpoint of vkdose");
    refused("name = \"mini\"\n", "not a checkpoint of vkdose");
    refused(good.substr(512), "not a checkpoint of vkdose");
    refused(good.substr(0, good.size() / 2), "cut off");
    refused(good + "x", "damaged");
    std::string later = good;
    later.replace(good.find("version 6"), 9, "version 7");
    refused(later, "format version 7");
    const auto missing = box.vkdose("resume nowhere");
    CHECK(missing.code == 2);
    CHECK_THAT(missing.err, Catch::Contains("nowhere/checkpoint.h5"));

    box.write("out/checkpoint.h5", good);
    box.write("out/timeseries.csv", "time_s\n");
    const auto shorter = box.vkdose("resume out");
    CHECK(shorter.code == 2);
    CHECK_THAT(shorter.err, Catch::Contains("timeseries.csv"));
}

TEST_CASE("no cut and no flipped bit of a checkpoint goes unnoticed") {
    const Sandbox box;
    const fs::path file = interrupted(box);
    REQUIRE_NOTHROW(readCheckpoint(file));
    const std::string good = readText(file);
    std::mt19937 random(8);
    for (int i = 0; i < 150; ++i) {
        const std::size_t length = random() % good.size();
        box.write("out/checkpoint.h5", good.substr(0, length));
        CAPTURE(length);
        CHECK_THROWS_AS(readCheckpoint(file), CheckpointError);
    }
    // Behind the text of the head its block is empty: what stands there is nobody's.
    const std::size_t text = good.find('\0');
    for (int i = 0; i < 150; ++i) {
        std::size_t at = random() % good.size();
        if (i % 3 == 0) at = random() % text;
        if (at >= text && at < 512) continue;
        std::string bad = good;
        bad[at] = char(bad[at] ^ (1 << random() % 8));
        box.write("out/checkpoint.h5", bad);
        CAPTURE(at);
        CHECK_THROWS_AS(readCheckpoint(file), CheckpointError);
    }
}

TEST_CASE("what has been changed before the checkpoint's mark is refused by name, and left as it is") {
    const Sandbox box;
    interrupted(box);
    for (const std::string name : {"timeseries.csv", "doses.csv", "frames/frames.csv", "fields/outlet.csv"}) {
        const std::string good = readText(box / "out" / name);
        const std::size_t line = good.find('\n') + 1;
        std::string bad = good;
        SECTION(name + ": a byte more") {
            bad.insert(line - 1, "0");
        }
        SECTION(name + ": another byte") {
            bad[line - 2] ^= 1;
        }
        if (bad == good) continue;
        box.write("out/" + name, bad);
        const auto o = box.vkdose("resume out");
        CAPTURE(o.err);
        CHECK(o.code == 2);
        CHECK_THAT(o.err, Catch::Contains("out/" + name));
        CHECK(readText(box / "out" / name) == bad);
    }
}

TEST_CASE("a run goes on with the case it began with, and its case.toml says no other") {
    const Sandbox box;
    const fs::path file = interrupted(box);
    const std::string good = readText(box / "out/case.toml"), checkpoint = readText(file);
    std::string bad = good;
    SECTION("another value") {
        bad.replace(bad.find("max_doses = 2"), 13, "max_doses = 1");
    }
    SECTION("no case") {
        bad = "max_doses";
    }
    SECTION("the same in other words") {
        bad = "# mine\n" + good;
    }
    SECTION("gone") {
        bad = "";
    }
    box.write("out/case.toml", bad);
    if (bad.empty()) fs::remove(box / "out/case.toml");
    const auto o = box.vkdose("resume out --quiet --parent 999999");
    CAPTURE(o.err);
    if (bad.empty() || bad[0] == '#') {
        CHECK(o.code == 130);
        CHECK(readText(box / "out/case.toml") == (bad.empty() ? good : bad));
    } else {
        CHECK(o.code == 2);
        CHECK_THAT(o.err, Catch::Contains("out/case.toml has been changed"));
        CHECK(readText(box / "out/case.toml") == bad);
        CHECK(readText(file) == checkpoint);
    }
}

TEST_CASE("a run whose folder or file is taken away ends, and says what is missing") {
    const Sandbox box;
    auto run = std::async(std::launch::async, [&] {
        return box.vkdose("run '" VKDOSE_SOURCE_DIR
                          "/cases/mini.toml' --backend reference --out out --quiet --set "
                          "settle.time_s=0.1 --set dose.rotate_s=0.1 --set stop.max_doses=1");
    });
    const auto ended = [&] { return run.wait_for(std::chrono::seconds(0)) == std::future_status::ready; };
    while (!ended() && readCsv(box / "out/timeseries.csv").size() < 2) std::this_thread::yield();
    SECTION("moved") {
        fs::rename(box / "out", box / "elsewhere");
    }
    SECTION("removed") {
        fs::remove_all(box / "out");
    }
    SECTION("replaced") {
        fs::rename(box / "out", box / "elsewhere");
        fs::copy(box / "elsewhere", box / "out", fs::copy_options::recursive);
    }
    SECTION("without its time series") {
        fs::remove(box / "out/timeseries.csv");
    }
    const auto o = run.get();
    CAPTURE(o.err);
    CHECK(o.code == 5);
    CHECK_THAT(o.err, Catch::Contains("cannot write out/"));
}

TEST_CASE("two runs do not write into one folder") {
    const Sandbox box;
    const pid_t child =
        box.start(joined({"run", "--backend", "reference", "--out", "out", "--set", "settle.time_s=1000"}, kDoses));
    int status = 0;
    while (identity(box / "out" / kCheckpointName)[0] == 0 && waitpid(child, &status, WNOHANG) == 0)
        std::this_thread::yield();
    for (const std::string& command : {std::string("resume out"), "run --force --out out " + words(kDoses)}) {
        const auto o = box.vkdose(command);
        CAPTURE(o.err);
        CHECK(o.code == 2);
        CHECK_THAT(o.err, Catch::Contains("another vkdose is writing into out"));
    }
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
}
