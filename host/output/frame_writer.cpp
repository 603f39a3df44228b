#include "host/output/frame_writer.h"

#include <fmt/format.h>

#include <fstream>
#include <string>
#include <system_error>

#include "host/core/error.h"
#include "host/output/frame_files.h"
#include "host/output/frames.h"
#include "host/output/hdf5.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

fs::path madeFolder(const fs::path& run) {
    fs::path folder = run / kFramesFolder;
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw OutputError(fmt::format("cannot create {}: {}", folder.string(), error.message()));
    return folder;
}

fs::path emptied(const fs::path& run) {
    FrameWriter::remove(run);
    return madeFolder(run);
}

/// Frames named in the first `bytes` of an index.
int framesIn(const fs::path& index, std::uint64_t bytes) {
    std::ifstream stream(index, std::ios::binary);
    int lines = 0;
    for (char c = 0; bytes > 0 && stream.get(c); --bytes) lines += c == '\n' ? 1 : 0;
    return lines - 1;
}

/// Removes the files of frames from `number` on.
void removeFrom(const fs::path& folder, int number) {
    std::error_code ignored;
    for (const char* kind : {kParticlesFrame, kContactsFrame})
        for (int n = number; fs::remove(folder / frameFile(kind, n), ignored); ++n) {
        }
}

}  // namespace

FrameWriter::FrameWriter(const fs::path& run, const Case& c, std::uint32_t member)
    : folder_(emptied(run)),
      world_(c.world),
      contacts_(c.frames.contacts),
      member_(member),
      index_(folder_ / kFramesIndex, kFramesHeader) {}

FrameWriter::FrameWriter(const fs::path& run, const Case& c, std::uint32_t member, std::uint64_t bytes)
    : folder_(run / kFramesFolder),
      world_(c.world),
      contacts_(c.frames.contacts),
      member_(member),
      number_(framesIn(folder_ / kFramesIndex, bytes)),
      later_(true),
      index_(folder_ / kFramesIndex, bytes) {
    if (number_ < 0) throw OutputError(fmt::format("{} lacks its header", (folder_ / kFramesIndex).string()));
}

void FrameWriter::put(const Frame& frame) {
    await();
    writing_ = std::async(std::launch::async, [this, frame] { write(frame); });
}

std::uint64_t FrameWriter::store() {
    await();
    return index_.store();
}

void FrameWriter::await() {
    if (writing_.valid()) writing_.get();
}

void FrameWriter::write(const Frame& frame) {
    if (std::exchange(later_, false)) removeFrom(folder_, number_);
    try {
        replaceFile(folder_ / frameFile(kParticlesFrame, number_), particlesFile(frame, world_, member_));
        if (contacts_) replaceFile(folder_ / frameFile(kContactsFrame, number_), contactsFile(frame, world_));
    } catch (const hdf5::Error& e) {
        throw OutputError(fmt::format("cannot make frame {} of {}: {}", number_, folder_.string(), e.what()));
    }
    index_.line(fmt::format("{},{},{},{},{},{}", number_, frame.step, frame.time, phaseName(frame.phase), frame.dose,
                            frame.coilAngle));
    index_.flush();
    ++number_;
}

void FrameWriter::remove(const fs::path& run) {
    const fs::path folder = run / kFramesFolder;
    std::error_code error;
    std::vector<fs::path> ours;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        if (name == kFramesIndex || entry.path().extension() == kFrameExtension) ours.push_back(entry.path());
    }
    for (const fs::path& file : ours) fs::remove(file, error);
    fs::remove(folder, error);  // stays if something else is in it
}

}  // namespace vkdose
