// An interrupted run goes on as if nothing had happened, whatever interrupted it.

#include <fmt/format.h>

#include <algorithm>
#include <future>

#include "host/core/csv_table.h"
#include "host/vk/device_info.h"
#include "tests/app/cut_runs.h"
#include "tests/support/records.h"

using namespace vkdose;
using namespace vkdose::test;

TEST_CASE("killed again and again at random moments, a run ends with the same bits") {
    const std::string backend = GENERATE(std::string("reference"), std::string("vulkan"));
    const Sandbox box;
    REQUIRE(box.vkdose("run " + words(kDoses) + "--out whole --backend " + backend).code == 0);

    const int kills = killedUntilItEnds(box, kDoses, backend, 3);
    CAPTURE(backend);
    CHECK(kills >= 3);
    checkSame(box / "whole", box / "cut");
}

TEST_CASE("killed at random moments, a run that settles until at rest and doses to a mass ends with the same bits",
          "[slow]") {
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
    const auto summary = timelessSummary(box / "whole/summary.json");
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
    CHECK(timelessSummary(box / "whole/summary.json") == timelessSummary(box / "cut/summary.json"));
}

TEST_CASE("a run that is killed before its first checkpoint is told the way on") {
    const Sandbox box;
    const auto killedAt = [&](const char* file, const char* settle) {
        const pid_t child = box.start({"run", VKDOSE_SOURCE_DIR "/cases/mini.toml", "--backend", "reference", "--quiet",
                                       "--set", "checkpoint.wall_s=0", "--set", settle, "--set", "stop.max_doses=100",
                                       "--out", "cut", "--force"});
        int status = 0;
        while (!fs::exists(box / "cut" / file)) {
            REQUIRE(waitpid(child, &status, WNOHANG) == 0);
            std::this_thread::yield();
        }
        kill(child, SIGKILL);
        waitpid(child, &status, 0);
    };
    killedAt("doses.csv", "settle.time_s=1000");
    const auto early = box.vkdose("resume cut");
    CHECK(early.code == 2);
    CHECK_THAT(early.err, Catch::Contains("no checkpoint (checkpoint.h5)") &&
                              Catch::Contains("start again with `vkdose run cut/case.toml --out cut --force`"));
    killedAt("settled.h5", "settle.time_s=0.01");
    const auto settled = box.vkdose("resume cut");
    CHECK(settled.code == 2);
    CHECK_THAT(settled.err, Catch::Contains("no checkpoint (checkpoint.h5)") &&
                                Catch::Contains("`vkdose run --from cut --out DIR`"));
    CHECK(box.vkdose("run --from cut --out DIR --quiet --set stop.max_doses=1").code == 0);
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

TEST_CASE("a run that a stop rule ended goes on with another rule, as if that had been the first") {
    const std::string backend = GENERATE(std::string("reference"), std::string("vulkan"));
    const bool byTime = GENERATE(false, true);
    CAPTURE(backend, byTime);
    const Sandbox box;
    const std::string run = "run " + words(kDoses) + "--set frames.interval_s=0 --backend " + backend + " ";
    REQUIRE(box.vkdose(run + "--out whole").code == 0);
    // The end time is that of a reading in the second dose, and a little more: the run ends at the nearest step.
    const Table readings = Table::salvage(box / "whole/timeseries.csv");
    std::size_t row = 0;
    while (readings.number(row, "dose") < 2) ++row;
    const std::string rule = byTime
                                 ? fmt::format("--set stop.end_time_s={} ", readings.number(row + 3, "time_s") + 3e-6)
                                 : "--set stop.max_doses=1 ";
    REQUIRE(box.vkdose(run + rule + "--out cut").code == 0);
    REQUIRE(readText(box / "cut/doses.csv") != readText(box / "whole/doses.csv"));
    const auto plain = box.vkdose("resume cut");
    CHECK(plain.code == 2);
    CHECK_THAT(plain.err, Catch::Contains("is over") && Catch::Contains("--set stop.max_doses="));
    const auto same = box.vkdose("resume cut " + rule);
    CAPTURE(same.err);
    CHECK(same.code == 2);
    CHECK_THAT(same.err, Catch::Contains(byTime ? "is over" : "would end the run where it ended: the dose asked for"));
    CHECK(box.vkdose("resume cut --set checkpoint.time_s=1").code == 2);  // that ended nothing
    const auto on = box.vkdose("resume cut --set stop.max_doses=2 --set stop.end_time_s=100");
    CAPTURE(on.err);
    REQUIRE(on.code == 0);
    for (const char* name : {"timeseries.csv", "doses.csv", "particles.csv"})
        CHECK(readText(box / "cut" / name) == readText(box / "whole" / name));
    CHECK(timelessSummary(box / "cut/summary.json") == timelessSummary(box / "whole/summary.json"));
    CHECK(box.vkdose("resume cut --set stop.max_doses=2").code == 2);
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

TEST_CASE("a run goes on where an update has given its device another version") {
    const Sandbox box;
    // A parent that is gone interrupts at once.
    REQUIRE(box.vkdose("run " + words(kDoses) + "--out cut --parent 999999").code == 130);
    const std::string device = readCheckpoint(box / "cut" / kCheckpointName).backend;
    if (device.find("llvmpipe") == std::string::npos) {
        WARN("skipped: only lavapipe's name can be changed");
        return;
    }
    // The length of its vectors is a part of lavapipe's name.
    const auto on = box.vkdose("resume cut", "LP_NATIVE_VECTOR_WIDTH=128 ");
    CAPTURE(on.err);
    CHECK(on.code == 0);
    CHECK_THAT(on.err, Catch::Contains("not bound to give the same bits") && Catch::Contains("128 bits"));
}

TEST_CASE("the device of a run that goes on is the one of its name, or the one of its model") {
    std::vector<vk::DeviceInfo> devices;
    for (const char* name : {"Radeon 7 (LLVM 15)", "llvmpipe (LLVM 19, 256 bits)", "Radeon 7 (ACO)", "Graphics"}) {
        devices.emplace_back();
        devices.back().index = static_cast<int>(devices.size()) - 1;
        devices.back().name = name;
        devices.back().usable = true;
    }
    CHECK(vk::chooseAgain(devices, "Radeon 7 (ACO)").index == 2);
    CHECK(vk::chooseAgain(devices, "Graphics").index == 3);
    CHECK(vk::chooseAgain(devices, "llvmpipe (LLVM 15, 256 bits)").index == 1);
    devices[2].usable = false;
    CHECK(vk::chooseAgain(devices, "Radeon 7 (ACO)").index == 0);
    for (const char* gone : {"Radeon 77 (ACO)", "Radeon", "llvm", "1", ""})
        CHECK_THROWS_WITH(vk::chooseAgain(devices, gone), Catch::Contains("name one with --device"));
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
