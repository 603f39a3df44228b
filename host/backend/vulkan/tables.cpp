#include "host/backend/vulkan/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/core/error.h"
#include "host/model/rows.h"

namespace vkdose {

namespace {

constexpr std::uint64_t kIndices = 1ULL << 32;

static_assert(gpu::kMaxRow == kMaxNeighbours);  // what a case is checked against

std::uint64_t roundUp(std::uint64_t n, std::uint64_t unit) {
    return (n + unit - 1) / unit * unit;
}

std::uint32_t narrow(std::uint64_t n) {
    if (n >= kIndices)
        throw RunError(
            fmt::format("the tables need room for {} entries, of which 32 bits number no more than {}: use "
                        "fewer particles",
                        n, kIndices));
    return std::uint32_t(n);
}

/// Neighbours of a particle within reach and skin, mean over a packing: a dense random one has ten within 1.2
/// diameters, more with the cube of the reach. Twelve spheres of one size can touch one.
std::uint64_t meanRow(const World& world, const Crowd& crowd) {
    const double mean = std::ceil(10 * std::pow(1 + world.skin / (2 * crowd.meanRadius), 3) + 2);
    return std::uint64_t(std::clamp(mean, 12.0, double(gpu::kMaxRow)));
}

}  // namespace

Crowd::Crowd(const Particles& p)
    : count(p.size()), meanRadius(std::accumulate(p.radius.begin(), p.radius.end(), 0.0) / double(p.size())) {}

bool TableSizes::shares(const TableSizes& other) const {
    return surfaces == other.surfaces && surfaceKinds == other.surfaceKinds && kindSet == other.kindSet &&
           energyBook == other.energyBook;
}

void TableSizes::growTo(const TableSizes& other) {
    for (const auto size : {&TableSizes::share, &TableSizes::cells, &TableSizes::rowEntries, &TableSizes::linkEntries,
                            &TableSizes::pairSlots, &TableSizes::surfaceSlots, &TableSizes::coilSlots})
        this->*size = std::max(this->*size, other.*size);
}

std::uint64_t TableSizes::largestIndex() const {
    const std::uint64_t n = std::uint64_t(members) * share, m = members;
    const std::uint64_t springs = m * (std::uint64_t(pairSlots) + surfaceSlots), all = springs + m * coilSlots;
    return std::max({2 * n * gpu::kFields,                             // state
                     m * (std::uint64_t(rowEntries) + linkEntries),    // rows and links
                     2 * all,                                          // links, entries, torques
                     all + gpu::kMaxTurns * m * coilSlots,             // forces
                     historyParts() * springs, coilHistoryRows() * n,  // histories
                     gpu::kBookFields * (n + all),                     // energy book
                     m * cells + n}) -
           1;
}

TableSizes tableSizes(const World& world, const Crowd& crowd, const gpu::Member& member, const DeviceShape& device,
                      std::uint32_t members) {
    const std::uint64_t n = crowd.count, workgroup = device.workgroup;
    if (n * members > gpu::kMostParticles)
        throw RunError(fmt::format("{} particles; the Vulkan backend numbers {}", n * members,
                                   std::uint32_t(gpu::kMostParticles)));
    constexpr std::uint64_t kFew = 1024;  // so few that the mean says nothing
    TableSizes s;
    s.members = members;
    s.workgroup = device.workgroup;
    s.mostGroups = device.mostGroups;
    s.share = narrow(roundUp(n, workgroup * s.layers(narrow((n + workgroup - 1) / workgroup))));  // every layer full
    s.cells = 64;
    while (s.cells < 2 * n) s.cells *= 2;
    s.surfaces = std::uint32_t(world.surfaces.size());
    for (std::uint32_t i = 0; i < s.surfaces; ++i) {
        const auto kind = std::uint32_t(member.surface[i].pointHigh.w);
        s.kindSet |= 1U << kind;
        if (kind == gpu::kFront) s.front = i;
        const bool wall = kind == gpu::kPlane || kind == gpu::kTrough;
        if (wall && member.surface[i].pointLow.w != 0) s.kindSet |= gpu::kEndingWalls;
        if (i < gpu::kUnrolledSurfaces) s.surfaceKinds |= kind << (4 * i);
    }
    s.energyBook = world.energyBook;

    const std::uint64_t most =
        device.range / (std::uint64_t(s.historyParts()) * sizeof(gpu::vec4) * members);  // slots in one buffer
    const std::uint64_t pairs = std::min(7 * n / 2 + kFew, n * (n - 1) / 2 + 1);
    const std::uint64_t surfaces = std::min(2 * n + kFew, n * s.surfaces);
    s.pairSlots = narrow(roundUp(pairs, workgroup));
    // Where two surfaces each do not fit the device, half a one will do: so large a bed is mostly bulk.
    const bool fits = s.pairSlots + surfaces + workgroup <= most;
    s.surfaceSlots = narrow(roundUp(fits ? surfaces : std::min(surfaces, n / 2), workgroup));
    s.coilSlots = world.coil ? s.share : 0;
    s.rowEntries = narrow(std::max<std::uint64_t>(1, std::min(n * meanRow(world, crowd) + kFew, n * n)));
    s.linkEntries = narrow(2ULL * s.pairSlots + s.surfaceSlots + s.coilSlots);
    narrow(s.largestIndex());
    return s;
}

TableSizes roomForAll(const std::vector<TableSizes>& members) {
    TableSizes all = members.at(0);
    all.members = std::uint32_t(members.size());
    for (const TableSizes& s : members) {
        if (!s.shares(all))
            throw RunError(
                "canisters can share a device's tables only if they have the same kinds of surfaces in the "
                "same order, and all or none keep an energy book");
        all.growTo(s);
    }
    narrow(all.largestIndex());
    return all;
}

}  // namespace vkdose
