#include "host/backend/vulkan/tables.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/core/error.h"

namespace vkdose {

namespace {

std::uint32_t roundUp(std::uint64_t n, std::uint32_t unit) {
    return std::uint32_t((n + unit - 1) / unit * unit);
}

/// Neighbours of a particle within reach and skin, mean over a packing: a dense random one has ten within 1.2
/// diameters, more with the cube of the reach. Twelve spheres of one size can touch one.
std::uint64_t meanRow(const World& world, const Particles& particles) {
    const double diameter =
        2 * std::accumulate(particles.radius.begin(), particles.radius.end(), 0.0) / double(particles.size());
    const double mean = std::ceil(10 * std::pow(1 + world.skin / diameter, 3) + 2);
    return std::uint64_t(std::clamp(mean, 12.0, double(gpu::kMaxRow)));
}

}  // namespace

TableSizes tableSizes(const World& world, const Particles& particles, const gpu::Member& member,
                      std::uint32_t workgroup, std::uint64_t range, std::uint32_t members) {
    const std::uint64_t n = particles.size();
    constexpr std::uint64_t kFew = 1024;  // so few that the mean says nothing
    TableSizes s;
    s.members = members;
    s.workgroup = workgroup;
    s.share = roundUp(n, workgroup);
    s.cells = 64;
    while (s.cells < 2 * n) s.cells *= 2;
    s.surfaces = std::uint32_t(world.surfaces.size());
    for (std::uint32_t i = 0; i < s.surfaces; ++i) {
        const auto kind = std::uint32_t(member.surface[i].pointHigh.w);
        s.kindSet |= 1U << kind;
        if (i < gpu::kUnrolledSurfaces) s.surfaceKinds |= kind << (4 * i);
    }
    s.energyBook = world.energyBook;

    const std::uint64_t most =
        range / (std::uint64_t(s.historyParts()) * sizeof(gpu::vec4) * members);  // slots in one buffer
    const std::uint64_t pairs = std::min(7 * n / 2 + kFew, n * (n - 1) / 2 + 1);
    const std::uint64_t surfaces = std::min(2 * n + kFew, n * s.surfaces);
    s.pairSlots = roundUp(pairs, workgroup);
    // Where two surfaces each do not fit the device, half a one will do: so large a bed is mostly bulk.
    const bool fits = s.pairSlots + surfaces + workgroup <= most;
    s.surfaceSlots = roundUp(fits ? surfaces : std::min(surfaces, n / 2), workgroup);
    s.coilSlots = world.coil ? s.share : 0;
    s.rowEntries = std::uint32_t(std::max<std::uint64_t>(1, std::min(n * meanRow(world, particles) + kFew, n * n)));
    s.linkEntries = 2 * s.pairSlots + s.surfaceSlots + s.coilSlots;
    return s;
}

TableSizes roomForAll(const std::vector<TableSizes>& members) {
    TableSizes all = members.at(0);
    all.members = std::uint32_t(members.size());
    for (const TableSizes& s : members) {
        if (s.surfaces != all.surfaces || s.surfaceKinds != all.surfaceKinds || s.kindSet != all.kindSet ||
            s.energyBook != all.energyBook)
            throw RunError(
                "canisters can share a device's tables only if they have the same kinds of surfaces in the "
                "same order, and all or none keep an energy book");
        for (const auto size :
             {&TableSizes::share, &TableSizes::cells, &TableSizes::rowEntries, &TableSizes::linkEntries,
              &TableSizes::pairSlots, &TableSizes::surfaceSlots, &TableSizes::coilSlots})
            all.*size = std::max(all.*size, s.*size);
    }
    return all;
}

}  // namespace vkdose
