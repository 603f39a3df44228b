#include "host/backend/vulkan/snapshot.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "host/backend/vulkan/pack.h"

namespace vkdose {

namespace {

using gpu::uvec4;
using gpu::vec4;

constexpr const char* kSpeedLow = "speed_low";
constexpr const char* kProperties = "properties";

/// Reads `count` vectors, from `first` on, of each of `rows` rows that are `stride` vectors long.
std::vector<float> packed(const vk::Buffer& from, std::size_t rows, std::size_t stride, std::size_t first,
                          std::size_t count) {
    std::vector<float> values;
    values.reserve(4 * rows * count);
    for (std::size_t row = 0; row < rows; ++row)
        for (const vec4& v : from.readAll<vec4>(count, (row * stride + first) * sizeof(vec4)))
            for (int c = 0; c < 4; ++c) values.push_back(v[c]);
    return values;
}

/// The inverse of `packed`: writes the vectors into the device's table.
void unpack(const std::vector<float>& values, std::size_t rows, std::size_t stride, std::size_t first,
            std::size_t count, vk::Buffer& to) {
    std::vector<vec4> part(count);
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t i = 0; i < count; ++i)
            for (int c = 0; c < 4; ++c) part[i][c] = values[4 * (row * count + i) + c];
        to.writeAll(part, (row * stride + first) * sizeof(vec4));
    }
}

/// Saves the contacts that keep springs in a slot: their two bodies and their histories.
void saveContacts(const Passes& passes, std::uint32_t member, Record& record) {
    std::vector<std::uint32_t> pairs, particles, others;
    std::vector<float> springs;
    for (const SlotContact& c : touchingSlots(passes, member)) {
        pairs.push_back(c.pair ? 1 : 0);
        particles.push_back(c.particle);
        others.push_back(c.other);
        for (std::size_t part = 0; part < passes.sizes.historyParts(); ++part)
            for (int k = 0; k < 4; ++k) springs.push_back(c.history[part][k]);
    }
    record.put("contact_is_pair", std::move(pairs));
    record.put("contact_particle", std::move(particles));
    record.put("contact_other", std::move(others));
    record.put("contact_history", std::move(springs));
}

/// Saves the contacts with bodies.
void saveBodies(const Passes& passes, std::uint32_t member, Record& record) {
    if (passes.sizes.bodies == 0) return;
    std::vector<std::uint32_t> particles, bodies;
    std::vector<float> springs;
    for (const PlaceContact& c : touchingPlaces(passes, member)) {
        particles.push_back(c.particle);
        bodies.push_back(c.body);
        for (std::size_t part = 0; part < passes.sizes.placeParts(); ++part)
            for (int k = 0; k < 4; ++k) springs.push_back(c.history[part][k]);
    }
    record.put("body_particle", std::move(particles));
    record.put("body_number", std::move(bodies));
    record.put("body_history", std::move(springs));
}

/// The slots of the bodies as a record has them.
struct BodySlots {
    std::vector<glm::uvec2> entries;
    std::vector<vec4> history;                   ///< TableSizes::bodyHistory() for each entry
    std::vector<std::vector<std::uint32_t>> of;  ///< the slots of each particle
};

BodySlots bodySlotsOf(const Passes& passes, std::uint32_t member, std::size_t particles, const Record& record) {
    const TableSizes& t = passes.sizes;
    BodySlots slots;
    slots.of.resize(particles);
    if (t.bodies == 0) return slots;
    const auto& owner = record.get<std::uint32_t>("body_particle");
    const auto& body = record.get<std::uint32_t>("body_number", owner.size());
    const std::size_t parts = t.placeParts();
    const auto& springs = record.get<float>("body_history", 4 * parts * owner.size());
    std::size_t touches = 0;  // in the slot that was begun last
    for (std::size_t c = 0; c < owner.size(); ++c) {
        if (owner[c] >= particles || body[c] >= t.bodies)
            throw RecordError("body_particle or body_number names what there is not");
        const bool same = c > 0 && owner[c] == owner[c - 1] && body[c] == body[c - 1];
        if (c > 0 && std::pair(owner[c], body[c]) < std::pair(owner[c - 1], body[c - 1]))
            throw RecordError("body_particle is not in order");
        if (!same) {
            if (slots.entries.size() == t.bodySlots) throw RecordError("there are too many contacts with bodies");
            slots.of[owner[c]].push_back(t.firstBodySlot(member) + std::uint32_t(slots.entries.size()));
            slots.entries.emplace_back(member * t.share + owner[c], body[c]);
            slots.history.resize(slots.history.size() + t.bodyHistory(), vec4(0.0f));
            touches = 0;
        }
        if (touches++ == std::min(t.mostPlaces, gpu::kMaxBodyTouches))
            throw RecordError("a body is touched in too many places");
        // The vector of the direction tells the place, counted from 1; of older records the order does.
        const float stored = springs[4 * (parts * c + 2) + 3], place = stored == 0 ? float(touches) : stored;
        if (!(place >= float(touches) && place <= float(gpu::kMaxBodyTouches) && place == std::floor(place)))
            throw RecordError("body_history names a place that there is not, or not in order");
        vec4* vectors = &slots.history[slots.history.size() - t.bodyHistory() + parts * (std::size_t(place) - 1)];
        for (std::size_t part = 0; part < parts; ++part) {
            const float* v = &springs[4 * (parts * c + part)];
            vectors[part] = vec4(v[0], v[1], v[2], v[3]);
        }
        vectors[2].w = place;
    }
    return slots;
}

