#pragma once
// How much room the device's tables need for a world and its particles.

#include <cstdint>

#include "host/model/particles.h"
#include "host/model/world.h"
#include "shaders/shared/layout.h"

namespace vkdose {

struct TableSizes {
    std::uint32_t particles = 0;  ///< slots, a multiple of the workgroup
    std::uint32_t workgroup = 64;
    std::uint32_t cells = 0;  ///< a power of two
    std::uint32_t surfaces = 0;
    std::uint32_t surfaceKinds = 0;  ///< of the first kUnrolledSurfaces, 4 bits each
    std::uint32_t kindSet = 0;       ///< bit k: there is a surface of kind k
    std::uint32_t rowEntries = 0, linkEntries = 0;
    std::uint32_t pairSlots = 0, surfaceSlots = 0, coilSlots = 0;  ///< multiples of the workgroup
    bool energyBook = false;
    bool texelReads = true;  ///< wanted; used if every view fits the device's limit

    std::uint32_t groups() const { return particles / workgroup; }
    std::uint32_t springSlots() const { return pairSlots + surfaceSlots; }
    std::uint32_t slots() const { return springSlots() + coilSlots; }
    /// Vectors of a contact's history (kParts in shared/buffers.glsl).
    std::uint32_t historyParts() const { return energyBook ? 5 : 2; }
    /// Place of a contact's vector in the history (historyIndex in shared/buffers.glsl).
    std::size_t historyOffset(std::uint32_t part, std::uint32_t slot) const {
        return part < 2 ? 2ULL * slot + part : std::size_t(part) * springSlots() + slot;
    }
    std::uint32_t coilHistoryRows() const { return coilSlots > 0 ? gpu::kMaxTurns * historyParts() + 1 : 0; }
};

/// `range` is the longest buffer the device can bind [bytes]. Rows and slots are shared by all particles, so they are
/// sized for the mean of a dense packing; a full table is reported by the device (kErrorTables).
TableSizes tableSizes(const World& world, const Particles& particles, const gpu::Member& member,
                      std::uint32_t workgroup, std::uint64_t range);

}  // namespace vkdose
