#pragma once
// Plays a run into its output folder and prints nothing. Commands use it, and members of an ensemble.

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>

#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/output/run_folder.h"

namespace vkdose {

/// All that a run needs beside a backend.
struct ReadyRun {
    Case c;
    Insertion filled;
    std::optional<Checkpoint> from;   ///< to go on from
    std::optional<Checkpoint> state;  ///< of another run, to begin with
    RunRole role;                     ///< if it starts
    bool changed = false;             ///< it goes on with another case than before
    std::optional<FolderLock> lock;   ///< of the folder it goes on in
};

/// A run from its start. Throws CaseError.
ReadyRun readyRun(const CaseOptions& input);

/// A run that goes on from the checkpoint in `folder`. Locks the folder for this process, so that no other run changes
/// it. Throws FolderError if another process holds the lock, CheckpointError if there is no checkpoint or the run is
/// over, and CaseError, also for an override of a key that would have changed what has been.
ReadyRun readyToResume(const std::filesystem::path& folder, const std::vector<std::string>& overrides = {});

/// Why a run cannot go on from a state at `time` [s]: its end is not later. None if it can.
std::optional<Diagnostic> endIsOver(const std::string& file, const Case& c, double time);

/// Goes on in the folder, or starts over in it as `force` allows (RunFolder).
RunFolder folderOf(ReadyRun& run, const std::filesystem::path& folder, bool force, const Backend& backend);

struct Played {
    RunResult result;
    ExitCode code = kOk;
    std::string error;  ///< what stopped it; empty if nothing did
};

/// Plays `run` and finishes its folder. If a result could not be stored, `error` says how to go on. `display`, if
/// given, is told of progress and doses. Throws CheckpointError if the checkpoint does not fit its case.
Played play(ReadyRun run, Backend& backend, RunFolder& folder, RunObserver* display, const std::atomic<bool>& stop);

/// How to go on with a run that ended before it was over.
std::string wayOn(const RunFolder& folder);

}  // namespace vkdose