/// Consecutive slots, from `first` on.
struct SlotRun {
    std::uint32_t first, room;
    std::vector<glm::uvec2> entries;
    std::array<std::vector<vec4>, 6> history;  ///< parts 0 and 1 together, 2, 3 ...

    void write(Passes& passes) const {
        passes.entries.writeAll(entries, passes.at.entryIndex(first) * sizeof(glm::uvec2));
        passes.history.writeAll(history[0], passes.at.springIndex(first, 0) * sizeof(vec4));
        for (std::uint32_t part = 2; part < passes.sizes.historyParts(); ++part)
            passes.history.writeAll(history[part - 1], passes.at.exertedIndex(part - 2, first) * sizeof(vec4));
    }
};

/// Lists the contacts that touched in the way of a refresh, so that the next refresh carries their histories on.
/// Sets Control::listed for these lists.
void restoreContacts(Passes& passes, std::uint32_t member, std::size_t particles, const Record& record,
                     gpu::Control& control) {
    const TableSizes& t = passes.sizes;
    const BodySlots bodies = bodySlotsOf(passes, member, particles, record);
    const auto& owner = record.get<std::uint32_t>("contact_particle");
    const std::size_t count = owner.size(), parts = t.historyParts();
    const auto& isPair = record.get<std::uint32_t>("contact_is_pair", count);
    const auto& other = record.get<std::uint32_t>("contact_other", count);
    const auto& springs = record.get<float>("contact_history", 4 * parts * count);
    const std::uint32_t firstParticle = member * t.share, firstLink = member * t.linkEntries;
    SlotRun pairs{t.firstPairSlot(member), t.pairSlots, {}, {}};
    SlotRun surfaces{t.firstSurfaceSlot(member), t.surfaceSlots, {}, {}};
    std::vector<std::vector<std::uint32_t>> slotsOf(particles);
    std::vector<uvec4> owned(t.share, uvec4(0U));
    for (std::size_t c = 0; c < count; ++c) {
        const bool pair = isPair[c] != 0;
        if (owner[c] >= particles || other[c] >= (pair ? particles : t.surfaces))
            throw RecordError("contact_particle or contact_other names what there is not");
        const auto place = [&](std::size_t k) { return std::tuple(owner[k], isPair[k] == 0, other[k]); };
        if (c > 0 && place(c) <= place(c - 1)) throw RecordError("contact_particle or contact_other is not in order");
        SlotRun& run = pair ? pairs : surfaces;
        if (run.entries.size() == run.room) throw RecordError("there are too many contacts");
        const std::uint32_t slot = run.first + std::uint32_t(run.entries.size());
        slotsOf[owner[c]].push_back(slot);
        uvec4& ofOwner = owned[owner[c]];
        std::uint32_t &first = pair ? ofOwner.x : ofOwner.z, &held = pair ? ofOwner.y : ofOwner.w;
        if (held++ == 0) first = slot;
        run.entries.emplace_back(firstParticle + owner[c], pair ? firstParticle + other[c] : other[c]);
        for (std::size_t part = 0; part < parts; ++part) {
            const float* v = &springs[4 * (parts * c + part)];
            run.history[part < 2 ? 0 : part - 1].emplace_back(v[0], v[1], v[2], v[3]);
        }
    }
    std::vector<std::uint32_t> links;
    std::vector<uvec4> ranges(t.share, uvec4(0U));
    for (std::size_t i = 0; i < particles; ++i) {
        ranges[i].z = firstLink + std::uint32_t(links.size());
        for (const auto& slots : {slotsOf[i], bodies.of[i]})
            for (const std::uint32_t slot : slots) links.push_back(slot << 1);
        ranges[i].w = firstLink + std::uint32_t(links.size()) - ranges[i].z;
    }
    if (links.size() > t.linkEntries) throw RecordError("there are too many contacts");
    pairs.write(passes);
    surfaces.write(passes);
    passes.rows.writeAll(links, passes.at.linkIndex(firstLink) * sizeof(std::uint32_t));
    passes.ranges.writeAll(ranges, passes.at.rowRangeIndex(firstParticle) * sizeof(uvec4));
    passes.ranges.writeAll(owned, passes.at.slotRangeIndex(firstParticle) * sizeof(uvec4));
    const std::uint32_t first = t.firstBodySlot(member);
    passes.entries.writeAll(bodies.entries, passes.at.entryIndex(first) * sizeof(glm::uvec2));
    passes.history.writeAll(bodies.history,
                            passes.at.bodyHistoryIndex(std::uint64_t(member) * t.bodySlots, 0) * sizeof(vec4));
    control.listed = {std::uint32_t(pairs.entries.size()), std::uint32_t(surfaces.entries.size()),
                      std::uint32_t(bodies.entries.size()), 0U};
}

}  // namespace

