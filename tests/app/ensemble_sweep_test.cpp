// `vkdose sweep --ensemble`: members that share the device leave behind what members in processes do.

#include <sys/types.h>

#include <algorithm>
#include <csignal>
#include <thread>

#include "host/app/ensemble_runner.h"
#include "host/output/checkpoint.h"
#include "host/study/sweep.h"
#include "tests/app/sandbox.h"
#include "tests/app/sweep_tables.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;
namespace fs = std::filesystem;

namespace {

/// Of the mini canister: members of different lengths, one that fails, and one whose floor is of another kind. Ramps
/// cut the calls of some; the torque, as soon as there is any, stops the coil of two at a step of their own.
const std::string kStudy = R"(base = ")" VKDOSE_SOURCE_DIR R"(/cases/mini.toml"
[set]
settle.time_s = 0.01
dose.rotate_s = 0.05
dose.rest_s = 0.01
sensors.interval_s = 0.003
checkpoint.time_s = 0.006
frames.interval_s = 0.02
[[axis]]
keys = ["contact.friction", "stop.max_doses", "contact.max_overlap_ratio", "canister.floor", "dose.ramp_s",
        "dose.max_torque_mNm"]
values = [[0.2, 1, 0.2, "trough", 0, 1e-9], [0.3, 2, 0.2, "trough", 0.01, 1000], [0.3, 1, 1e-9, "trough", 0, 1000],
          [0.4, 2, 0.2, "flat", 0.005, 1e-9], [0.4, 1, 0.2, "trough", 0, 1000]]
)";

constexpr std::size_t kStatus = 8, kError = 9;  // columns of members.csv
const std::string kFails = "2";                 // the member

/// Device and threads as everywhere in the tests; a sweep in processes of the same study, against which all is held.
struct Place {
    Sandbox box;
    Place() {
        box.write("study.toml", kStudy);
        const auto whole = box.vkdose("sweep study.toml --jobs 2 --out whole");
        CAPTURE(whole.out, whole.err);
        REQUIRE(whole.code == 1);
        REQUIRE(timeless(box / "whole").size() == 5);
    }

    /// The rows of all members; of the one that fails without the place where the particle was, which is that at the
    /// end of a submission, not at the end of the step.
    std::vector<Row> rows(const std::string& folder) const {
        std::vector<Row> all = timeless(box / folder);
        for (Row& row : all)
            if (row[0] == kFails) row[kError] = row[kError].substr(row[kError].rfind("(step"));
        return all;
    }

    void checkSame(const std::string& folder) const {
        CHECK(rows(folder) == rows("whole"));
        CHECK(readText(box / folder / "doses.csv") == readText(box / "whole/doses.csv"));
        for (const Row& row : timeless(box / folder)) {
            for (const char* name : {"case.toml", "timeseries.csv", "doses.csv", "particles.csv", "frames/frames.csv",
                                     "frames/particles_000001.hdf"}) {
                // The end of the one that fails: as the place.
                if (row[0] == kFails && std::string(name).find("particles") != std::string::npos) continue;
                const std::string file = "members/000" + row[0] + "/" + name;
                INFO(file);
                REQUIRE(fs::exists(box / "whole" / file));
                CHECK(readText(box / folder / file) == readText(box / "whole" / file));
            }
        }
        CHECK_FALSE(fs::exists(box / folder / "members/0000" / kCheckpointName));
    }
};

/// Starts a sweep on an ensemble and waits until member 1, one of the longest, has stored a checkpoint in it; fails if
/// the sweep ends first.
pid_t startedSweep(const Sandbox& box) {
    const fs::path checkpoint = box / "cut/members/0001" / kCheckpointName;
    std::error_code none;
    const auto before = fs::last_write_time(checkpoint, none);
    const pid_t sweep = box.start({"sweep", "study.toml", "--ensemble", "4", "--out", "cut"});
    while (!fs::exists(checkpoint) || fs::last_write_time(checkpoint, none) == before) {
        if (waitpid(sweep, nullptr, WNOHANG) != 0) FAIL("the sweep ended before it could be cut short");
        std::this_thread::yield();
    }
    return sweep;
}

}  // namespace

TEST_CASE("members of an ensemble leave the same files as members in processes, also beside one that fails") {
    const Place place;
    const auto o = place.box.vkdose("sweep study.toml --ensemble 3 --validation --out together");
    CAPTURE(o.out, o.err);
    CHECK(o.code == 1);
    CHECK_THAT(o.out, Catch::Contains("5 members, 3 at a time on one device") && Catch::Contains("4 done, 1 failed"));
    CHECK_THAT(o.err, Catch::Contains("member 0002") && Catch::Contains("overlap"));
    place.checkSame("together");
}

