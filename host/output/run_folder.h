#pragma once
// The output folder of a run: case.toml, timeseries.csv, doses.csv, frames/ and fields/ as they come,
// checkpoint.h5 while it lasts, settled.h5 once the powder has settled, end.h5, particles.csv, cycles.csv and
// summary.json at the end.

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "host/core/folder_lock.h"
#include "host/output/checkpoint.h"
#include "host/output/csv.h"
#include "host/output/field_files.h"
#include "host/output/frame_writer.h"
#include "host/output/run_history.h"
#include "host/sim/runner.h"

namespace vkdose {

/// The folder cannot be used; nothing was written.
class FolderError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// What a run is beside others.
struct RunRole {
    std::uint32_t member = 0;  ///< its number in a study
    bool keepsStates = true;   ///< for other runs to begin with
    std::string origin;        ///< the state of another run that it begins with, in words; empty: none
};

class RunFolder : public RunObserver {
  public:
    /// Creates the folder and the files that stream. Throws FolderError if the folder holds anything and `force` is not
    /// set, if another process is writing into it, or if it cannot be created. With `force` the files of a former run
    /// in it are removed and others are left alone. Then it throws FolderError if there is no run, or if a file of the
    /// case is among those to be removed. Throws OutputError if the files cannot be written; everything made until then
    /// is removed again. `backend` is the description of the backend.
    RunFolder(std::filesystem::path folder, bool force, const Case& c, std::string backend, RunRole role = {});

    /// Goes on in a folder as it was when `from` was written. The folder has been held since before `from` was read.
    /// Lines that came later are cut off. Throws FolderError if a file has been shortened since.
    RunFolder(std::filesystem::path folder, FolderLock lock, const Checkpoint& from, const Case& c,
              std::string backend);

    void onSample(const Sample& sample) override;
    void onDose(const Dose& dose) override;
    void onField(const FieldSample& sample) override { fields_->write(sample); }
    void onCheckpoint(const RunCheckpoint& checkpoint, double time) override;
    bool storesCheckpoints() const override { return true; }
    void onState(KeptState kind, const RunCheckpoint& state, double time) override;
    bool storesStates() const override { return role_.keepsStates; }
    void onFrame(const Frame& frame) override { frames_->put(frame); }
    bool storesFrames() const override { return frames_.has_value(); }

    /// Writes the end state and the summary. Removes the checkpoint of a run that is over, because it needs none any
    /// more. Throws OutputError if something cannot be written.
    void finish(const Case& c, const RunResult& result);

    const std::filesystem::path& path() const { return folder_; }

    /// Simulated time of the checkpoint in the folder [s], if it has one.
    std::optional<double> checkpointTime() const { return checkpointTime_; }

  private:
    /// Throws OutputError if one of the tables is no longer where it was.
    void storeTables();
    void store(const std::filesystem::path& name, const RunCheckpoint& state, double time);

    std::filesystem::path folder_;
    std::optional<FolderLock> lock_;
    std::string backend_;
    std::string caseText_, given_;
    RunRole role_;
    bool repeats_;  ///< a direction of the domain does
    std::optional<CsvFile> timeSeries_;
    std::optional<CsvFile> doses_;
    std::optional<FrameWriter> frames_;  ///< if the case asks for frames
    std::optional<FieldFiles> fields_;
    std::optional<double> checkpointTime_;
};

/// particles.csv: id, position [m], velocity [m/s], spin [rad/s], radius [m] and status of every particle, with enough
/// digits to read the same numbers back. With `powders`, the names by the material (powderNames), the name of its
/// powder too; with `properties` what a user's law gives each particle, under these names. Throws OutputError if it
/// cannot be written.
void writeParticles(const std::filesystem::path& file, const Particles& particles,
                    const std::vector<std::string>& powders = {}, const std::vector<std::string>& properties = {});
/// A line for each cycle, or no file where there is none. Throws OutputError likewise.
void writeCycles(const std::filesystem::path& file, const Cycles& cycles);
/// Names of the powders by their material; none with one powder.
std::vector<std::string> powderNames(const Case& c);

/// Takes the folder of a run for this process. Throws FolderError if another one holds it or it cannot be opened.
FolderLock lockRun(const std::filesystem::path& folder);

}  // namespace vkdose
