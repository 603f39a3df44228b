#pragma once
// The frames of a run, in frames/ of its output folder: the powder as it was at the intervals the case asks for. Each
// is a VTKHDF file of the particles, one of the coil and, if asked for, one of the contacts (frame_files.h);
// frames.csv lists them, and a series file for each kind tells ParaView their times. FrameWriter makes them.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "host/core/columns.h"
#include "host/sim/frame.h"
#include "host/sim/sample.h"

namespace vkdose {

inline constexpr const char* kFramesFolder = "frames";
inline constexpr const char* kFramesIndex = "frames.csv";
inline constexpr const char* kFrameExtension = ".hdf";  ///< the one by which ParaView 5.11 knows VTKHDF files
inline constexpr const char* kParticlesFrame = "particles";
inline constexpr const char* kContactsFrame = "contacts";
inline constexpr const char* kCoilFrame = "coil";
inline constexpr const char* kBodiesFrame = "bodies";
inline constexpr const char* kWallsFile = "walls.hdf";

/// "particles_000012.hdf": by such names ParaView takes the files of a kind for a series.
std::string frameFile(const char* kind, int number);

/// "state_000012.h5": the state of the run at a frame, in the format of a checkpoint.
std::string frameStateFile(int number);
inline constexpr const char* kFrameState = "state";
inline constexpr const char* kFrameStateExtension = ".h5";

/// A frame without its particles.
struct FrameEntry {
    int number = 0;  ///< from 0, in the order of time
    std::uint64_t step = 0;
    double time = 0;  ///< [s]
    Phase phase = Phase::Settle;
    int dose = 0;
    double coilAngle = 0;  ///< as in Frame [rad]
};

/// The columns of frames.csv.
inline constexpr auto kFrameColumns = columns(
    column<&FrameEntry::number>("frame", "1", "Number of the frame, from 0: that in the names of its files."),
    column<&FrameEntry::step>("step", "1", "Number of time steps made."),
    column<&FrameEntry::time>("time_s", "s", "Simulated time.", kAllDigits),
    column<&FrameEntry::phase>(
        "phase", "", "What the schedule asks for in the time before the frame: settle, rotate, reverse or rest."),
    column<&FrameEntry::dose>("dose", "1", "Number of the dose, from 1; 0 while settling."),
    column<&FrameEntry::coilAngle>("coil_angle_rad", "rad", kCoilAngleMeaning, kAllDigits));

/// The frames that the text of a frames.csv lists. A line still being written does not count. Throws OutputError, which
/// names `file`, if the text is no such table.
std::vector<FrameEntry> framesListed(const std::string& text, const std::filesystem::path& file);

/// Index of the entry nearest to a time [s]. Of two equally near it is the later. There must be an entry.
std::size_t nearestOf(const std::vector<FrameEntry>& entries, double time);

/// Index of the last entry before the first dose: the powder as it lay when the coil began to turn. If there is none,
/// index of the first entry.
std::size_t settledOf(const std::vector<FrameEntry>& entries);

/// Reads the frames of a run. The run may still go on.
class Frames {
  public:
    /// Opens the frames of the run with this output folder; there are none if it kept none. Throws OutputError if the
    /// files there cannot be read.
    /// `properties` of a user's law are read too, if the frames have them (World::properties).
    explicit Frames(const std::filesystem::path& run, std::vector<std::string> properties = {});

    const std::vector<FrameEntry>& entries() const { return entries_; }

    /// Particles, and contacts if the run kept them. Throws OutputError if the frame's file cannot be read.
    Frame read(const FrameEntry& entry) const;

  private:
    std::filesystem::path folder_;
    std::vector<std::string> properties_;
    std::vector<FrameEntry> entries_;
};

}  // namespace vkdose
