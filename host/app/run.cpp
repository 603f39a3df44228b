#include <fmt/format.h>

#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/app/interrupt.h"
#include "host/app/progress.h"
#include "host/app/report.h"
#include "host/core/error.h"
#include "host/output/run_folder.h"

namespace vkdose {

namespace {

/// Passes everything on to the output folder and, unless quiet, to the display.
class Fanout : public RunObserver {
  public:
    Fanout(RunObserver& folder, RunObserver* display) : folder_(folder), display_(display) {}
    void onProgress(const Progress& p) override {
        if (display_) display_->onProgress(p);
    }
    void onSample(const Sample& s) override { folder_.onSample(s); }
    void onDose(const Dose& d) override {
        folder_.onDose(d);
        if (display_) display_->onDose(d);
    }
    void onCheckpoint(const RunCheckpoint& c, double time) override { folder_.onCheckpoint(c, time); }
    bool storesCheckpoints() const override { return folder_.storesCheckpoints(); }

  private:
    RunObserver& folder_;
    RunObserver* display_;
};

int exitCode(StopReason reason) {
    switch (reason) {
        case StopReason::Interrupted:
            return kInterrupted;
        case StopReason::RunError:
            return kRunError;
        case StopReason::DeviceError:
            return kDeviceError;
        case StopReason::OutputError:
            return kOutputError;
        default:
            return kOk;
    }
}

/// How to go on with a run that ended before it was over.
std::string wayOn(const RunFolder& folder) {
    if (!folder.checkpointTime()) return "no checkpoint had been written; start again";
    return fmt::format("go on from t = {:.6g} s with `vkdose resume {}`", *folder.checkpointTime(),
                       folder.path().string());
}

/// Runs, from the start or from a checkpoint, and tells how it ended.
int play(const Case& c, Insertion filled, Backend& backend, const BackendChoice& choice, RunFolder& folder, bool quiet,
         int parent, const RunCheckpoint* from = nullptr) {
    Derived derived = derive(c, filled);
    const std::atomic<bool>& stop = watchInterrupts();
    if (parent != 0) endWithParent(parent);
    ProgressDisplay display;
    if (!quiet) {
        fmt::print("{}: {} particles, {:.3f} g, on {}\n", c.name, filled.particles.size(), filled.mass * 1e3,
                   backend.description());
        std::fflush(stdout);
    }
    Fanout observers(folder, quiet ? nullptr : &display);
    const RunResult result = runFilled(c, std::move(filled), std::move(derived), backend, observers, stop, from);
    display.close();

    if (result.reason == StopReason::OutputError) {
        fmt::print(stderr, "vkdose: {}; make room, then {}\n", result.error, wayOn(folder));
        return kOutputError;
    }
    if (!result.error.empty()) fmt::print(stderr, "vkdose: {}\n", result.error);
    folder.finish(c, result);
    if (!quiet) {
        fmt::print("{}output   {}\n", reportText(c, result, backend.description()), folder.path().string());
        if (result.reason == StopReason::Interrupted) fmt::print("resume   {}\n", wayOn(folder));
    }
    const bool clean = validationClean(choice, backend);
    return result.error.empty() && !clean ? kDeviceError : exitCode(result.reason);
}

}  // namespace

int runCommand(const RunOptions& options) {
    // Everything that can be refused is refused before the folder is touched.
    const Case c = loadCase(options.input.file, options.input.overrides);
    (void)Timeline(c);
    const Insertion filled = insertParticles(c);
    const std::unique_ptr<Backend> backend = makeBackend(options.backend, filled.particles.size());
    RunFolder folder(options.out.empty() ? std::filesystem::path("out") / c.name : options.out, options.force, c,
                     backend->description());
    return play(c, filled, *backend, options.backend, folder, options.quiet, options.parent);
}

int resumeCommand(const ResumeOptions& options) {
    const std::filesystem::path file = options.folder / kCheckpointName;
    if (!std::filesystem::exists(file) && std::filesystem::exists(options.folder / "summary.json"))
        throw CheckpointError(
            fmt::format("the run in {} is over; there is nothing to resume", options.folder.string()));
    const Checkpoint from = readCheckpoint(file);
    const Case c = loadResolvedCase(from.caseText, options.folder / "case.toml");
    const BackendChoice choice = sameBackend(from.backend, options.backend);
    const Insertion filled = insertParticles(c);
    const std::unique_ptr<Backend> backend = makeBackend(choice, filled.particles.size());
    if (backend->description() != from.backend || from.program != VKDOSE_VERSION)
        fmt::print(stderr,
                   "vkdose: the checkpoint was written by vkdose {} on {}; going on with {} on {} is not bound to give "
                   "the same bits\n",
                   from.program, from.backend, VKDOSE_VERSION, backend->description());
    RunFolder folder(options.folder, from, c, backend->description());
    try {
        return play(c, filled, *backend, choice, folder, options.quiet, options.parent, &from.run);
    } catch (const RecordError& e) {
        throw CheckpointError(fmt::format("{} cannot be used: {}", file.string(), e.what()));
    }
}

}  // namespace vkdose
