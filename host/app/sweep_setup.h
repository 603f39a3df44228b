#pragma once
// What is common to `vkdose sweep` and `vkdose calibrate`.

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/app/commands.h"
#include "host/app/sweep_display.h"
#include "host/core/exit_code.h"
#include "host/study/sweep.h"

namespace vkdose {

/// The runner of the members: on a GPU ensembles as large as its memory allows, on a CPU a process per core, unless
/// the options say how many. Throws DeviceError if there is no device to run them on.
std::unique_ptr<MemberRunner> makeRunner(const SweepOptions& options);

/// The members with what they cost, for a dry run. Measures the device unless the options say otherwise.
std::string planText(const SweepOptions& options, const Study& study, const std::vector<Member>& members,
                     const LaterMembers& later = {});

/// Halts a sweep when `interrupted` is set or the limit, if there is one, is up. Both must outlive the rule.
HaltRule haltRule(const std::atomic<bool>& interrupted, const std::optional<TimeLimit>& limit);

/// The exit code of a command whose sweep this has ended.
ExitCode haltCode(Halt halt);

/// The folder of the sweep: --out, or out/<name of the study's file>.
std::filesystem::path sweepFolder(const SweepOptions& options);

/// What a command makes of a sweep.
struct SweepReport {
    const char* command;                            ///< its name
    const char* finding;                            ///< file in the folder that is removed before; null: none
    std::function<void(const SweepFolder&)> write;  ///< is called when every member has ended; null: nothing is
};

/// Runs the members of a study into `sweepFolder`, or goes on with them, and tells how they ended. Gives the exit code.
int playSweep(const SweepOptions& options, const Study& study, const std::vector<Member>& members, MemberRunner& runner,
              const SweepReport& report);

}  // namespace vkdose
