#pragma once
// Writes the frames of a run as they come (frames.h reads them). It uses a thread of its own, so that the device goes
// on meanwhile. Every file appears whole, and a frame is named in frames.csv once its files are there.

#include <cstdint>
#include <filesystem>
#include <future>

#include "host/model/case.h"
#include "host/output/csv.h"
#include "host/sim/frame.h"

namespace vkdose {

class FrameWriter {
  public:
    /// For a new run with this output folder, which holds no frames. Throws OutputError if it cannot be written.
    FrameWriter(const std::filesystem::path& run, const Case& c, std::uint32_t member);

    /// For a run that goes on from a checkpoint, written when frames.csv was as `mark` says. Later frames are replaced
    /// when the first frame is put. Throws OutputError likewise, or if frames are missing.
    FrameWriter(const std::filesystem::path& run, const Case& c, std::uint32_t member, const CsvMark& mark);

    FrameWriter(const FrameWriter&) = delete;
    FrameWriter& operator=(const FrameWriter&) = delete;
    ~FrameWriter() = default;

    /// Returns at once, unless the frame before is still being written: then it waits for that. If no thread can be had
    /// it writes the frame itself. Throws OutputError if writing failed; as a rule the error is that of the frame
    /// before.
    void put(const Frame& frame);

    /// Waits until all is written and survives a crash of the machine, and brings the series files up to date. Returns
    /// the state of frames.csv. Throws OutputError if writing failed.
    CsvMark store();

    /// Number of the frame that was put last. Waits until it is written. Throws OutputError if that failed.
    int last();

  private:
    void await();
    void writeSeries() const;
    void write(const Frame& frame);

    std::filesystem::path folder_;
    World world_;
    std::vector<const char*> kinds_;  ///< of files that each frame has
    std::uint32_t member_;
    std::vector<double> times_;  ///< of the frames so far [s]
    std::string walls_;          ///< a file that comes with the first frame
    bool later_ = false;         ///< there may be frames beyond these
    CsvFile index_;
    std::future<void> writing_;  ///< the last member, so that the writing has ended before the others are destroyed
};

}  // namespace vkdose
