#pragma once
// The checkpoint file: an HDF5 file with a user block (its first 512 bytes, in plain text) that names format, version,
// length and checksum. The block lets vkdose refuse a foreign, cut or damaged file before it trusts anything in it.
//
//   /program /backend /case           texts: version of vkdose, description of the backend, the resolved case
//   /given                            text: the case as it was given
//   /origin                           text: the state of another run that this one began with; empty or lacking: none
//   /run/*                            the runner's state          (RunCheckpoint::run)
//   /state/*                          the backend's snapshot      (RunCheckpoint::backend)
//   /when/time                        simulated time [s]
//   /when/timeseries, doses, fields   bytes of the CSV files at that time
//   /when/frames                      bytes of frames.csv; 0: the run keeps no frames
//   /when/checksums                   CRC-32 of these: time series, doses, frames, every field
//   /when/member                      number of the run in its study; 0: it is in none
//   /when/keeps_states                0: the run keeps no states for others

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/output/csv.h"
#include "host/sim/runner.h"

namespace vkdose {

inline constexpr const char* kCheckpointName = "checkpoint.h5";
/// States in the same format that a run leaves for others to begin with: the settled bed, and its end.
inline constexpr const char* kSettledName = "settled.h5";
inline constexpr const char* kEndName = "end.h5";

/// The checkpoint cannot be used: there is none, it is cut, damaged, of another format or does not fit.
class CheckpointError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct Checkpoint {
    std::string program;  ///< version of the vkdose that wrote it
    std::string backend;  ///< "reference", or "vulkan: device"
    std::string caseText;
    double time = 0;  ///< simulated [s]
    RunCheckpoint run;
    CsvMark timeSeries, doses, frames;
    std::vector<CsvMark> fields;  ///< of every field of the case
    std::uint32_t member = 0;     ///< number of the run in its study
    std::string given;            ///< Case::given
    std::string origin;           ///< the state of another run that this one began with, in words; empty: none
    bool keepsStates = true;      ///< for others to begin with
};

/// Replaces `file` in one move. Throws OutputError if it cannot be written; the checkpoint before is then still there.
void writeCheckpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

/// Throws CheckpointError, which names the file and what is wrong with it.
Checkpoint readCheckpoint(const std::filesystem::path& file);

}  // namespace vkdose
