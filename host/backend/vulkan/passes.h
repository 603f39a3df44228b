#pragma once
// The device side of one load: tables, bindings and pipelines, sized for its particles.

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "host/backend/vulkan/tables.h"
#include "host/vk/buffer.h"
#include "host/vk/commands.h"
#include "host/vk/device.h"
#include "host/vk/pipeline.h"
#include "host/vk/timestamps.h"
#include "host/vk/variant.h"
#include "shaders/shared/geometry.h"
#include "shaders/shared/layout.h"

namespace vkdose {

/// The way in which passes read and store. It is chosen for the device.
struct Access {
    bool texelReads = false;    ///< through texel-buffer views
    bool packedStores = false;  ///< 64 bits at a time, where a trial finds it faster; only with texelReads
    bool addressed = false;     ///< tables by their addresses, because one is longer than the device binds
};

/// A table's address as passes read it, the low word first; zero where they do not reach it by address.
glm::uvec2 addressWords(const vk::Buffer& table);

/// The tables of shaders/shared/tables.h, each under its name.
class Tables {
  public:
    Tables(const vk::Device& device, const TableSizes& sizes, const Access& access);

    std::vector<const vk::Buffer*> all() const;  ///< in the order of their bindings
    VkDeviceSize bytes() const;                  ///< of all

    const TableSizes sizes;
    const TableCounts at;  ///< where in a table an element is
    const Access access;
#define TABLE(number, name, element, count, title) vk::Buffer name;
#include "shaders/shared/tables.h"

  private:
    static vk::Buffer make(const vk::Device& device, const TableSizes& sizes, const Access& access, std::size_t number);
};

/// The tables of shaders/shared/body_tables.h.
class BodyTables {
  public:
    /// `shapes`: of all members, one after another. `motionCount`: room for so many. `slots`: of all members, whose
    /// nearby triangles are kept.
    BodyTables(const vk::Device& device, const std::vector<gpu::uvec4>& shapes, std::size_t motionCount,
               std::size_t slots);

#define TABLE(number, name, element, count, title) vk::Buffer name;
#include "shaders/shared/body_tables.h"
};

/// The tables of a step, some of which are replaced by those of the bodies.
std::vector<const vk::Buffer*> with(const BodyTables& bodies, std::vector<const vk::Buffer*> tables);

/// The device's time in each pass, over any number of recordings.
class PassTimes {
  public:
    /// Room for `most` dispatches in a recording. Needs vk::Timestamps::available.
    PassTimes(const vk::Device& device, std::uint32_t most);

    /// Before the first pass of a recording.
    void begin(vk::Commands& commands);
    /// After a dispatch of pass `n` (Passes::names).
    void mark(vk::Commands& commands, std::size_t n);
    /// Adds the recording that was submitted.
    void add();
    /// In pass `n`, of all recordings that were added [s].
    double seconds(std::size_t n) const { return seconds_[n]; }

  private:
    vk::Timestamps times_;
    std::vector<std::size_t> marked_;
    std::vector<double> seconds_;
};

class Passes : public Tables {
  public:
    const BodyTables* const bodies;  ///< null without bodies

    /// `bodies` outlives this; null without bodies.
    Passes(const vk::Device& device, const TableSizes& sizes, const BodyTables* bodyTables = nullptr);

    /// Records `count` steps. A member that calls for new lists makes fewer (gpu::Control::steps); none makes more than
    /// to the end of its batch (gpu::Member::roster). `opening` if the first of them is the first of a member. `late`:
    /// so many steps of the first stride are made. With `times` every pass waits for the one before.
    void recordSteps(vk::Commands& commands, std::uint32_t count, bool opening, std::uint32_t late = 0,
                     PassTimes* times = nullptr) const;
    /// The most dispatches that `recordSteps` records.
    static std::uint32_t mostDispatches(std::uint32_t count);
    /// Records the sensing of the member in this row of the roster (gpu::Member).
    void recordSensing(vk::Commands& commands, std::uint32_t row = 0) const;
    /// Records the sensing of energy. It needs an energy book and at least one step; `opening` if that was the first.
    void recordEnergySensing(vk::Commands& commands, bool opening, std::uint32_t row = 0) const;

    /// Prepares a load without history: nothing is listed, and the first step builds rows and contact lists.
    void reset();
    /// The same for one member, beside others that go on.
    void reset(std::uint32_t member);

    /// From now on the first `live` rows of the roster take part in a step.
    void setLive(std::uint32_t live);

    std::vector<gpu::Control> allControls() const;  ///< of every member
    gpu::Control controlOf(std::uint32_t member) const;
    void setControl(std::uint32_t member, const gpu::Control& c);

    /// The push constants of every dispatch, for the roster's first row.
    gpu::StepPush push(std::uint32_t stepInStride, bool opening) const;
    /// Specialisation constants of every pass over tables of this size; `oneFace`: of the pass `faces`.
    static std::array<std::uint32_t, 17> constants(const TableSizes& sizes, bool oneFace = false);

    /// The passes of a stride, in their order.
    static std::vector<const char*> names();

  private:
    static VkDeviceSize controlOffset(std::uint32_t member) {
        return sizeof(gpu::Dispatches) + member * sizeof(gpu::Control);
    }

    std::span<const std::uint32_t> codeOf(const char* name, std::span<const vk::Variant> variants, bool knowsLaw) const;

    /// The pass `n` of a stride.
    void record(vk::Commands& commands, std::size_t n) const;

    std::uint32_t live_ = 0;
    vk::BindingSet bindings_;
    bool validated_;
    std::unique_ptr<vk::BindingSet> bodyBindings_;    ///< of the passes that read the bodies
    std::deque<std::optional<vk::Pipeline>> passes_;  ///< in their order; none that is for bodies without
    vk::Pipeline sense_, senseEnergy_;
};

}  // namespace vkdose
