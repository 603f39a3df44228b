#include "host/app/run_states.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host/app/backends.h"
#include "host/core/file.h"
#include "host/output/end_state.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

Case caseOf(const fs::path& folder) {
    const fs::path file = folder / "case.toml";
    const std::optional<std::string> text = fileContent(file);
    if (!text) throw UsageError(fmt::format("{} is no output folder of a run: it holds no case.toml", folder.string()));
    return loadResolvedCase(*text, file);
}

FrameEntry entryOf(const Frame& frame) {
    return {0, frame.step, frame.time, frame.phase, frame.dose, frame.coilAngle};
}

}  // namespace

RunStates::RunStates(const fs::path& folder)
    : case_(caseOf(folder)), frames_(std::in_place, folder, case_.world.properties), entries_(frames_->entries()) {
    if (!entries_.empty()) return;
    if (!fs::exists(folder / "summary.json"))
        throw UsageError(
            fmt::format("{} holds neither frames nor an end: the run has to come to one first", folder.string()));
    only_ = readEndState(folder, case_);
    entries_ = {entryOf(*only_)};
}

RunStates::RunStates(Case c) : case_(std::move(c)), only_(Frame{}) {
    only_->particles = insertParticles(case_).particles;
    entries_ = {entryOf(*only_)};
}

Frame RunStates::read(std::size_t entry) const {
    return only_ ? *only_ : frames_->read(entries_.at(entry));
}

std::size_t RunStates::at(double time) const {
    const double first = entries_.front().time, last = entries_.back().time;
    const double between = entries_.size() > 1 ? (last - first) / double(entries_.size() - 1) : 1e-6 * last;
    if (!(time >= first - between) || !(time <= last + between))
        throw UsageError(
            hasFrames()
                ? fmt::format("there is no frame at {:.4g} s; {} frames reach from {:.4g} to {:.4g} s", time,
                              entries_.size(), first, last)
                : fmt::format("there is no frame at {:.4g} s: the run kept none ([frames] in its case does), only "
                              "its end at {:.4g} s",
                              time, last));
    return nearestOf(entries_, time);
}

double RunStates::massLeft(std::size_t entry) const {
    const Particles p = read(entry).particles;
    double mass = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
        if (p.status[i] == Status::Active) mass += massOf(case_.world, p, i);
    return mass;
}

std::vector<std::size_t> RunStates::story() const {
    const std::size_t first = settled(), last = entries_.size() - 1;
    std::size_t turned = first;
    for (std::size_t i = first; i <= last; ++i)
        if (entries_[i].dose == 1 && entries_[i].phase == Phase::Rotate) turned = i;
    const double filled = massLeft(first), left = massLeft(last);
    // The mass in the canister only falls, so a binary search finds the state and reads few frames.
    const auto firstWith = [&](double mass) {  // no more than this left
        std::size_t low = first, high = last;
        while (low < high) {
            const std::size_t middle = (low + high) / 2;
            if (massLeft(middle) <= mass)
                high = middle;
            else
                low = middle + 1;
        }
        return low;
    };
    const std::size_t half = firstWith(0.5 * (filled + left));
    const std::size_t late = left >= 0.1 * filled ? last : std::max(first, firstWith(0.1 * filled) - 1);
    std::vector<std::size_t> story{first, turned, half, late};
    std::sort(story.begin(), story.end());
    story.erase(std::unique(story.begin(), story.end()), story.end());
    return story;
}

}  // namespace vkdose
