#pragma once
// How much room the device's tables need for worlds and their particles.

#include <cstdint>
#include <vector>

#include "host/model/particles.h"
#include "host/model/world.h"
#include "shaders/shared/layout.h"

namespace vkdose {

/// Every member gets as much room as the one that needs most.
struct TableSizes {
    std::uint32_t members = 1;
    std::uint32_t workgroup = 64;
    std::uint32_t surfaces = 0;
    std::uint32_t surfaceKinds = 0;  ///< of the first kUnrolledSurfaces, 4 bits each
    std::uint32_t kindSet = 0;       ///< bit k: there is a surface of kind k
    // Of each member:
    std::uint32_t share = 0;  ///< slots for particles, a multiple of the workgroup
    std::uint32_t cells = 0;  ///< a power of two
    std::uint32_t rowEntries = 0, linkEntries = 0;
    std::uint32_t pairSlots = 0, surfaceSlots = 0, coilSlots = 0;  ///< multiples of the workgroup
    bool energyBook = false;
    bool texelReads = true;  ///< wanted; used if every view fits the device's limit

    std::uint32_t groups() const { return share / workgroup; }
    // Of all members, and where a member's begin (shaders/shared/buffers.glsl):
    std::uint32_t particles() const { return members * share; }
    std::uint32_t springSlots() const { return members * (pairSlots + surfaceSlots); }
    std::uint32_t slots() const { return springSlots() + members * coilSlots; }
    std::uint32_t firstPairSlot(std::uint32_t member) const { return member * pairSlots; }
    std::uint32_t firstSurfaceSlot(std::uint32_t member) const { return members * pairSlots + member * surfaceSlots; }
    /// Vectors of a contact's history (kParts in shared/buffers.glsl).
    std::uint32_t historyParts() const { return energyBook ? 5 : 2; }
    /// Place of a contact's vector in the history (historyIndex in shared/buffers.glsl).
    std::size_t historyOffset(std::uint32_t part, std::uint32_t slot) const {
        return part < 2 ? 2ULL * slot + part : std::size_t(part) * springSlots() + slot;
    }
    std::uint32_t coilHistoryRows() const { return coilSlots > 0 ? gpu::kMaxTurns * historyParts() + 1 : 0; }
};

/// For one member, if `members` of its kind share the tables. `range` is the longest buffer the device can bind
/// [bytes]. Rows and slots are shared by all particles of a member, so they are sized for the mean of a dense packing;
/// a full table is reported by the device (kErrorTables).
TableSizes tableSizes(const World& world, const Particles& particles, const gpu::Member& member,
                      std::uint32_t workgroup, std::uint64_t range, std::uint32_t members = 1);

/// Room for all of them. Throws RunError if they cannot share tables: their surfaces are of other kinds or in another
/// order, or only some keep an energy book.
TableSizes roomForAll(const std::vector<TableSizes>& members);

}  // namespace vkdose
