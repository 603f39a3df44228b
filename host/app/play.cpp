#include "host/app/play.h"

#include <fmt/format.h>

#include <utility>

#include "host/app/reopen.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/printable.h"
#include "host/output/run_files.h"

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
    void onSettled(const Settling& settling, const Case& c) override {
        if (display_) display_->onSettled(settling, c);
    }
    void onDose(const Dose& d) override {
        folder_.onDose(d);
        if (display_) display_->onDose(d);
    }
    void onRefill(const AddedPowder& p) override {
        if (display_) display_->onRefill(p);
    }
    DriveOrder order() override { return display_ ? display_->order() : DriveOrder{}; }
    void onOrder(const GivenOrder& o) override {
        if (display_) display_->onOrder(o);
    }
    bool wantsRefill(std::size_t refill) override { return display_ != nullptr && display_->wantsRefill(refill); }
    void onField(const FieldSample& f) override { folder_.onField(f); }
    void onCheckpoint(const RunCheckpoint& c, double time) override { folder_.onCheckpoint(c, time); }
    bool storesCheckpoints() const override { return folder_.storesCheckpoints(); }
    void onState(KeptState kind, const RunCheckpoint& state, double time) override {
        folder_.onState(kind, state, time);
    }
    bool storesStates() const override { return folder_.storesStates(); }
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

/// The case in `text` as vkdose writes it, without its remarks. Empty if `text` is not a
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

/// Throws CaseError for keys of a case that a run must not change once it has begun.
void requireLater(const std::vector<std::string>& overrides, const std::filesystem::path& folder) {
    std::vector<Diagnostic> faults;
    const Node tree = overrideTree(overrides);
    for (const Node& table : tree.children) {
        if (table.key == "stop" || table.key == "checkpoint") continue;
        const bool isTable = table.kind == Node::Kind::Table;
        for (const Node& key : isTable ? table.children : std::vector<Node>{table}) {
            const std::string path = isTable ? table.key + "." + key.key : key.key;
            if (path == "contact.max_overlap_ratio") continue;
            faults.push_back({kCommandLine, 0, path, valueText(key), "cannot be changed in a run that has begun",
                              fmt::format("give contact.max_overlap_ratio, stop.* or checkpoint.*, or begin another "
                                          "run with this powder: `vkdose run --from {} --set ...`",
                                          shellWord(folder.string()))});
        }
    }
    if (!faults.empty()) throw CaseError(faults);
}

bool replaces(const std::vector<std::string>& overrides, const char* table) {
    return overrideTree(overrides).child(table) != nullptr;
}

/// Puts the overrides into the case of a checkpoint.
void change(Checkpoint& from, const Case& c, const std::vector<std::string>& overrides) {
    Node given = readTreeText(from.given, "case.toml");
    merge(given, overrideTree(overrides));
    from.given = treeText(given);
    from.caseText = c.resolved;
}

/// What can be done with a run that has ended before its first checkpoint.
std::string withoutCheckpoint(const std::filesystem::path& folder) {
    const std::string word = shellWord(folder.string());
    const std::string ended = fmt::format("{} holds a run with no checkpoint ({})", folder.string(), kCheckpointName);
    if (std::filesystem::exists(folder / kSettledName))
        return fmt::format(
            "{}, but with its settled bed: run its doses from there with `vkdose run --from {} --out "
            "DIR`, or start again",
            ended, word);
    return fmt::format("{}: it ended before it had made its first; start again with `vkdose run {} --out {} --force`",
                       ended, shellWord((folder / "case.toml").string()), word);
}

/// How to go on with a run that an overlap stopped; empty if it is not one.
std::string deeper(const Case& c, const RunResult& result, const RunFolder& folder) {
    const bool overlap = result.reason == StopReason::RunError && result.error.find("overlap") != std::string::npos;
    if (!overlap || !folder.checkpointTime()) return "";
    return fmt::format("; to go on from t = {:.6g} s: `vkdose resume {} --set contact.max_overlap_ratio={:.3g}`",
                       *folder.checkpointTime(), shellWord(folder.path().string()), 2 * c.world.maxOverlapRatio);
}

}  // namespace

