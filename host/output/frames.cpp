#include "host/output/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

#include "host/core/csv_lines.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/output/frame_files.h"
#include "host/output/hdf5.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

std::optional<Phase> phaseOf(std::string_view name) {
    for (const Phase phase : {Phase::Settle, Phase::Rotate, Phase::Rest})
        if (phaseName(phase) == name) return phase;
    return std::nullopt;
}

std::optional<FrameEntry> entryIn(const std::optional<Row>& fields) {
    if (!fields || fields->size() != 6) return std::nullopt;
    const auto number = [&](std::size_t at) { return numberIn((*fields)[at]); };
    const std::optional<Phase> phase = phaseOf((*fields)[3]);
    for (const std::size_t at : {0, 1, 2, 4, 5})
        if (!std::isfinite(number(at))) return std::nullopt;
    if (!phase || number(0) < 0 || number(1) < 0) return std::nullopt;
    return FrameEntry{static_cast<int>(number(0)),
                      static_cast<std::uint64_t>(number(1)),
                      number(2),
                      *phase,
                      static_cast<int>(number(4)),
                      number(5)};
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

std::vector<FrameEntry> framesListed(const std::string& text, const fs::path& file) {
    std::istringstream stream(text);
    CsvLines lines(stream);
    if (!lines.next() || lines.text() != kFramesHeader)
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

Frames::Frames(const fs::path& run) : folder_(run / kFramesFolder) {
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
        readParticlesFile(content(file), frame);
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
