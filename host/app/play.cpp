#include "host/app/play.h"

#include <fmt/format.h>

#include <utility>

#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/printable.h"

namespace vkdose {

namespace {

/// Passes everything on to the output folder and, if there is one, to the display.
class Fanout : public RunObserver {
  public:
    Fanout(RunObserver& folder, RunObserver* display) : folder_(folder), display_(display) {}
    void onProgress(const Progress& p) override {
        if (display_) display_->onProgress(p);
    }
    void onSample(const Sample& s) override {
        folder_.onSample(s);
        if (display_) display_->onSample(s);
    }
    void onSettled(const Settling& settling, const Schedule& schedule) override {
        if (display_) display_->onSettled(settling, schedule);
    }
    void onDose(const Dose& d) override {
        folder_.onDose(d);
        if (display_) display_->onDose(d);
    }
    void onField(const FieldSample& f) override { folder_.onField(f); }
    void onCheckpoint(const RunCheckpoint& c, double time) override { folder_.onCheckpoint(c, time); }
    bool storesCheckpoints() const override { return folder_.storesCheckpoints(); }
    void onFrame(const Frame& f) override { folder_.onFrame(f); }
    bool storesFrames() const override { return folder_.storesFrames(); }

  private:
    RunObserver& folder_;
    RunObserver* display_;
};

ExitCode exitCode(StopReason reason) {
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

/// The case in `text` as this version of vkdose writes it, whichever version wrote `text`. Empty if `text` is not a
/// case.
std::string resolvedIn(const std::string& text, const std::filesystem::path& file) {
    try {
        return loadResolvedCase(text, file).resolved;
    } catch (const CaseError&) {
        return "";
    }
}

/// Refuses a case.toml that no longer says what is run. Rewriting it would lose what somebody wrote there.
void requireSameCase(const std::filesystem::path& file, const std::string& before, const Case& c) {
    if (!std::filesystem::exists(file)) return;  // it is written again
    const std::string text = fileContent(file).value_or("");
    if (text == before || resolvedIn(text, file) == c.resolved) return;
    throw CheckpointError(
        fmt::format("{} has been changed since the run began, but a run goes on with the case it began with: put the "
                    "file back as it was, or remove it to have it written again; a changed case is a new run",
                    file.string()));
}

}  // namespace

ReadyRun readyRun(const CaseOptions& input) {
    ReadyRun run;
    run.c = loadCase(input.file, input.overrides);
    (void)Timeline(run.c);
    run.filled = insertParticles(run.c);
    return run;
}

ReadyRun readyToResume(const std::filesystem::path& folder) {
    ReadyRun run;
    if (std::filesystem::is_directory(folder)) run.lock.emplace(lockRun(folder));
    const std::filesystem::path file = folder / kCheckpointName;
    if (!std::filesystem::exists(file) && std::filesystem::exists(folder / "summary.json"))
        throw CheckpointError(fmt::format("the run in {} is over; there is nothing to resume", folder.string()));
    Checkpoint from = readCheckpoint(file);
    run.c = loadResolvedCase(from.caseText, folder / "case.toml");
    requireSameCase(folder / "case.toml", from.caseText, run.c);
    run.filled = insertParticles(run.c);
    run.from = std::move(from);
    return run;
}

RunFolder folderOf(ReadyRun& run, const std::filesystem::path& folder, bool force, const Backend& backend) {
    if (run.from) return RunFolder(folder, std::move(run.lock).value(), *run.from, run.c, backend.description());
    return RunFolder(folder, force, run.c, backend.description(), run.member);
}

Played play(ReadyRun run, Backend& backend, RunFolder& folder, RunObserver* display, const std::atomic<bool>& stop) {
    Derived derived = derive(run.c, run.filled);
    Fanout observers(folder, display);
    Played played;
    try {
        played.result = runFilled(run.c, std::move(run.filled), std::move(derived), backend, observers, stop,
                                  run.from ? &run.from->run : nullptr);
    } catch (const RecordError& e) {
        throw CheckpointError(
            fmt::format("{} cannot be used: {}", (folder.path() / kCheckpointName).string(), e.what()));
    }
    played.code = exitCode(played.result.reason);
    played.error = played.result.error;
    if (played.result.reason == StopReason::OutputError)
        played.error += "; " + wayOn(folder);
    else
        folder.finish(run.c, played.result);
    return played;
}

std::string wayOn(const RunFolder& folder) {
    if (!folder.checkpointTime()) return "no checkpoint had been written; start again";
    if (!std::filesystem::exists(folder.path() / kCheckpointName))
        return fmt::format("its checkpoint is gone with it; put {} back and go on with `vkdose resume`, or start again",
                           folder.path().string());
    return fmt::format("go on from t = {:.6g} s with `vkdose resume {}`", *folder.checkpointTime(),
                       shellWord(folder.path().string()));
}

}  // namespace vkdose
