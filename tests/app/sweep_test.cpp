// `vkdose sweep` as a user meets it: real members, killed, interrupted and failing ones.

#include <fmt/format.h>
#include <sys/types.h>

#include <algorithm>
#include <csignal>
#include <thread>

#include "host/core/csv_table.h"
#include "host/output/checkpoint.h"
#include "tests/app/sandbox.h"
#include "tests/app/sweep_tables.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;
namespace fs = std::filesystem;

namespace {

/// Two cohesions and two frictions of the mini canister, cut to a few thousand steps; many checkpoints.
const std::string kStudy = R"(base = ")" VKDOSE_SOURCE_DIR R"(/cases/mini.toml"
[set]
"stop.max_doses" = 2
settle.time_s = 0.03
dose.rotate_s = 0.08
dose.rest_s = 0.01
checkpoint.time_s = 0.006
[[axis]]
key = "contact.kc_over_k"
values = [0.2, 0.5]
[[axis]]
key = "contact.friction"
values = [0.2, 0.4]
)";

const std::vector<std::string> kSweep{"sweep", "study.toml", "--backend", "reference", "--jobs", "2", "--out", "cut"};

/// Waits until the member has a checkpoint or is over; false if the sweep ended first.
bool reached(pid_t sweep, const fs::path& member) {
    int status = 0;
    while (!fs::exists(member / kCheckpointName) && !fs::exists(member / "summary.json")) {
        if (waitpid(sweep, &status, WNOHANG) == sweep) return false;
        std::this_thread::yield();
    }
    return true;
}

}  // namespace

TEST_CASE("a sweep that is killed again and again ends with the rows of one that is not") {
    const Sandbox box;
    box.write("study.toml", kStudy);
    const auto whole = box.vkdose("sweep study.toml --backend reference --jobs 2 --out whole");
    CAPTURE(whole.err);
    REQUIRE(whole.code == 0);
    REQUIRE(timeless(box / "whole").size() == 4);
    int kills = 0;
    for (const char* member : {"cut/members/0000", "cut/members/0001", "cut/members/0003"}) {
        const pid_t sweep = box.start(kSweep);
        if (!reached(sweep, box / member)) continue;
        kill(sweep, SIGKILL);
        waitpid(sweep, nullptr, 0);
        ++kills;
    }
    CHECK(kills == 3);
    const auto on = box.vkdose("sweep study.toml --backend reference --jobs 2 --out cut");
    CAPTURE(on.err);
    CHECK(on.code == 0);
    CHECK(timeless(box / "cut") == timeless(box / "whole"));
    CHECK(readText(box / "cut/doses.csv") == readText(box / "whole/doses.csv"));
    CHECK(readText(box / "cut/figures.csv") == readText(box / "whole/figures.csv"));
    CHECK(readText(box / "cut/members/0002/timeseries.csv") == readText(box / "whole/members/0002/timeseries.csv"));
}

TEST_CASE("after Ctrl-C or the closing of its terminal a sweep goes on to the same rows", "[slow]") {
    const int signal = GENERATE(SIGINT, SIGHUP);
    CAPTURE(signal);
    const Sandbox box;
    box.write("study.toml", kStudy);
    REQUIRE(box.vkdose("sweep study.toml --backend reference --quiet --out whole").code == 0);
    const pid_t sweep = box.start(kSweep);
    REQUIRE(reached(sweep, box / "cut/members/0001"));
    kill(sweep, signal);
    int status = 0;
    waitpid(sweep, &status, 0);
    CHECK(WEXITSTATUS(status) == 130);
    const auto rows = timeless(box / "cut");
    CHECK(std::any_of(rows.begin(), rows.end(), [](const Row& row) { return row[4] == "interrupted"; }));
    const auto on = box.vkdose("sweep study.toml --backend reference --out cut");
    CAPTURE(on.err);
    CHECK(on.code == 0);
    CHECK(timeless(box / "cut") == timeless(box / "whole"));
    CHECK(readText(box / "cut/doses.csv") == readText(box / "whole/doses.csv"));
}

