#pragma once
// The device's state as a record, and back. Rows and lists are not stored: a restored load starts with lists of what
// touched, and the refresh that opens every load carries these contacts' histories into the full ones.

#include <array>
#include <vector>

#include "host/backend/vulkan/passes.h"
#include "host/core/record.h"

namespace vkdose {

/// A pair or a contact with a surface that touches, from the device's slots.
struct SlotContact {
    bool pair;
    std::uint32_t particle, other;
    gpu::vec4 force;                   ///< as `forces` in shaders/shared/buffers.glsl holds it
    std::array<gpu::vec4, 5> history;  ///< TableSizes::historyParts() of them
};

/// In order of particle, pairs before surfaces, other; particles are counted from the member's first. The device must
/// be idle.
std::vector<SlotContact> touchingSlots(const Passes& passes, std::uint32_t member);

/// A contact with a turn of the coil.
struct TurnContact {
    std::uint32_t particle, turn;
    gpu::vec4 force;                   ///< zero before any step
    std::array<gpu::vec4, 2> history;  ///< as `coilHistory` in shaders/shared/buffers.glsl begins
};

/// Of a member's first `particles`, in order of particle, turn. The device must be idle. Reads what is the member's, so
/// that looking at every member of an ensemble costs no more than looking at as many runs.
std::vector<TurnContact> touchingTurns(const Passes& passes, std::uint32_t member, std::size_t particles);

/// State of a member's first `particles` slots, read from half `source`. The device must be idle, and the member sensed
/// since its last step (the sensors' accumulators are not stored).
void saveState(const Passes& passes, std::uint32_t member, std::size_t particles, std::uint32_t source, Record& record);

/// Writes it into half `source` of freshly loaded passes. Throws RecordError if it does not fit them.
void restoreState(Passes& passes, std::uint32_t member, std::size_t particles, std::uint32_t source,
                  const Record& record);

}  // namespace vkdose
