#pragma once
// The device's state as a record, and back. Rows and contact lists are not stored. A restored load starts with lists of
// only the contacts that touched. The refresh that opens every load carries their histories into the full lists.

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
    std::array<gpu::vec4, 7> history;  ///< TableSizes::historyParts() of them
};

/// The touching contacts of a member, in order of particle, then pairs before surfaces, then `other`. Particles are
/// counted from the member's first. The device must be idle.
std::vector<SlotContact> touchingSlots(const Passes& passes, std::uint32_t member);

/// A contact with a body, at one of the places where it touches.
struct PlaceContact {
    std::uint32_t particle, body;
    gpu::vec4 force;
    std::array<gpu::vec4, 8> history;  ///< TableSizes::placeParts() of them; the third is the direction
};

/// The touching contacts with bodies, in order of particle, then body, then place. The device must be idle.
std::vector<PlaceContact> touchingPlaces(const Passes& passes, std::uint32_t member);

/// Writes the state that packState made of some of a member's particles, those from `first` on, into half `source`. The
/// device must be idle.
void writeState(Passes& passes, std::uint32_t member, std::size_t first, const std::vector<gpu::vec4>& state,
                std::uint32_t source);

/// Writes the low parts of the speeds of the particles from `first` on, and their properties. The device must be idle.
void writeLows(Passes& passes, std::uint32_t member, std::size_t first, const Particles& particles);

/// Puts active particles into the places of those from `first` on in half `source`, and asks for new rows and contact
/// lists. The device must be idle.
void writeParticles(Passes& passes, std::uint32_t member, std::size_t first, const Particles& particles,
                    std::uint32_t source);

/// Saves the state of a member's first `particles` slots, read from half `source`. The device must be idle. The member
/// must have been sensed since its last step, because the sensors' accumulators are not stored.
void saveState(const Passes& passes, std::uint32_t member, std::size_t particles, std::uint32_t source, Record& record);

/// Writes the record into passes that have just been loaded, as the state after so many steps (gpu::Control::steps).
/// Throws RecordError if it does not fit them.
void restoreState(Passes& passes, std::uint32_t member, std::size_t particles, std::uint32_t steps,
                  const Record& record);

}  // namespace vkdose
