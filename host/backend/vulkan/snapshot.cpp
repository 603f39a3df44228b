#include "host/backend/vulkan/snapshot.h"

#include <vector>

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

std::size_t wallRows(const Passes& passes) {
    return passes.sizes.historyParts() * passes.sizes.wallSlots() + 1;
}

bool touches(const uvec4& mark, std::uint32_t slot) {
    return (((slot < 32 ? mark.x : mark.y) >> (slot % 32)) & 1U) != 0;
}

/// Both sides of every touching pair: how many of each particle, the partners in ascending order, their histories.
void savePairs(const Passes& passes, std::size_t particles, const std::vector<uvec4>& marks, Record& record) {
    const std::size_t stride = passes.sizes.particles, width = passes.sizes.rowWidth;
    const std::size_t parts = passes.sizes.historyParts();
    const std::size_t half = passes.control.readAll<gpu::Control>(1)[0].list.x;
    const auto rows = passes.rows.readAll<std::uint32_t>(width * stride, half * width * stride * 4);
    const auto history =
        passes.history.readAll<vec4>(parts * width * stride, half * parts * width * stride * sizeof(vec4));
    std::vector<std::uint32_t> counts, partners;
    std::vector<float> springs;
    for (std::size_t i = 0; i < particles; ++i) {
        const std::size_t before = partners.size();
        for (std::uint32_t s = 0; s < marks[i].w; ++s) {
            if (!touches(marks[i], s)) continue;
            partners.push_back(rows[s * stride + i]);
            for (std::size_t part = 0; part < parts; ++part)
                for (int c = 0; c < 4; ++c) springs.push_back(history[(parts * s + part) * stride + i][c]);
        }
        counts.push_back(static_cast<std::uint32_t>(partners.size() - before));
    }
    record.put("pair_counts", std::move(counts));
    record.put("pair_partners", std::move(partners));
    record.put("pair_history", std::move(springs));
}

void restorePairs(Passes& passes, std::size_t particles, std::vector<uvec4>& marks, const Record& record) {
    const std::size_t stride = passes.sizes.particles, width = passes.sizes.rowWidth;
    const std::size_t parts = passes.sizes.historyParts();
    const auto& counts = record.get<std::uint32_t>("pair_counts", particles);
    std::size_t total = 0;
    for (const std::uint32_t n : counts) total += n;
    const auto& partners = record.get<std::uint32_t>("pair_partners", total);
    const auto& springs = record.get<float>("pair_history", 4 * parts * total);
    std::vector<std::uint32_t> rows(width * stride, 0);
    std::vector<vec4> history(parts * width * stride, vec4(0));
    std::size_t at = 0;
    for (std::size_t i = 0; i < particles; ++i) {
        if (counts[i] > width) throw RecordError("pair_counts exceeds the rows of this load");
        for (std::uint32_t s = 0; s < counts[i]; ++s, ++at) {
            if (partners[at] >= particles) throw RecordError("pair_partners names a particle that there is not");
            rows[s * stride + i] = partners[at];
            for (std::size_t part = 0; part < parts; ++part)
                for (int c = 0; c < 4; ++c)
                    history[(parts * s + part) * stride + i][c] = springs[4 * (parts * at + part) + c];
            (s < 32 ? marks[i].x : marks[i].y) |= 1U << (s % 32);
        }
        marks[i].w = counts[i];
    }
    passes.rows.writeAll(rows);
    passes.history.writeAll(history);
}

}  // namespace

void saveState(const Passes& passes, std::size_t particles, std::uint32_t source, Record& record) {
    const std::size_t stride = passes.sizes.particles;
    const auto half = passes.state.readAll<vec4>(gpu::kFields * stride, source * gpu::kFields * stride * sizeof(vec4));
    record.put("state", packed(half, gpu::kFields, stride, particles));
    const auto marks = passes.marks.readAll<uvec4>(stride);
    savePairs(passes, particles, marks, record);
    std::vector<std::uint32_t> walls;
    for (std::size_t i = 0; i < particles; ++i) walls.push_back(marks[i].z);
    record.put("wall_marks", std::move(walls));
    record.put("wall_history", packed(passes.wallHistory.readAll<vec4>(wallRows(passes) * stride), wallRows(passes),
                                      stride, particles));
    if (passes.sizes.energyBook)
        record.put("energy_book",
                   packed(passes.books.readAll<vec4>(gpu::kBookFields * stride), gpu::kBookFields, stride, particles));
    record.putOne("rebuilds", std::uint32_t(passes.control.readAll<gpu::Control>(1)[0].list.y));
}

void restoreState(Passes& passes, std::size_t particles, const Record& record) {
    const std::size_t stride = passes.sizes.particles;
    auto half = passes.state.readAll<vec4>(gpu::kFields * stride);  // the padding stays as it was loaded
    unpack(record.get<float>("state", 4 * gpu::kFields * particles), gpu::kFields, stride, particles, half);
    std::vector<uvec4> marks(stride, uvec4(0U));
    restorePairs(passes, particles, marks, record);
    const auto& walls = record.get<std::uint32_t>("wall_marks", particles);
    for (std::size_t i = 0; i < particles; ++i) marks[i].z = walls[i];
    std::vector<vec4> wallHistory(wallRows(passes) * stride, vec4(0));
    unpack(record.get<float>("wall_history", 4 * wallRows(passes) * particles), wallRows(passes), stride, particles,
           wallHistory);
    passes.state.writeAll(half);
    passes.marks.writeAll(marks);
    passes.wallHistory.writeAll(wallHistory);
    if (passes.sizes.energyBook) {
        std::vector<vec4> books(gpu::kBookFields * stride, vec4(0));
        unpack(record.get<float>("energy_book", 4 * gpu::kBookFields * particles), gpu::kBookFields, stride, particles,
               books);
        passes.books.writeAll(books);
    }
    gpu::Control control = passes.control.readAll<gpu::Control>(1)[0];
    control.list = uvec4(0U, record.one<std::uint32_t>("rebuilds"), 0U, 0U);
    passes.control.write(0, &control, sizeof control);
}

}  // namespace vkdose