TEST_CASE("a member whose checkpoint is of another version is started anew when failed members are run again") {
    const Sandbox box;
    box.write("study.toml", kStudy);
    REQUIRE(box.vkdose("sweep study.toml --backend reference --quiet --out whole").code == 0);
    const pid_t sweep = box.start(kSweep);
    const std::string file = "cut/members/0001/checkpoint.h5";
    REQUIRE(reached(sweep, box / "cut/members/0001"));
    kill(sweep, SIGINT);
    waitpid(sweep, nullptr, 0);
    std::string older = readText(box / file);
    REQUIRE(older.find("version 7") != std::string::npos);
    box.write(file, older.replace(older.find("version 7"), 9, "version 3"));
    const auto refused = box.vkdose("sweep study.toml --backend reference --out cut");
    CHECK(refused.code == 1);
    CHECK_THAT(refused.err, Catch::Contains("version 3") && Catch::Contains("--retry-failed"));
    CHECK(readText(box / file) == older);  // the version that wrote it may go on with it
    const auto anew = box.vkdose("sweep study.toml --backend reference --retry-failed --out cut");
    CAPTURE(anew.err);
    CHECK(anew.code == 0);
    CHECK_THAT(anew.err, Catch::Contains("member 0001 starts anew") && Catch::Contains("version 3"));
    CHECK(timeless(box / "cut") == timeless(box / "whole"));
    CHECK(readText(box / "cut/doses.csv") == readText(box / "whole/doses.csv"));
}

TEST_CASE("a member that fails is told, the rest go on, and the exit code says so") {
    const Sandbox box;
    std::string study = kStudy;
    study.replace(study.find("contact.friction"), 16, "contact.max_overlap_ratio");
    study.replace(study.find("[0.2, 0.4]"), 10, "[0.2, 1e-9]");
    box.write("study.toml", study);
    const auto o = box.vkdose("sweep study.toml");
    CAPTURE(o.out, o.err);
    CHECK(o.code == 1);
    CHECK_THAT(o.err, Catch::Contains("member 0001") && Catch::Contains("member 0003") &&
                          Catch::Contains("--retry-failed") && Catch::Contains("overlap"));
    const Table table = Table::salvage(box / "out/study/members.csv");
    REQUIRE(table.rows() == 4);
    for (int i = 0; i < 4; ++i) {
        CHECK(table.text(i, "status") == (i % 2 == 0 ? "ok" : "failed"));
        CHECK(table.text(i, "error").empty() == (i % 2 == 0));
    }
    CHECK_THAT(o.out, Catch::Contains("2 done, 2 failed"));
    const Table figures = Table::read(box / "out/study/figures.csv");
    CHECK(figures.column("member") == std::vector<double>{0, 2});
}

TEST_CASE("a dry run prints the members, a faulty study is refused, neither writes anything") {
    const Sandbox box;
    box.write("study.toml", kStudy);
    const auto dry = box.vkdose("sweep study.toml --dry-run");
    CHECK(dry.code == 0);
    CHECK_THAT(dry.out, Catch::Contains("member 0003") && Catch::Contains("contact.friction 0.4, seed 1") &&
                            Catch::Contains("4 members"));
    // More places than members do not make it shorter.
    const auto told = [&](const std::string& jobs) {
        const std::string out = box.vkdose("sweep study.toml --dry-run --assume --jobs " + jobs).out;
        const std::size_t at = out.find("run time");
        return out.substr(at, out.find(',', at) - at);
    };
    CHECK_THAT(told("4"), Catch::Contains("with 4 at a time"));
    CHECK(told("400") == told("4"));
    std::string faulty = kStudy;
    faulty.replace(faulty.find("[0.2, 0.4]"), 10, "[0.2, -0.4]");
    box.write("study.toml", faulty);
    for (const char* option : {"", "--dry-run"}) {
        const auto o = box.vkdose(std::string("sweep study.toml ") + option);
        CHECK(o.code == 2);
        CHECK_THAT(o.err, Catch::Contains("study.toml:13: contact.friction = -0.4: is negative"));
    }
    CHECK(box.files() == std::vector<std::string>{"study.toml"});
}

TEST_CASE("a dry run of a calibration tells the members that it begins with, and how many there may be") {
    const Sandbox box;
    const std::string cut = kStudy.substr(0, kStudy.find("[[axis]]"));
    const auto search = [&](const std::string& keys) {
        box.write("study.toml",
                  cut + "[calibrate]\nmethod = \"surrogate\"\ntarget_g_per_dose = 0.02\ntolerance_g = 0.01\n" + keys +
                      "[[calibrate.parameter]]\nkey = \"contact.kc_over_k\"\nlow = 0.1\nhigh = 0.6\n");
        return box.vkdose("calibrate study.toml --dry-run --assume --jobs 2").out;
    };
    // Three points first. Each of the two others may be a confirmation that missed, and one more may follow.
    const std::string few = search("max_runs = 5\n");
    CHECK_THAT(few, Catch::Contains("member 0002") && !Catch::Contains("member 0003"));
    CHECK_THAT(few, Catch::Contains("up to 9 more members at 2 more points and in confirming runs: at most ") &&
                        Catch::Contains("study: at most 12 members, at most ") && Catch::Contains("run time at most "));
    CHECK_THAT(search("max_runs = 5\nconfirming_seeds = 7\n"), Catch::Contains("at most 24 members"));
    box.write("study.toml", "seeds = [1]\n" + kStudy + "[calibrate]\ntarget_g_per_dose = 1\ntolerance_g = 0.1\n");
    const auto grid = box.vkdose("calibrate study.toml --dry-run --assume");
    CHECK_THAT(grid.out, Catch::Contains("member 0003") && Catch::Contains("up to 3 more members in confirming runs") &&
                             Catch::Contains("at most 7 members"));
    CHECK(box.files() == std::vector<std::string>{"study.toml"});
}

