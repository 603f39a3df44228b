#include "host/output/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <tuple>
#include <utility>

#include "host/core/csv_lines.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/output/frame_files.h"
#include "host/output/hdf5.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

std::optional<FrameEntry> entryIn(const std::optional<Row>& fields) {
    if (!fields || fields->size() != std::tuple_size_v<decltype(kFrameColumns)>) return std::nullopt;
    FrameEntry entry;
    bool good = true;
    auto next = fields->begin();
    readRow(
        kFrameColumns, entry, [&](const char*) { return *next++; }, [&](const char*) { good = false; });
    if (!std::isfinite(entry.time) || !std::isfinite(entry.coilAngle)) good = false;
    return good ? std::optional(entry) : std::nullopt;
}

std::string content(const fs::path& file) {
    std::optional<std::string> bytes = fileContent(file);
    if (!bytes) throw OutputError(unreadable(file));
    return *std::move(bytes);
}

}  // namespace

std::string frameFile(const char* kind, int number) {
    return fmt::format("{}_{:06}{}", kind, number, kFrameExtension);
}

std::string frameStateFile(int number) {
    return fmt::format("{}_{:06}{}", kFrameState, number, kFrameStateExtension);
}

std::vector<FrameEntry> framesListed(const std::string& text, const fs::path& file) {
    std::istringstream stream(text);
    CsvLines lines(stream);
    if (!lines.next() || lines.text() != csvHeader(kFrameColumns))
        throw OutputError(fmt::format("{} is no list of frames", file.string()));
    std::vector<FrameEntry> entries;
    while (lines.next() && lines.ended()) {  // a line without its end is still being written
        const std::optional<FrameEntry> entry = entryIn(lines.fields());
        if (!entry)
            throw OutputError(
                Diagnostic{file.string(), lines.number(), lines.text(), "", "is no frame of a run", ""}.text());
        entries.push_back(*entry);
    }
    return entries;
}

std::size_t nearestOf(const std::vector<FrameEntry>& entries, double time) {
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < entries.size(); ++i)
        if (std::abs(entries[i].time - time) <= std::abs(entries[nearest].time - time)) nearest = i;
    return nearest;
}

std::size_t settledOf(const std::vector<FrameEntry>& entries) {
    std::size_t settled = 0;
    for (std::size_t i = 0; i < entries.size(); ++i)
        if (entries[i].dose == 0) settled = i;
    return settled;
}

Frames::Frames(const fs::path& run, std::vector<std::string> properties)
    : folder_(run / kFramesFolder), properties_(std::move(properties)) {
    const fs::path index = folder_ / kFramesIndex;
    if (fs::exists(index)) entries_ = framesListed(content(index), index);
}

Frame Frames::read(const FrameEntry& entry) const {
    Frame frame;
    fs::path file = folder_ / frameFile(kParticlesFrame, entry.number);
    if (!fs::exists(file))
        throw OutputError(fmt::format("{} lists frame {}, but there is no file {}", (folder_ / kFramesIndex).string(),
                                      entry.number, file.string()));
    try {
        readParticlesFile(content(file), frame, properties_);
        const fs::path contacts = folder_ / frameFile(kContactsFrame, entry.number);
        if (!fs::exists(contacts)) return frame;
        file = contacts;
        readContactsFile(content(file), frame);
    } catch (const hdf5::Error& e) {
        throw OutputError(fmt::format("{} is no frame of vkdose: {}", file.string(), e.what()));
    }
    return frame;
}

}  // namespace vkdose