std::vector<SlotContact> touchingSlots(const Passes& passes, std::uint32_t member) {
    const TableSizes& t = passes.sizes;
    const uvec4 listed = passes.controlOf(member).listed;
    const std::uint32_t firstParticle = member * t.share;
    std::vector<SlotContact> found;
    const auto collect = [&](bool pair, std::uint32_t first, std::uint32_t count) {
        const auto entries =
            passes.entries.readAll<glm::uvec2>(count, passes.at.entryIndex(first) * sizeof(glm::uvec2));
        const auto forces = passes.forces.readAll<vec4>(count, passes.at.forceIndex(first) * sizeof(vec4));
        std::array<std::vector<vec4>, 6> history;
        history[0] = passes.history.readAll<vec4>(2ULL * count, passes.at.springIndex(first, 0) * sizeof(vec4));
        for (std::uint32_t part = 2; part < t.historyParts(); ++part)
            history[part - 1] =
                passes.history.readAll<vec4>(count, passes.at.exertedIndex(part - 2, first) * sizeof(vec4));
        for (std::size_t k = 0; k < count; ++k) {
            if (history[0][2 * k].w <= 0) continue;
            const std::uint32_t other =
                pair ? entries[k].y - firstParticle : entries[k].y & ((1U << gpu::kSurfaceBits) - 1);
            SlotContact c{pair, entries[k].x - firstParticle, other, forces[k], {}};
            c.history[0] = history[0][2 * k];
            c.history[1] = history[0][2 * k + 1];
            for (std::uint32_t part = 2; part < t.historyParts(); ++part) c.history[part] = history[part - 1][k];
            found.push_back(c);
        }
    };
    collect(true, t.firstPairSlot(member), listed.x);
    collect(false, t.firstSurfaceSlot(member), listed.y);
    std::sort(found.begin(), found.end(), [](const SlotContact& a, const SlotContact& b) {
        return std::tuple(a.particle, !a.pair, a.other) < std::tuple(b.particle, !b.pair, b.other);
    });
    return found;
}

std::vector<PlaceContact> touchingPlaces(const Passes& passes, std::uint32_t member) {
    const TableSizes& t = passes.sizes;
    std::vector<PlaceContact> found;
    if (t.bodies == 0) return found;
    const std::uint32_t count = passes.controlOf(member).listed.z, first = t.firstBodySlot(member);
    const std::uint64_t row = std::uint64_t(member) * t.bodySlots;
    const auto entries = passes.entries.readAll<glm::uvec2>(count, passes.at.entryIndex(first) * sizeof(glm::uvec2));
    const auto history = passes.history.readAll<vec4>(std::size_t(t.bodyHistory()) * count,
                                                      passes.at.bodyHistoryIndex(row, 0) * sizeof(vec4));
    const auto forces = passes.forces.readAll<vec4>(std::size_t(gpu::kMaxBodyTouches) * count,
                                                    passes.at.bodyForceIndex(row, 0) * sizeof(vec4));
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t touch = 0; touch < gpu::kMaxBodyTouches; ++touch) {
            const vec4* place = &history[t.bodyHistory() * k + t.placeParts() * touch];
            if (place[0].w <= 0) continue;
            PlaceContact c{entries[k].x - member * t.share, entries[k].y, forces[gpu::kMaxBodyTouches * k + touch], {}};
            std::copy_n(place, t.placeParts(), c.history.begin());
            found.push_back(c);
        }
    std::stable_sort(found.begin(), found.end(), [](const PlaceContact& a, const PlaceContact& b) {
        return std::tuple(a.particle, a.body) < std::tuple(b.particle, b.body);
    });
    return found;
}