TEST_CASE("calibrate interpolates a finished sweep without running it again, and writes a case that runs") {
    const Sandbox box;
    // One curve, so that there is nothing to choose.
    const std::string friction = "values = [0.2, 0.4]";
    std::string study = "seeds = [1]\n" + kStudy;
    study.replace(study.find(friction), friction.size(), "values = [0.2]");
    box.write("study.toml", study);
    REQUIRE(box.vkdose("sweep study.toml --backend reference --out out").code == 0);
    const Table table = Table::salvage(box / "out/members.csv");
    const auto beta = [&](int member) { return table.number(std::size_t(member), "beta_kg_per_dose"); };
    REQUIRE(beta(0) != beta(1));
    const double target = (beta(0) + beta(1)) / 2;
    const auto aimed = [&](const std::string& tolerance) {
        box.write("study.toml", study + "[calibrate]\ntarget_g_per_dose = " + fmt::format("{}", target * 1e3) +
                                    "\ntolerance_g = " + tolerance + "\n");
        return box.vkdose("calibrate study.toml --backend reference --out out");
    };
    const auto before = fs::last_write_time(box / "out/members/0000/summary.json");
    const auto o = aimed("0.05");
    CAPTURE(o.out, o.err);
    CHECK(o.code == 0);
    CHECK(fs::last_write_time(box / "out/members/0000/summary.json") == before);
    CHECK_THAT(o.out, Catch::Contains("crosses the target at contact.kc_over_k 0.35") && Catch::Contains("<- chosen"));
    CHECK_THAT(o.out,
               Catch::Contains(
                   "confirming 3 runs with new seeds (2, 3, 4):\n    contact.kc_over_k 0.35, contact.friction 0.2") &&
                   Catch::Contains(": met\nthe target is met\n"));
    CHECK(timeless(box / "out").size() == 2);  // the confirming runs are in no table of the study
    CHECK(timeless(box / "out/confirm").size() == 3);
    const std::string found = readText(box / "out/calibrated.toml");
    CHECK_THAT(found, Catch::Contains("kc_over_k = 0.35\n") && !Catch::Contains("step_s"));
    CHECK_THAT(found, Catch::Contains("3 runs with new seeds give beta "));
    const auto check = box.vkdose("check out/calibrated.toml");
    CAPTURE(check.err);
    CHECK(check.code == 0);
    CHECK_THAT(check.out, Catch::Contains("study-calibrated"));

    // The interpolation is on the target to the last digit. What the confirming runs gave is not, and they are right.
    const auto confirmed = fs::last_write_time(box / "out/confirm/members/0002/summary.json");
    const auto missed = aimed("1e-7");
    CHECK(missed.code == 1);
    CHECK(fs::last_write_time(box / "out/confirm/members/0002/summary.json") == confirmed);  // not run again
    CHECK_THAT(missed.out,
               Catch::Contains("crosses the target at") && Catch::Contains(": missed\nthe target is NOT met\n"));
    CHECK_THAT(missed.err, Catch::Contains("no case is written"));
    CHECK_FALSE(fs::exists(box / "out/calibrated.toml"));
    CHECK_THAT(readText(box / "out/calibration.json"), Catch::Contains("\"met\": false"));

    // As if member 0 had dosed nothing: its point has no RSD.
    std::string told = readText(box / "out/members/0000/summary.json");
    const std::size_t rsd = told.find("\"rsd\": ") + 7;
    REQUIRE(rsd > 7);
    box.write("out/members/0000/summary.json", told.replace(rsd, told.find_first_of(",\n", rsd) - rsd, "null"));
    const auto unsteady = box.vkdose("calibrate study.toml --backend reference --out out");
    CHECK_THAT(unsteady.out, Catch::Contains("RSD ? ") && Catch::Contains("RSD ? %") && !Catch::Contains("nan"));

    box.write("study.toml", study + "[calibrate]\ntarget_g_per_dose = 1000\ntolerance_g = 0.001\n");
    const auto far = box.vkdose("calibrate study.toml --backend reference --out out");
    CHECK(far.code == 1);
    CHECK_FALSE(fs::exists(box / "out/calibrated.toml"));  // it was for another target
    CHECK_FALSE(fs::exists(box / "out/calibration.json"));
    CHECK_THAT(far.err, Catch::Contains("no curve comes to the target or within 0.001 g of it"));
    CHECK(box.vkdose("calibrate none.toml").code == 2);
    box.write("plain.toml", kStudy);
    const auto plain = box.vkdose("calibrate plain.toml");
    CHECK(plain.code == 2);
    CHECK_THAT(plain.err, Catch::Contains("[calibrate]"));
}

