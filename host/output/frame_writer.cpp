#include "host/output/frame_writer.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <system_error>

#include "host/core/error.h"
#include "host/core/file.h"
#include "host/output/frame_files.h"
#include "host/output/frames.h"
#include "host/output/hdf5.h"
#include "host/output/series.h"
#include "host/output/surface_files.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

fs::path madeFolder(const fs::path& run) {
    fs::path folder = run / kFramesFolder;
    createFolder(folder);
    return folder;
}

/// Times of the frames named in the first `bytes` of an index.
std::vector<double> timesIn(const fs::path& index, std::uint64_t bytes) {
    const std::optional<std::string> text = fileStart(index, bytes);
    if (!text) throw OutputError(unreadable(index));
    std::vector<double> times;
    for (const FrameEntry& e : framesListed(*text, index)) times.push_back(e.time);
    return times;
}

std::vector<const char*> kindsOf(const Case& c) {
    std::vector<const char*> kinds{kParticlesFrame};
    if (c.frames.contacts) kinds.push_back(kContactsFrame);
    if (c.world.coil) kinds.push_back(kCoilFrame);
    if (bodiesMove(c.world)) kinds.push_back(kBodiesFrame);
    return kinds;
}

std::string content(const char* kind, const Frame& frame, const World& world, std::uint32_t member) {
    const std::string_view name = kind;
    if (name == kParticlesFrame) return particlesFile(frame, world, member);
    if (name == kBodiesFrame) return bodiesFile(frame, world);
    return name == kContactsFrame ? contactsFile(frame, world) : coilFile(frame, *world.coil);
}

/// Removes the files of frames from `number` on.
void removeFrom(const fs::path& folder, int number) {
    std::error_code ignored;
    for (const char* kind : {kParticlesFrame, kContactsFrame, kCoilFrame, kBodiesFrame})
        for (int n = number; fs::remove(folder / frameFile(kind, n), ignored); ++n) {
        }
    for (int n = number; fs::remove(folder / frameStateFile(n), ignored); ++n) {
    }
}

}  // namespace

FrameWriter::FrameWriter(const fs::path& run, const Case& c, std::uint32_t member)
    : folder_(madeFolder(run)),
      world_(c.world),
      kinds_(kindsOf(c)),
      member_(member),
      walls_(hdf5::made(folder_ / kWallsFile, [&] { return wallsFile(c); })),
      index_(folder_ / kFramesIndex, csvHeader(kFrameColumns)) {}

FrameWriter::FrameWriter(const fs::path& run, const Case& c, std::uint32_t member, const CsvMark& mark)
    : folder_(run / kFramesFolder),
      world_(c.world),
      kinds_(kindsOf(c)),
      member_(member),
      times_(timesIn(folder_ / kFramesIndex, mark.bytes)),
      later_(true),
      index_(folder_ / kFramesIndex, mark) {}

void FrameWriter::put(const Frame& frame) {
    await();
    try {
        writing_ = std::async(std::launch::async, [this, frame] { write(frame); });
    } catch (const std::system_error&) {  // no thread can be had: the device waits
        write(frame);
    }
}

CsvMark FrameWriter::store() {
    await();
    writeSeries();
    return index_.store();
}

int FrameWriter::last() {
    await();
    return static_cast<int>(times_.size()) - 1;
}

void FrameWriter::await() {
    if (writing_.valid()) writing_.get();
}

void FrameWriter::write(const Frame& frame) {
    const int number = static_cast<int>(times_.size());
    if (std::exchange(later_, false)) removeFrom(folder_, number);
    if (!walls_.empty()) replaceFile(folder_ / kWallsFile, std::exchange(walls_, ""));
    for (const char* kind : kinds_) {
        const fs::path file = folder_ / frameFile(kind, number);
        replaceFile(file, hdf5::made(file, [&] { return content(kind, frame, world_, member_); }));
    }
    index_.line(
        csvRow(kFrameColumns, FrameEntry{number, frame.step, frame.time, frame.phase, frame.dose, frame.coilAngle}));
    index_.flush();
    times_.push_back(frame.time);
}

void FrameWriter::writeSeries() const {
    for (const char* kind : kinds_) {
        std::vector<SeriesFile> files;
        for (std::size_t i = 0; i < times_.size(); ++i)
            files.push_back({frameFile(kind, static_cast<int>(i)), times_[i]});
        vkdose::writeSeries(folder_ / (std::string(kind) + kFrameExtension + kSeriesExtension), files);
    }
}

}  // namespace vkdose
