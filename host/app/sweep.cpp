#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "host/app/child_runner.h"
#include "host/app/commands.h"
#include "host/app/ensemble_runner.h"
#include "host/app/exit_code.h"
#include "host/app/interrupt.h"
#include "host/app/mpi/mpi_runner.h"
#include "host/app/speed.h"
#include "host/app/sweep_display.h"
#include "host/app/sweep_setup.h"
#include "host/app/tell.h"
#include "host/app/text.h"
#include "host/core/error.h"
#include "host/core/printable.h"
#include "host/study/figures_table.h"
#include "host/study/finding_file.h"
#include "host/study/member.h"
#include "host/study/study.h"
#include "host/study/sweep.h"
#include "host/vk/device.h"

namespace vkdose {

namespace {

/// Members at once, each in a process of its own.
int processes(const SweepOptions& options) {
    return options.jobs > 0 ? options.jobs : int(std::max(1U, std::thread::hardware_concurrency()));
}

/// Members at once, for an estimate. How much faster an ensemble is than its members one by one depends on the device.
int atOnce(const SweepOptions& options) {
    if (options.backend.backend == "vulkan" && options.jobs == 0) {
        try {
            const vk::Device device(vk::DeviceChoice{options.backend.device, false});
            if (options.ensemble > 0 || device.info().isGpu()) return 1;
        } catch (const DeviceError&) {  // the estimate does without
        }
    }
    return processes(options);
}

}  // namespace

std::string planText(const SweepOptions& options, const Study& study, const std::vector<Member>& members,
                     const LaterMembers& later) {
    Speed speed = speedOf({}, {}, options.backend, true);
    if (!members.empty()) {
        const auto largest = std::max_element(
            members.begin(), members.end(), [](const Member& a, const Member& b) { return a.particles < b.particles; });
        const Case c = loadResolvedCase(largest->caseText, "case.toml");
        speed = speedOf(c, insertParticles(c), options.backend, options.assume);
    }
    return membersText(study, members, later, speed, atOnce(options));
}

std::unique_ptr<MemberRunner> makeRunner(const SweepOptions& options) {
    if (options.backend.backend == "vulkan") {
        // The device is looked for even if the number of members is given, because no member can run without one.
        const vk::Device device(vk::DeviceChoice{options.backend.device, false});
        const bool gpu = device.info().isGpu();
        if (options.ensemble > 0 || (gpu && options.jobs == 0))
            return std::make_unique<EnsembleRunner>(options.backend, options.ensemble, roomOn(device));
    } else if (options.ensemble > 0) {
        throw UsageError("an ensemble needs a device; the reference runs one canister at a time");
    }
    return std::make_unique<ChildRunner>(options.backend, processes(options));
}

HaltRule haltRule(const std::atomic<bool>& interrupted, const std::optional<TimeLimit>& limit) {
    return [&interrupted, &limit] {
        if (interrupted) return Halt::Interrupted;
        return limit && limit->isUp() ? Halt::TimeIsUp : Halt::None;
    };
}

ExitCode haltCode(Halt halt) {
    return halt == Halt::TimeIsUp ? kTimeIsUp : kInterrupted;
}

std::filesystem::path sweepFolder(const SweepOptions& options) {
    return options.out.empty() ? std::filesystem::path("out") / options.study.stem() : options.out;
}

int playSweep(const SweepOptions& options, const Study& study, const std::vector<Member>& members, MemberRunner& runner,
              const SweepReport& report) {
    const HaltRule halt = haltRule(watchInterrupts(), options.limit);
    SweepFolder folder(sweepFolder(options), study, members);
    removeFindings({folder.path() / kFiguresName});
    if (report.finding != nullptr) removeFindings({folder.path() / report.finding});
    SweepDisplay display(report.command, study, options.quiet);
    display.begin(members, runner.manner());
    const SweepOutcome outcome = runMembers(folder, members, runner, display, halt, options.retryFailed);
    if (outcome.whole) folder.sort();
    display.finish(folder, outcome, options);
    if (!outcome.whole) return haltCode(outcome.halt);
    writeFigures(folder, study, members);
    if (report.write) report.write(folder);
    return outcome.failed > 0 ? kDisagree : kOk;
}

int sweepCommand(const SweepOptions& options) {
    std::unique_ptr<MemberRunner> runner;
    if (options.mpi) {
        runner = makeMpiRunner(options.backend);
        if (!runner) return kOk;  // this rank has served the first
    }
    // Everything that can be refused is refused before anything is written.
    const Study study = readStudy(options.study, options.overrides);
    if (study.calibration && study.calibration->searches())
        throw UsageError(fmt::format("{} is a search, not a sweep; use `vkdose {} {}`", options.study.string(),
                                     study.calibration->table(), shellWord(options.study.string())));
    const std::vector<Member> members = membersOf(study);
    if (options.dryRun) {
        tell("{}", planText(options, study, members));
        return kOk;
    }
    if (options.prepare) {
        SweepFolder folder(sweepFolder(options), study, members);
        for (const Member& member : members) folder.begin(member);
        tell("{} to run in {}\n", counted(members.size(), "member"), printable((folder.path() / "members").string()));
        return kOk;
    }
    if (!runner) runner = makeRunner(options);
    return playSweep(options, study, members, *runner, {"sweep", nullptr, nullptr});
}

}  // namespace vkdose