TEST_CASE("a sweep on an ensemble that is killed, and interrupted, goes on to the same files") {
    const Place place;
    const pid_t killed = startedSweep(place.box);
    kill(killed, SIGKILL);
    waitpid(killed, nullptr, 0);

    const pid_t interrupted = startedSweep(place.box);
    kill(interrupted, SIGINT);
    int status = 0;
    waitpid(interrupted, &status, 0);
    CHECK(WEXITSTATUS(status) == 130);
    // Members that had not ended have been stored, all at once; so was the one that failed, before it did.
    const auto rows = timeless(place.box / "cut");
    CHECK(std::count_if(rows.begin(), rows.end(), [](const Row& row) { return row[kStatus] == "interrupted"; }) > 0);
    for (const Row& row : rows)
        CHECK(fs::exists(place.box / ("cut/members/000" + row[0]) / kCheckpointName) == (row[kStatus] != "ok"));

    const auto on = place.box.vkdose("sweep study.toml --ensemble 4 --out cut");
    CAPTURE(on.out, on.err);
    CHECK(on.code == 1);
    place.checkSame("cut");
}

TEST_CASE("a member that waits begins as soon as another one ends, and time that is up cuts all at a checkpoint") {
    const Place place;
    const fs::path out = place.box / "turns";
    const Study study = readStudy(place.box / "study.toml");
    const std::vector<Member> members = membersOf(study);
    const DeviceRoom plenty{~std::uint64_t{0}, ~std::uint64_t{0}, 65535};
    struct Watch : SweepObserver {
        std::vector<std::string> ends;  ///< status of each
        void onMember(const Member&, const MemberResult& result) override { ends.push_back(statusText(result.status)); }
        void onProgress(const SweepProgress& p) override { most = std::max(most, p.running); }
        int most = 0;
    } watch;
    {  // Two places for the four of one kind. The third of them begins when one of the first two has ended.
        EnsembleRunner runner({}, 2, plenty);
        SweepFolder folder(out, study, members);
        const HaltRule halt = [&] {
            const auto begun = std::count_if(members.begin(), members.end(), [&](const Member& m) {
                return fs::exists(folder.memberFolder(m.number) / "timeseries.csv");
            });
            return begun >= 3 ? Halt::TimeIsUp : Halt::None;
        };
        const SweepOutcome outcome = runMembers(folder, members, runner, watch, halt);
        CHECK(outcome.halt == Halt::TimeIsUp);
        CHECK_FALSE(outcome.whole);
        CHECK(watch.most <= 2);
        REQUIRE_FALSE(watch.ends.empty());
        CHECK(watch.ends[0] != "interrupted");
        for (const Member& m : members)
            if (folder.status(m.number) == MemberStatus::Interrupted)
                CHECK(fs::exists(folder.memberFolder(m.number) / kCheckpointName));
    }
    fs::rename(out, place.box / "elsewhere");
    const auto on = place.box.vkdose("sweep study.toml --ensemble 2 --out elsewhere --for 2h");
    CAPTURE(on.out, on.err);
    CHECK(on.code == 1);
    place.checkSame("elsewhere");
}

TEST_CASE("a member goes on in an ensemble on a device of the kind that it began on, or on one that is named") {
    const Place place;
    const pid_t sweep = startedSweep(place.box);
    kill(sweep, SIGINT);
    waitpid(sweep, nullptr, 0);
    const fs::path file = place.box / "cut/members/0001" / kCheckpointName;
    Checkpoint checkpoint = readCheckpoint(file);
    const std::string device = checkpoint.backend.substr(std::string("vulkan: ").size());
    checkpoint.backend = "vulkan: Voodoo 2";
    writeCheckpoint(file, checkpoint);
    const auto other = place.box.vkdose("sweep study.toml --ensemble 4 --out cut");
    CHECK(other.code == 1);
    CHECK_THAT(other.err, Catch::Contains("member 0001") && Catch::Contains("the run was made on 'Voodoo 2'"));
    const auto named =
        place.box.vkdose("sweep study.toml --ensemble 4 --out cut --retry-failed --device " + device.substr(0, 5));
    CAPTURE(named.out, named.err);
    CHECK(named.code == 1);
    place.checkSame("cut");
}

TEST_CASE("an ensemble excludes what it cannot be") {
    const Sandbox box;
    box.write("study.toml", kStudy);
    CHECK(box.vkdose("sweep study.toml --ensemble 2 --jobs 2").code == 2);
    CHECK(box.vkdose("sweep study.toml --ensemble 2 --mpi").code == 2);
    CHECK(box.vkdose("sweep study.toml --ensemble 0").code == 2);
    const auto o = box.vkdose("sweep study.toml --ensemble 2 --backend reference");
    CHECK(o.code == 2);
    CHECK_THAT(o.err, Catch::Contains("an ensemble needs a device"));
    CHECK(box.files() == std::vector<std::string>{"study.toml"});
}
