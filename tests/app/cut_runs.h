#pragma once
// Runs that are cut short, and what they must leave.

#include <sys/stat.h>
#include <sys/wait.h>

#include <array>
#include <atomic>
#include <csignal>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "host/output/checkpoint.h"
#include "host/output/frames.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"
#include "tests/support/folder.h"

namespace vkdose::test {

namespace fs = std::filesystem;

inline const std::vector<std::string> kDoses{VKDOSE_SOURCE_DIR "/cases/mini.toml",
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

inline std::string words(const std::vector<std::string>& list) {
    std::string text;
    for (const std::string& word : list) text += "'" + word + "' ";
    return text;
}

inline std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// The summary without what depends on the clock.
inline nlohmann::json timelessSummary(const fs::path& file) {
    auto summary = nlohmann::json::parse(readText(file));
    summary.erase("particle_steps_per_second");
    summary.erase("stepping_wall_time_s");
    return summary;
}

inline void checkSame(const fs::path& a, const fs::path& b) {
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
    CHECK(timelessSummary(a / "summary.json") == timelessSummary(b / "summary.json"));
    CHECK_FALSE(fs::exists(b / kCheckpointName));
}

/// Tells one checkpoint from the next: file number and time of writing [ns]; zeros while there is none.
inline std::array<std::int64_t, 2> identity(const fs::path& file) {
    struct stat info {};
    if (stat(file.c_str(), &info) != 0) return {};
    return {std::int64_t(info.st_ino), std::int64_t(info.st_mtim.tv_sec) * 1000000000 + info.st_mtim.tv_nsec};
}

/// Lets a child write `checkpoints` checkpoints, counts to `spins`, then ends it with `signal`. Its exit status.
inline int endAfter(pid_t child, const fs::path& file, int checkpoints, int spins, int signal) {
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
inline int killedUntilItEnds(const Sandbox& box, const std::vector<std::string>& options, const std::string& backend,
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
inline fs::path interrupted(const Sandbox& box) {
    const pid_t child = box.start(joined({"run", "--backend", "reference", "--out", "out"}, kDoses));
    endAfter(child, box / "out" / kCheckpointName, 2, 0, SIGKILL);
    return box / "out" / kCheckpointName;
}

}  // namespace vkdose::test
