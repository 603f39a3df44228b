// The contacts as a record, and back: every number that the next step depends on.

#include <fmt/format.h>

#include "host/backend/reference/forces.h"

namespace vkdose::reference {

namespace {

/// The rows that a contact of the record is in.
enum Row : std::uint32_t { kPair, kSurface, kOnBody };

/// Calls `visit` for every number of a contact's history, in a fixed order; a flag is visited as 0 or 1.
template <class Visit>
void eachNumber(History& h, Visit visit) {
    visit(h.maxOverlap);
    for (int d = 0; d < 3; ++d) visit(h.sliding[d]);
    for (int d = 0; d < 3; ++d) visit(h.rolling[d]);
    visit(h.torsion);
    visit(h.overlap);
    for (double& x : h.own) visit(x);
    visit(h.stiffness);
}

template <class Visit>
void eachNumber(Exerted& e, Visit visit) {
    const auto flag = [&](bool& b) {
        double number = b ? 1 : 0;
        visit(number);
        b = number != 0;
    };
    flag(e.touching);
    flag(e.parts.adhesive);
    flag(e.parts.slides);
    flag(e.parts.rolls);
    flag(e.parts.twists);
    for (Vec3* v : {&e.normal, &e.leverI, &e.leverJ, &e.parts.sliding, &e.parts.rolling, &e.parts.torsion})
        for (int d = 0; d < 3; ++d) visit((*v)[d]);
    for (double* x : {&e.overlap, &e.parts.hysteretic, &e.parts.damping, &e.parts.kt, &e.parts.kr, &e.parts.kTo,
                      &e.parts.share, &e.elastic.normal, &e.elastic.sliding, &e.elastic.rolling, &e.elastic.torsion})
        visit(*x);
    double law = double(e.parts.law);
    visit(law);
    e.parts.law = NormalLaw(int(law));
}

}  // namespace

void Forces::save(Record& record) const {
    std::vector<std::uint32_t> ends;
    std::vector<double> numbers, direction;
    const auto add = [&](std::uint32_t kind, std::size_t i, std::size_t other, History history, Exerted exerted) {
        ends.insert(ends.end(), {kind, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(other)});
        const auto push = [&](double& x) { numbers.push_back(x); };
        eachNumber(history, push);
        eachNumber(exerted, push);
    };
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
        for (const Known& k : pairs_[i]) add(kPair, i, k.other, k.history, k.exerted);
        for (const Known& k : surfaces_[i]) add(kSurface, i, k.other, k.history, k.exerted);
        for (const OnBody& c : onBodies_[i]) {
            add(kOnBody, i, c.body, c.history, c.exerted);
            direction.insert(direction.end(), {c.direction.x, c.direction.y, c.direction.z});
        }
    }
    record.put("contact_ends", std::move(ends));
    record.put("contact_numbers", std::move(numbers));
    record.put("contact_direction", std::move(direction));
}

void Forces::restore(const Record& record) {
    const auto& ends = record.get<std::uint32_t>("contact_ends");
    const std::size_t count = ends.size() / 3;
    if (ends.size() % 3 != 0) throw RecordError("contact_ends is not of three numbers for each contact");
    std::size_t each = 0, onBodies = 0;
    for (std::size_t c = 0; c < count; ++c) onBodies += ends[3 * c] == kOnBody ? 1 : 0;
    const auto& directions = record.get<double>("contact_direction", 3 * onBodies);
    History history;
    Exerted exerted;
    const auto tally = [&](double&) { ++each; };
    eachNumber(history, tally);
    eachNumber(exerted, tally);
    const auto& numbers = record.get<double>("contact_numbers", each * count);
    auto next = numbers.begin();
    auto direction = directions.begin();
    const auto take = [&](double& x) { x = *next++; };
    for (std::size_t c = 0; c < count; ++c) {
        const std::uint32_t kind = ends[3 * c], particle = ends[3 * c + 1], other = ends[3 * c + 2];
        eachNumber(history, take);
        eachNumber(exerted, take);
        if (particle >= pairs_.size() || kind > kOnBody || (kind == kOnBody && other >= bodies_.size()))
            throw RecordError(fmt::format("contact {} is of a particle or body that there is not", c));
        // The contacts were saved in ascending order, so that every row is ascending again.
        if (kind == kOnBody) {
            Vec3 d;
            for (int axis = 0; axis < 3; ++axis) d[axis] = *direction++;
            onBodies_[particle].push_back({other, d, history, exerted});
        } else {
            (kind == kPair ? pairs_ : surfaces_)[particle].push_back({other, history, exerted});
        }
    }
}

}  // namespace vkdose::reference
