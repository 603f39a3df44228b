#pragma once
// The device side of one load: buffers, bindings and pipelines, sized for its particles. Mirrors shaders/pass and
// shaders/shared/buffers.glsl; the order of the buffers is the order of the bindings.

#include <array>
#include <cstdint>
#include <memory>

#include "host/vk/buffer.h"
#include "host/vk/commands.h"
#include "host/vk/device.h"
#include "host/vk/pipeline.h"
#include "host/vk/timestamps.h"
#include "shaders/shared/layout.h"

namespace vkdose {

struct TableSizes {
    std::uint32_t particles = 0;  ///< slots, a multiple of the workgroup
    std::uint32_t workgroup = 64;
    std::uint32_t rowWidth = 0;
    std::uint32_t surfaces = 0;
    std::uint32_t surfaceKinds = 0;  ///< of the first kUnrolledSurfaces, 4 bits each
    std::uint32_t cells = 0;         ///< a power of two
    bool energyBook = false;
    bool texelReads = true;  ///< wanted; used if every view fits the device's limit

    std::uint32_t groups() const { return particles / workgroup; }
    /// Vectors of a contact's history (kParts in shared/buffers.glsl).
    std::uint32_t historyParts() const { return energyBook ? 5 : 2; }
    std::uint32_t wallSlots() const { return surfaces + gpu::kMaxTurns; }
};

class Passes {
  public:
    Passes(const vk::Device& device, const TableSizes& sizes);

    /// Records steps `first` ... `first + count - 1` of a batch; `source` is the half of the state they start from.
    /// `times` gets a mark before the first step and one after each of the kTimed passes of every step.
    void recordSteps(vk::Commands& commands, std::uint32_t first, std::uint32_t count, std::uint32_t source,
                     bool opening, vk::Timestamps* times = nullptr) const;
    void recordSensing(vk::Commands& commands, std::uint32_t source) const;
    /// Needs an energy book and a step made; `opening` if it was the first.
    void recordEnergySensing(vk::Commands& commands, std::uint32_t source, bool opening) const;

    vk::Buffer state, rows, marks, history, wallHistory, members, control, cells, anchors, sensors, groupMember, books,
        energies;
    const TableSizes sizes;
    bool texelReads() const { return texel_; }
    VkDeviceSize bytes() const;  ///< of all tables

    static constexpr std::array<const char*, 5> kTimed{"clear", "bin", "neighbours", "commit", "step"};

  private:
    gpu::StepPush push(std::uint32_t step, std::uint32_t source, bool opening) const;

    bool texel_;
    vk::BindingSet bindings_;
    vk::Pipeline clear_, bin_, neighbours_, commit_, step_, sense_, senseEnergy_;
};

}  // namespace vkdose
