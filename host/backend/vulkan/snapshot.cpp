#include "host/backend/vulkan/snapshot.h"

#include <algorithm>
#include <tuple>

namespace vkdose {

namespace {

using gpu::uvec4;
using gpu::vec4;

/// The first `count` entries of each of `rows` rows of `stride` vectors.
std::vector<float> packed(const std::vector<vec4>& from, std::size_t rows, std::size_t stride, std::size_t count) {
    std::vector<float> values;
    values.reserve(4 * rows * count);
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t i = 0; i < count; ++i)
            for (int c = 0; c < 4; ++c) values.push_back(from[row * stride + i][c]);
    return values;
}

/// Its inverse; what lies between keeps its value.
void unpack(const std::vector<float>& values, std::size_t rows, std::size_t stride, std::size_t count,
            std::vector<vec4>& to) {
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t i = 0; i < count; ++i)
            for (int c = 0; c < 4; ++c) to[row * stride + i][c] = values[4 * (row * count + i) + c];
}

/// Contacts that keep springs in a slot: who meets whom, and their histories.
void saveContacts(const Passes& passes, Record& record) {
    std::vector<std::uint32_t> pairs, particles, others;
    std::vector<float> springs;
    for (const SlotContact& c : touchingSlots(passes)) {
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

/// Lists what touched, as a refresh would have: the next one carries the histories on.
void restoreContacts(Passes& passes, std::size_t particles, const Record& record) {
    const TableSizes& t = passes.sizes;
    const auto& owner = record.get<std::uint32_t>("contact_particle");
    const std::size_t count = owner.size(), parts = t.historyParts();
    const auto& isPair = record.get<std::uint32_t>("contact_is_pair", count);
    const auto& other = record.get<std::uint32_t>("contact_other", count);
    const auto& springs = record.get<float>("contact_history", 4 * parts * count);
    std::vector<glm::uvec2> entries(t.slots());
    std::vector<std::uint32_t> links;
    std::vector<uvec4> ranges(t.particles, uvec4(0U));
    std::vector<vec4> history(parts * t.springSlots(), vec4(0));
    std::uint32_t pairs = 0, surfaces = 0;
    for (std::size_t c = 0; c < count; ++c) {
        if (owner[c] >= particles || other[c] >= (isPair[c] != 0 ? particles : t.surfaces))
            throw RecordError("contact_particle or contact_other names what there is not");
        if (c > 0 && owner[c] < owner[c - 1]) throw RecordError("contact_particle is not in order");
        std::uint32_t& used = isPair[c] != 0 ? pairs : surfaces;
        if (used == (isPair[c] != 0 ? t.pairSlots : t.surfaceSlots)) throw RecordError("there are too many contacts");
        const std::uint32_t slot = (isPair[c] != 0 ? 0 : t.pairSlots) + used++;
        entries[slot] = {owner[c], other[c]};
        for (std::size_t part = 0; part < parts; ++part)
            for (int k = 0; k < 4; ++k)
                history[t.historyOffset(std::uint32_t(part), slot)][k] = springs[4 * (parts * c + part) + k];
        uvec4& range = ranges[owner[c]];
        if (range.w == 0) range.z = std::uint32_t(links.size());
        ++range.w;
        links.push_back(slot << 1);
    }
    passes.entries.writeAll(entries);
    passes.rows.writeAll(links, t.rowEntries * sizeof(std::uint32_t));
    passes.ranges.writeAll(ranges);
    passes.history.writeAll(history);
}

}  // namespace

std::vector<SlotContact> touchingSlots(const Passes& passes) {
    const TableSizes& t = passes.sizes;
    const uvec4 listed = passes.control.readAll<gpu::Control>(1)[0].listed;
    const auto entries = passes.entries.readAll<glm::uvec2>(t.slots());
    const auto history = passes.history.readAll<vec4>(std::size_t(t.historyParts()) * t.springSlots());
    std::vector<SlotContact> found;
    const auto collect = [&](bool pair, std::uint32_t first, std::uint32_t count) {
        for (std::uint32_t slot = first; slot < first + count; ++slot) {
            if (history[t.historyOffset(0, slot)].w <= 0) continue;
            SlotContact c{pair, entries[slot].x, entries[slot].y, {}};
            for (std::size_t part = 0; part < t.historyParts(); ++part)
                c.history[part] = history[t.historyOffset(std::uint32_t(part), slot)];
            found.push_back(c);
        }
    };
    collect(true, 0, listed.x);
    collect(false, t.pairSlots, listed.y);
    std::sort(found.begin(), found.end(), [](const SlotContact& a, const SlotContact& b) {
        return std::tuple(a.particle, !a.pair, a.other) < std::tuple(b.particle, !b.pair, b.other);
    });
    return found;
}

void saveState(const Passes& passes, std::size_t particles, std::uint32_t source, Record& record) {
    const std::size_t stride = passes.sizes.particles, coilRows = passes.sizes.coilHistoryRows();
    const auto half = passes.state.readAll<vec4>(gpu::kFields * stride, source * gpu::kFields * stride * sizeof(vec4));
    record.put("state", packed(half, gpu::kFields / 2, 2 * stride, 2 * particles));
    saveContacts(passes, record);
    record.put("coil_history",
               packed(passes.coilHistory.readAll<vec4>(coilRows * stride), coilRows, stride, particles));
    if (passes.sizes.energyBook)
        record.put("energy_book",
                   packed(passes.books.readAll<vec4>(gpu::kBookFields * stride), gpu::kBookFields, stride, particles));
    record.putOne("rebuilds", std::uint32_t(passes.control.readAll<gpu::Control>(1)[0].list.y));
}

void restoreState(Passes& passes, std::size_t particles, const Record& record) {
    const std::size_t stride = passes.sizes.particles, coilRows = passes.sizes.coilHistoryRows();
    auto half = passes.state.readAll<vec4>(gpu::kFields * stride);  // the padding stays as it was loaded
    unpack(record.get<float>("state", 4 * particles * gpu::kFields), gpu::kFields / 2, 2 * stride, 2 * particles, half);
    auto coil = passes.coilHistory.readAll<vec4>(coilRows * stride);
    unpack(record.get<float>("coil_history", 4 * particles * coilRows), coilRows, stride, particles, coil);
    restoreContacts(passes, particles, record);
    passes.state.writeAll(half);
    passes.coilHistory.writeAll(coil);
    if (passes.sizes.energyBook) {
        std::vector<vec4> books(gpu::kBookFields * stride, vec4(0));
        unpack(record.get<float>("energy_book", 4 * particles * gpu::kBookFields), gpu::kBookFields, stride, particles,
               books);
        passes.books.writeAll(books);
    }
    gpu::Control control = passes.control.readAll<gpu::Control>(1)[0];
    control.list = uvec4(0U, record.one<std::uint32_t>("rebuilds"), 0U, 0U);
    passes.control.write(0, &control, sizeof control);
}

}  // namespace vkdose
