#include "host/output/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>
#include <sstream>

#include "host/core/error.h"
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

std::optional<FrameEntry> entryIn(const std::string& line) {
    FrameEntry e;
    std::array<char, 16> phase{};
    int end = 0;
    const int fields = std::sscanf(line.c_str(), "%d,%" SCNu64 ",%lf,%15[a-z],%d,%lf%n", &e.number, &e.step, &e.time,
                                   phase.data(), &e.dose, &e.coilAngle, &end);
    const std::optional<Phase> found = phaseOf(phase.data());
    if (fields != 6 || static_cast<std::size_t>(end) != line.size() || !found) return std::nullopt;
    e.phase = *found;
    return e;
}

std::string content(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw OutputError(fmt::format("cannot read {}", file.string()));
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

}  // namespace

std::string frameFile(const char* kind, int number) {
    return fmt::format("{}_{:06}{}", kind, number, kFrameExtension);
}

std::vector<FrameEntry> framesListed(const std::string& text, const fs::path& file) {
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    if (line != kFramesHeader) throw OutputError(fmt::format("{} is no list of frames", file.string()));
    std::vector<FrameEntry> entries;
    while (std::getline(lines, line)) {
        if (lines.eof()) break;  // still being written
        const std::optional<FrameEntry> entry = entryIn(line);
        if (!entry) throw OutputError(fmt::format("{} has a line that is no frame: {}", file.string(), line));
        entries.push_back(*entry);
    }
    return entries;
}

Frames::Frames(const fs::path& run) : folder_(run / kFramesFolder) {
    const fs::path index = folder_ / kFramesIndex;
    if (fs::exists(index)) entries_ = framesListed(content(index), index);
}

const FrameEntry& Frames::nearest(double time) const {
    return *std::min_element(entries_.rbegin(), entries_.rend(), [time](const FrameEntry& a, const FrameEntry& b) {
        return std::abs(a.time - time) < std::abs(b.time - time);
    });
}

Frame Frames::read(const FrameEntry& entry) const {
    Frame frame;
    fs::path file = folder_ / frameFile(kParticlesFrame, entry.number);
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