TEST_CASE("a search runs members until its target is met or its runs are used up, and goes on when killed") {
    const Sandbox box;
    const std::string study = kStudy.substr(0, kStudy.find("[[axis]]")) +
                              "[calibrate]\nmethod = \"surrogate\"\ntarget_g_per_dose = 0.02\ntolerance_g = 1e-7\n"
                              "max_runs = 5\n[[calibrate.parameter]]\nkey = \"contact.kc_over_k\"\nlow = 0.1\n"
                              "high = 0.6\n";
    box.write("study.toml", study);
    const auto whole = box.vkdose("calibrate study.toml --backend reference --out whole");
    CAPTURE(whole.out, whole.err);
    CHECK(whole.code == 1);
    CHECK_THAT(whole.out, Catch::Contains("NOT met") && Catch::Contains("after 5 points"));
    CHECK(timeless(box / "whole").size() == 5);
    CHECK_THAT(whole.err, Catch::Contains("no case is written"));
    CHECK_FALSE(fs::exists(box / "whole/calibrated.toml"));
    const pid_t run = box.start({"calibrate", "study.toml", "--backend", "reference", "--out", "cut"});
    REQUIRE(reached(run, box / "cut/members/0003"));
    kill(run, SIGKILL);
    waitpid(run, nullptr, 0);
    CHECK(box.vkdose("calibrate study.toml --backend reference --out cut").code == 1);
    CHECK(timeless(box / "cut") == timeless(box / "whole"));
    for (const char* name : {"calibration.json", "powder-draws.csv"})
        CHECK(readText(box / "cut" / name) == readText(box / "whole" / name));
    CHECK(box.vkdose("sweep study.toml").code == 2);
}

TEST_CASE("a calibration that is killed in its confirming runs ends as one that is not", "[slow]") {
    const Sandbox box;
    box.write("study.toml", kStudy.substr(0, kStudy.find("[[axis]]")) +
                                "[calibrate]\nmethod = \"surrogate\"\ntarget_g_per_dose = 0.05\ntolerance_g = 0.1\n"
                                "[[calibrate.parameter]]\nkey = \"contact.kc_over_k\"\nlow = 0.1\nhigh = 0.6\n");
    const auto whole = box.vkdose("calibrate study.toml --backend reference --out whole");
    CAPTURE(whole.out, whole.err);
    CHECK(whole.code == 0);
    CHECK_THAT(whole.out, Catch::Contains("the target is met"));
    CHECK(timeless(box / "whole").size() == 3);
    CHECK(timeless(box / "whole/confirm").size() == 3);
    const pid_t run = box.start({"calibrate", "study.toml", "--backend", "reference", "--jobs", "1", "--out", "cut"});
    REQUIRE(reached(run, box / "cut/confirm/members/0001"));
    kill(run, SIGKILL);
    waitpid(run, nullptr, 0);
    CHECK_FALSE(fs::exists(box / "cut/calibration.json"));
    CHECK(box.vkdose("calibrate study.toml --backend reference --out cut").code == 0);
    CHECK(timeless(box / "cut") == timeless(box / "whole"));
    CHECK(timeless(box / "cut/confirm") == timeless(box / "whole/confirm"));
    for (const char* name : {"calibration.json", "calibrated.toml"})
        CHECK(readText(box / "cut" / name) == readText(box / "whole" / name));

    // A folder that holds something else is not taken for one of confirming runs.
    fs::create_directories(box / "own/confirm");
    box.write("own/confirm/notes.txt", "mine");
    const auto own = box.vkdose("calibrate study.toml --backend reference --out own");
    CHECK(own.code == 2);
    CHECK_THAT(own.err, Catch::Contains("own/confirm holds something else than a sweep"));
    CHECK_FALSE(fs::exists(box / "own/members.csv"));
}