std::optional<Diagnostic> endIsOver(const std::string& file, const Case& c, double time) {
    const double end = c.schedule.stop.endTime;
    // A run ends at the step that is nearest to the time, which may be before it.
    if (end > time + c.world.timeStep / 2) return {};
    return Diagnostic{file,
                      0,
                      "stop.end_time_s",
                      fmt::format("{}", end),
                      fmt::format("is over: the run goes on from t = {:.6g} s", time),
                      "give a later time, or leave it out"};
}

ReadyRun readyRun(const CaseOptions& input) {
    ReadyRun run;
    run.c = loadCase(input.file, input.overrides);
    (void)Timeline(run.c);
    run.filled = insertParticles(run.c);
    return run;
}

ReadyRun readyToResume(const std::filesystem::path& folder, const std::vector<std::string>& overrides) {
    requireLater(overrides, folder);
    ReadyRun run;
    if (std::filesystem::is_directory(folder)) run.lock.emplace(lockRun(folder));
    const std::filesystem::path file = folder / kCheckpointName;
    const bool over = !std::filesystem::exists(file) && std::filesystem::exists(folder / "summary.json");
    if (over && !replaces(overrides, "stop"))
        throw CheckpointError(fmt::format(
            "the run in {0} is over; there is nothing to resume. If a stop rule ended it, replace the rule: "
            "`vkdose resume {1} --set stop.max_doses=...`",
            folder.string(), shellWord(folder.string())));
    if (!over && !std::filesystem::exists(file) && holdsRun(folder)) throw CheckpointError(withoutCheckpoint(folder));
    Checkpoint from = over ? endToReopen(folder) : readCheckpoint(file);
    run.c = loadResolvedCase(from.caseText, folder / "case.toml");
    requireSameCase(folder / "case.toml", from.caseText, run.c);
    if (!overrides.empty()) {
        run.c = loadResolvedCase(from.caseText, folder / "case.toml", overrides);
        (void)Timeline(run.c);
        // The files of a run cannot be taken back to before its checkpoint.
        if (const auto past = endIsOver(kCommandLine, run.c, from.time)) throw CaseError({*past});
        if (over) requireOpen(run.c, from);
        change(from, run.c, overrides);
        run.changed = true;
    }
    run.filled = insertParticles(run.c);
    run.from = std::move(from);
    return run;
}

RunFolder folderOf(ReadyRun& run, const std::filesystem::path& folder, bool force, const Backend& backend) {
    if (!run.from) return RunFolder(folder, force, run.c, backend.description(), run.role);
    if (run.changed) {
        // In this order, so that at any moment the case is that of the checkpoint, or is written again from it.
        std::filesystem::remove(folder / "case.toml");
        writeCheckpoint(folder / kCheckpointName, *run.from);
        std::filesystem::remove(folder / kEndName);  // of a run that is not over any more
    }
    return RunFolder(folder, std::move(run.lock).value(), *run.from, run.c, backend.description());
}

Played play(ReadyRun run, Backend& backend, RunFolder& folder, RunObserver* display, const std::atomic<bool>& stop) {
    Derived derived = derive(run.c, run.filled);
    Fanout observers(folder, display);
    Played played;
    try {
        played.result = run.state ? runFrom(run.c, std::move(run.filled), std::move(derived), backend, observers, stop,
                                            run.state->run, run.state->time)
                                  : runFilled(run.c, std::move(run.filled), std::move(derived), backend, observers,
                                              stop, run.from ? &run.from->run : nullptr);
    } catch (const RecordError& e) {
        throw CheckpointError(fmt::format("{} cannot be used: {}",
                                          run.state ? run.role.origin : (folder.path() / kCheckpointName).string(),
                                          e.what()));
    }
    played.code = exitCode(played.result.reason);
    played.error = played.result.error + deeper(run.c, played.result, folder);
    if (played.result.reason == StopReason::OutputError)
        played.error += "; " + wayOn(folder);
    else
        folder.finish(run.c, played.result);
    return played;
}

std::string wayOn(const RunFolder& folder) {
    if (!folder.checkpointTime()) return withoutCheckpoint(folder.path());
    if (!std::filesystem::exists(folder.path() / kCheckpointName))
        return fmt::format("its checkpoint is gone with it; put {} back and go on with `vkdose resume`, or start again",
                           folder.path().string());
    return fmt::format("go on from t = {:.6g} s with `vkdose resume {}`", *folder.checkpointTime(),
                       shellWord(folder.path().string()));
}

}  // namespace vkdose
