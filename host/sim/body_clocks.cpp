#include "host/sim/body_clocks.h"

#include <algorithm>
#include <cmath>

namespace vkdose {

namespace {

constexpr const char* kRecorded = "body_clocks";
constexpr std::uint64_t kNoPhase = ~std::uint64_t{0};

/// The count with which a table has come to its end.
std::uint64_t endOf(const geometry::Table& table, double timeStep) {
    return static_cast<std::uint64_t>(std::ceil(table.rows.back().time / timeStep - 1e-6));  // but for rounding
}

}  // namespace

BodyClocks::BodyClocks(const World& world) : world_(world) {
    if (movesInPhases(world.bodies)) clocks_.resize(world.bodies.size());
}

void BodyClocks::enter(Phase phase, int dose) {
    const std::pair to(phase, dose);
    if (!any() || within_ == to) return;
    within_ = to;
    for (std::size_t b = 0; b < clocks_.size(); ++b) {
        const RigidBody& body = world_.bodies[b];
        if (!body.movesInPhases()) continue;
        BodyClock& clock = clocks_[b];
        clock.runs = std::find(body.phases.begin(), body.phases.end(), phase) != body.phases.end();
        if (!body.anew || phase != body.phases.front() || clock.steps == 0) continue;
        // A body must not jump, so a table that is not at its end first comes there.
        const std::uint64_t end = endOf(std::get<geometry::Table>(body.course.motion), world_.timeStep);
        clock.anewAt = end;
        if (clock.steps < end) continue;
        clock.steps = 0;
        clock.anewAt = BodyClock::kNever;
    }
}

std::vector<double> BodyClocks::times() const {
    std::vector<double> times;
    for (const BodyClock& clock : clocks_) times.push_back(static_cast<double>(clock.steps) * world_.timeStep);
    return times;
}

void BodyClocks::save(Record& record) const {
    if (!any()) return;
    std::vector<std::uint64_t> words{within_ ? static_cast<std::uint64_t>(within_->first) : kNoPhase,
                                     static_cast<std::uint64_t>(within_ ? within_->second : 0)};
    for (const BodyClock& clock : clocks_)
        words.insert(words.end(), {clock.steps, clock.runs ? std::uint64_t{1} : std::uint64_t{0}, clock.anewAt});
    record.put(kRecorded, std::move(words));
}

void BodyClocks::restore(const Record& record) {
    if (!any() || !record.arrays().contains(kRecorded)) return;
    const auto& words = record.get<std::uint64_t>(kRecorded, 2 + 3 * clocks_.size());
    within_.reset();
    if (words[0] != kNoPhase) within_.emplace(static_cast<Phase>(words[0]), static_cast<int>(words[1]));
    for (std::size_t b = 0; b < clocks_.size(); ++b)
        clocks_[b] = {words[2 + 3 * b], words[3 + 3 * b] != 0, words[4 + 3 * b]};
}

void BodyClocks::takeOver(const Record& record, double ratio) {
    restore(record);
    if (within_ && within_->first != Phase::Settle) within_.reset();
    for (std::size_t b = 0; b < clocks_.size(); ++b) {
        BodyClock& clock = clocks_[b];
        clock.steps = static_cast<std::uint64_t>(std::llround(static_cast<double>(clock.steps) * ratio));
        if (clock.anewAt != BodyClock::kNever)
            clock.anewAt = endOf(std::get<geometry::Table>(world_.bodies[b].course.motion), world_.timeStep);
    }
}

}  // namespace vkdose