TEST_CASE("a search that has become another one is refused, and loses nothing") {
    const Sandbox box;
    const auto study = [](const std::string& target, const std::string& low) {
        return kStudy.substr(0, kStudy.find("[[axis]]")) +
               "[calibrate]\nmethod = \"surrogate\"\ntarget_g_per_dose = " + target +
               "\ntolerance_g = 1e-7\nmax_runs = 4\n[[calibrate.parameter]]\nkey = \"contact.kc_over_k\"\nlow = " +
               low + "\nhigh = 0.6\n";
    };
    const std::string command = "calibrate study.toml --backend reference --out out";
    box.write("study.toml", study("0.02", "0.1"));
    REQUIRE(box.vkdose(command).code == 1);
    const auto kept = [&] {
        std::vector<std::string> files;
        for (const char* name : {"study.toml", "base.toml", "members.csv", "calibration.json"})
            files.push_back(readText(box / "out" / name));
        return files;
    };
    const auto before = kept();
    for (const auto& changed : {study("0.02", "0.2"), study("0.5", "0.1")}) {  // from the first point on, and later
        box.write("study.toml", changed);
        const auto o = box.vkdose(command);
        CAPTURE(o.out, o.err);
        CHECK(o.code == 2);
        CHECK_THAT(o.err, Catch::Contains("a search goes on with the same case, seeds, parameters and targets"));
        CHECK(kept() == before);
    }
    box.write("study.toml", study("0.02", "0.1"));
    CHECK(box.vkdose(command).code == 1);
}

TEST_CASE("a failed member from which a search has gone on is not run again") {
    const Sandbox box;
    box.write("study.toml", kStudy.substr(0, kStudy.find("[[axis]]")) +
                                "[calibrate]\nmethod = \"surrogate\"\ntarget_g_per_dose = 0.02\ntolerance_g = 1e-7\n"
                                "max_runs = 5\n[[calibrate.parameter]]\nkey = \"contact.max_overlap_ratio\"\n"
                                "low = 1e-9\nhigh = 0.2\n");
    const std::string command = "calibrate study.toml --backend reference --out out";
    const auto first = box.vkdose(command);
    CAPTURE(first.out, first.err);
    REQUIRE_THAT(first.err, Catch::Contains("failed"));
    const auto table = readText(box / "out/members.csv");
    const auto again = box.vkdose(command + " --retry-failed");
    CAPTURE(again.err);
    CHECK(again.code == first.code);
    CHECK_THAT(again.err, Catch::Contains("is left so, because later points of the search follow from it"));
    CHECK(readText(box / "out/members.csv") == table);
}

TEST_CASE("members of a prepared sweep run as tasks of a job array, and are gathered") {
    const Sandbox box;
    box.write("study.toml", kStudy);
    REQUIRE(box.vkdose("sweep study.toml --backend reference --out whole --quiet").code == 0);
    const auto prepared = box.vkdose("sweep study.toml --prepare --out queue");
    CHECK(prepared.code == 0);
    CHECK_THAT(prepared.out, Catch::Contains("4 members to run in queue/members"));
    const auto task = [&](int number) {
        const std::string command = "cd '" + box.path().string() +
                                    "' && SLURM_ARRAY_TASK_ID=" + std::to_string(number) +
                                    " VKDOSE='" VKDOSE_BINARY_DIR "/vkdose' " +
                                    "'" VKDOSE_SOURCE_DIR "/tools/slurm-array' queue --backend reference 2> error.txt";
        const int status = std::system(command.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    };
    for (const int number : {2, 0}) CHECK(task(number) == 0);
    const auto before = fs::last_write_time(box / "queue/members/0002/summary.json");
    CHECK(task(2) == 0);  // over: nothing to do
    CHECK(task(9) == 2);
    CHECK_THAT(readText(box / "error.txt"), Catch::Contains("there is no member in queue/members/0009"));
    // One that was cut short goes on from its checkpoint.
    const pid_t run = box.start({"run", "queue/members/0003/case.toml", "--out", "queue/members/0003", "--force",
                                 "--quiet", "--backend", "reference"});
    REQUIRE(reached(run, box / "queue/members/0003"));
    kill(run, SIGKILL);
    waitpid(run, nullptr, 0);
    CHECK(task(3) == 0);
    CHECK(box.vkdose("sweep study.toml --backend reference --out queue").code == 0);
    CHECK(fs::last_write_time(box / "queue/members/0002/summary.json") == before);
    CHECK(timeless(box / "queue") == timeless(box / "whole"));
}
