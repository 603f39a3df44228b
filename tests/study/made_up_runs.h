#pragma once
// A runner of members that makes their results up.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/core/columns.h"
#include "host/output/checkpoint.h"
#include "host/output/run_folder.h"
#include "host/sim/dose.h"
#include "host/study/sweep.h"
#include "tests/support/catch.h"

namespace vkdose::test {

/// Stands in for the processes: a member "runs" until it is waited for, the last started ends first.
class MadeUpRuns : public MemberRunner {
  public:
    explicit MadeUpRuns(int slots) : slots_(slots) {}
    std::string manner() const override { return ""; }
    void order(std::vector<WaitingMember>& members) override {
        for (const WaitingMember& w : members) steps[w.member->number] = w.steps;
        if (backwards) std::reverse(members.begin(), members.end());
    }
    bool settlesBeds() const override { return beds; }
    bool takes(const Member&) const override { return int(running.size()) < slots_; }
    void start(const MemberTask& task) override {
        CHECK(std::filesystem::exists(task.folder / "case.toml"));
        running.push_back(task);
        started.push_back(task.number);
        resumed.push_back(task.resume);
        most = std::max(most, int(running.size()));
    }
    std::optional<MemberEnd> wait() override {
        if (running.empty()) throw std::logic_error("nothing to wait for");
        const MemberTask task = running.back();
        running.pop_back();
        const auto code = codes.find(task.number);
        MemberEnd end{task.number, interrupted ? 130 : code == codes.end() ? 0 : code->second, ""};
        if (end.code == 3) end.said = "particle 7, \"lost\"";
        const Dose whole{.index = 1,
                         .mass = 0.002,
                         .particles = 3,
                         .cumulative = 0.002,
                         .coilTorque = 0.5,
                         .complete = true,
                         .regions = {},
                         .bodies = {},
                         .powders = {}};
        const Dose cut{.index = 2,
                       .mass = 0.001,
                       .particles = 1,
                       .cumulative = 0.003,
                       .coilTorque = 0.7,
                       .regions = {},
                       .bodies = {},
                       .powders = {}};
        std::ofstream(task.folder / "doses.csv") << csvHeader(kDoseColumns) << "\n"
                                                 << csvRow(kDoseColumns, whole) << "\n"
                                                 << csvRow(kDoseColumns, cut) << "\n";
        if (end.code == 0)
            std::ofstream(task.folder / "summary.json")
                << R"({"error": null, "interrupted": false, "stop_reason": "dose_count", "simulated_time_s": 1.5,
                    "analysis": {"blocked_at_dose": null},
                    "settled": {"bulk_density_kg_m3": null, "pull_off_over_weight": {"median": null}}})";
        else
            writeCheckpoint(task.folder / kCheckpointName, Checkpoint{});
        if (end.code == 0) std::filesystem::remove(task.folder / kCheckpointName);
        if (onEnd) onEnd();
        return end;
    }
    void interrupt() override { interrupted = true; }

    int slots_;
    std::map<int, int> codes;  ///< exit codes other than 0
    std::vector<MemberTask> running;
    std::vector<int> started;
    std::vector<bool> resumed;
    std::map<int, double> steps;  ///< left, as told before the first was started
    bool backwards = false;
    bool beds = false;  ///< whether it settles them
    int most = 0;
    bool interrupted = false;
    std::function<void()> onEnd;
};

}  // namespace vkdose::test