void writeLows(Passes& passes, std::uint32_t member, std::size_t first, const Particles& particles) {
    const std::uint64_t at = passes.at.speedLowIndex(std::uint64_t(member) * passes.sizes.share + first, 0);
    passes.anchors.writeAll(packSpeedLows(particles), at * sizeof(vec4));
    if (!passes.sizes.properties()) return;
    const std::uint64_t own = passes.at.propertyIndex(std::uint64_t(member) * passes.sizes.share + first, 0);
    passes.forces.writeAll(packProperties(particles), own * sizeof(vec4));
}

void writeState(Passes& passes, std::uint32_t member, std::size_t first, const std::vector<gpu::vec4>& state,
                std::uint32_t source) {
    const std::size_t count = state.size() / gpu::kFields, couples = gpu::kFields / 2;
    const std::size_t stride = 2ULL * passes.sizes.particles();
    for (std::size_t couple = 0; couple < couples; ++couple) {
        const auto part = state.begin() + std::ptrdiff_t(couple * 2 * count);
        const std::size_t at = 2 * (std::size_t(member) * passes.sizes.share + first);
        passes.state.writeAll(std::vector<vec4>(part, part + std::ptrdiff_t(2 * count)),
                              ((source * couples + couple) * stride + at) * sizeof(vec4));
    }
}

void writeParticles(Passes& passes, std::uint32_t member, std::size_t first, const Particles& particles,
                    std::uint32_t source) {
    std::vector<vec4> state(particles.size() * gpu::kFields);
    packState(particles, particles.size(), 0, state);
    writeState(passes, member, first, state, source);
    writeLows(passes, member, first, particles);
    gpu::Control control = passes.controlOf(member);
    control.wanted.z = control.wanted.w = 1U;  // new rows and lists, which know them
    passes.setControl(member, control);
}

void saveState(const Passes& passes, std::uint32_t member, std::size_t particles, std::uint32_t source,
               Record& record) {
    const std::size_t stride = passes.sizes.particles(), first = std::size_t(member) * passes.sizes.share;
    const std::size_t couples = gpu::kFields / 2;
    record.put("state",
               packed(passes.state, couples, 2 * stride, source * couples * 2 * stride + 2 * first, 2 * particles));
    record.put(kSpeedLow, packed(passes.anchors, 1, 0, passes.at.speedLowIndex(first, 0), 2 * particles));
    if (passes.sizes.properties())
        record.put(kProperties, packed(passes.forces, 1, 0, passes.at.propertyIndex(first, 0), 2 * particles));
    saveContacts(passes, member, record);
    saveBodies(passes, member, record);
    if (passes.sizes.energyBook)
        record.put("energy_book", packed(passes.books, gpu::kBookFields, stride, first, particles));
    record.putOne("rebuilds", std::uint32_t(passes.controlOf(member).list.y));
}

void restoreState(Passes& passes, std::uint32_t member, std::size_t particles, std::uint32_t steps,
                  const Record& record) {
    const std::size_t stride = passes.sizes.particles(), first = std::size_t(member) * passes.sizes.share;
    const std::size_t books = passes.sizes.energyBook ? gpu::kBookFields : 0;
    // The whole record is checked before anything is written.
    const auto& state = record.get<float>("state", 4 * particles * gpu::kFields);
    static const std::vector<float> none;
    const auto& lows = record.get<float>(kSpeedLow, 8 * particles);
    const auto& properties = passes.sizes.properties() ? record.get<float>(kProperties, 8 * particles) : none;
    const auto& book = books > 0 ? record.get<float>("energy_book", 4 * particles * books) : none;
    const auto rebuilds = record.one<std::uint32_t>("rebuilds");
    gpu::Control control = passes.controlOf(member);
    restoreContacts(passes, member, particles, record, control);
    const std::size_t couples = gpu::kFields / 2, source = steps % 2;
    unpack(state, couples, 2 * stride, source * couples * 2 * stride + 2 * first, 2 * particles, passes.state);
    unpack(lows, 1, 0, passes.at.speedLowIndex(first, 0), 2 * particles, passes.anchors);
    if (passes.sizes.properties())
        unpack(properties, 1, 0, passes.at.propertyIndex(first, 0), 2 * particles, passes.forces);
    unpack(book, books, stride, first, particles, passes.books);
    control.steps.x = steps;
    control.list = uvec4(0U, rebuilds, 0U, 0U);
    passes.setControl(member, control);
}

}  // namespace vkdose
