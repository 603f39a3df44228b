#pragma once
// The output folder of a run: case.toml, timeseries.csv and doses.csv as they come, particles.csv and summary.json at
// the end.

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "host/output/csv.h"
#include "host/sim/runner.h"

namespace vkdose {

/// The folder cannot be used; nothing was written.
class FolderError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

class RunFolder : public RunObserver {
  public:
    /// Creates the folder and the files that stream. Throws FolderError if it holds anything and `force` is not set,
    /// or if it cannot be created. With `force` the files of a former run in it are removed, others left alone.
    RunFolder(std::filesystem::path folder, bool force, const Case& c);

    void onSample(const Sample& sample) override;
    void onDose(const Dose& dose) override;

    /// Writes the end state and the summary. Throws RunError if they cannot be written.
    void finish(const Case& c, const RunResult& result, const std::string& backend);

    const std::filesystem::path& path() const { return folder_; }

  private:
    std::filesystem::path folder_;
    std::optional<CsvFile> timeSeries_;
    std::optional<CsvFile> doses_;
};

/// particles.csv: id, position [m], velocity [m/s], spin [rad/s], radius [m] and status of every particle, with enough
/// digits to read the same numbers back. Throws RunError if it cannot be written.
void writeParticles(const std::filesystem::path& file, const Particles& particles);

/// "active", "dosed" or "lost".
std::string statusName(Status status);

}  // namespace vkdose
