#include <fmt/format.h>

#include <thread>

#include "host/app/child_runner.h"
#include "host/app/commands.h"
#include "host/app/ensemble_runner.h"
#include "host/app/exit_code.h"
#include "host/app/interrupt.h"
#include "host/app/mpi/mpi_runner.h"
#include "host/app/sweep_display.h"
#include "host/app/sweep_setup.h"
#include "host/app/text.h"
#include "host/core/printable.h"
#include "host/study/member.h"
#include "host/study/study.h"
#include "host/study/sweep.h"
#include "host/vk/device.h"

namespace vkdose {

std::unique_ptr<MemberRunner> makeRunner(const SweepOptions& options) {
    const int cores = int(std::max(1U, std::thread::hardware_concurrency()));
    if (options.backend.backend == "vulkan") {
        // The device is looked for even if the number of members is given, because no member can run without one.
        const vk::Device device(vk::DeviceChoice{options.backend.device, false});
        const bool gpu = device.info().isGpu();
        if (options.ensemble > 0 || (gpu && options.jobs == 0))
            return std::make_unique<EnsembleRunner>(options.backend, options.ensemble, roomOn(device));
    } else if (options.ensemble > 0) {
        throw UsageError("an ensemble needs a device; the reference runs one canister at a time");
    }
    return std::make_unique<ChildRunner>(options.backend, options.jobs > 0 ? options.jobs : cores);
}

std::filesystem::path sweepFolder(const SweepOptions& options) {
    return options.out.empty() ? std::filesystem::path("out") / options.study.stem() : options.out;
}

int sweepCommand(const SweepOptions& options) {
    std::unique_ptr<MemberRunner> runner;
    if (options.mpi) {
        runner = makeMpiRunner(options.backend);
        if (!runner) return kOk;  // this rank has served the first
    }
    // Everything that can be refused is refused before anything is written.
    const Study study = readStudy(options.study);
    if (study.calibration && study.calibration->method == CalibrationAim::Method::Surrogate)
        throw UsageError(fmt::format("{} is a search, not a sweep; use `vkdose calibrate {}`", options.study.string(),
                                     shellWord(options.study.string())));
    const std::vector<Member> members = membersOf(study);
    if (options.dryRun) {
        fmt::print("{}", membersText(study, members));
        return kOk;
    }
    if (options.prepare) {
        SweepFolder folder(sweepFolder(options), study, members);
        for (const Member& member : members) folder.begin(member);
        fmt::print("{} to run in {}\n", counted(members.size(), "member"),
                   printable((folder.path() / "members").string()));
        return kOk;
    }
    if (!runner) runner = makeRunner(options);
    const std::filesystem::path out = sweepFolder(options);
    const std::atomic<bool>& stop = watchInterrupts();
    SweepFolder folder(out, study, members);
    SweepDisplay display("sweep", study, options.quiet);
    display.begin(members, runner->manner());
    const SweepOutcome outcome = runMembers(folder, members, *runner, display, stop, options.retryFailed);
    if (outcome.whole) folder.sort();
    display.finish(folder, outcome);
    if (!outcome.whole) return kInterrupted;
    return outcome.failed > 0 ? kDisagree : kOk;
}

}  // namespace vkdose
