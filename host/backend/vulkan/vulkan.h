#pragma once
// The Vulkan backend: the passes of shaders/pass on any device with Vulkan 1.1 compute.

#include <memory>
#include <string>
#include <vector>

#include "host/backend/backend.h"
#include "host/vk/device.h"

namespace vkdose {

struct VulkanOptions {
    vk::DeviceChoice device;
    /// The way to read tables: through texel-buffer views on a device that is a CPU, if its limit allows it
    /// (Automatic), or always from storage buffers (Storage).
    enum class Reads { Automatic, Storage } reads = Reads::Automatic;
    bool addressed = false;            ///< reach tables by address even where they can be bound
    std::uint32_t workgroup = 64;      ///< invocations; a power of two, at most 128
    std::uint32_t mostGroups = 65535;  ///< in one row of a dispatch, what every device can do; more go in layers
    /// Steps per submission; 0: adapted to the device. Changes neither a bit of the result nor the steps at which
    /// contact lists are made anew.
    std::uint32_t batch = 0;
};

/// Throws DeviceError if there is no such device or it cannot compute.
std::unique_ptr<Backend> makeVulkanBackend(const VulkanOptions& options);
inline std::unique_ptr<Backend> makeVulkanBackend(const vk::DeviceChoice& device) {
    return makeVulkanBackend(VulkanOptions{device});
}

class Rendezvous;

/// Canisters that share the device's tables and step together. Each has a backend, which must be used from a thread of
/// its own, because they wait for each other: all must load before any can go on, and `advance` returns when all
/// backends that still exist have asked for as many steps. A backend that is destroyed is no longer waited for, and
/// another one can enter in its place while the others go on. The results are the same, to the bit, as those of a
/// single backend. Each canister may have its own rate of the coil and its own schedule. The surfaces must be of the
/// same kinds, in the same order.
class VulkanEnsemble {
  public:
    /// Throws DeviceError if there is no such device or it cannot compute.
    explicit VulkanEnsemble(const VulkanOptions& options);

    /// A backend, for whose `load` the others wait from now on. Those that are to begin together enter before any of
    /// them loads. May be called from any thread. Backends outlive the ensemble.
    std::unique_ptr<Backend> enter();

  private:
    std::shared_ptr<Rendezvous> rendezvous_;
};

/// The backends of an ensemble of so many.
std::vector<std::unique_ptr<Backend>> makeVulkanEnsemble(const VulkanOptions& options, std::size_t members);

/// Messages that the validation layer gave to a backend made by makeVulkanBackend. `validated` tells whether the layer
/// was active.
struct ValidationReport {
    bool validated = false;
    std::vector<std::string> messages;
};
ValidationReport validationReport(const Backend& backend);

/// The share of each pass in the device's time, and the size of the tables.
struct VulkanProfile {
    struct Pass {
        std::string name;
        double seconds =
            0;  ///< on the device's clock, over all steps of the profile; a pass asked for nothing included
    };
    std::vector<Pass> passes;     ///< in the order of a step; empty: the device keeps no time
    std::uint32_t steps = 0;      ///< made for the profile
    std::uint64_t rebuilds = 0;   ///< of the neighbour rows, in these steps
    std::uint64_t refreshes = 0;  ///< of the contact lists
    double listed = 0;            ///< neighbours in a row, mean over particles
    double tableBytes = 0;        ///< of all buffers
    double copyBandwidth = 0;     ///< of a copy between two buffers, read and write counted [bytes/s]
    bool texelReads = false;
};

/// Advances a loaded Vulkan backend by `steps` with a time mark after every pass. The marks cost some speed. Throws the
/// same errors as `advance`, and std::invalid_argument if the backend is not a Vulkan backend.
VulkanProfile profile(Backend& backend, std::uint32_t steps, double coilRate);

/// How often a loaded Vulkan backend has made its contact lists anew since load or restore. It follows from the state
/// and the number of steps alone. Throws std::invalid_argument if the backend is not a Vulkan backend.
std::uint32_t refreshes(const Backend& backend);

/// Bytes on the device of all tables of a loaded Vulkan backend, together with those of the backends that share them.
/// Throws std::invalid_argument if the backend is not a Vulkan backend.
double tableBytes(const Backend& backend);

/// Estimate of the bytes that one particle's step moves between kernels and tables if no cache holds anything. It
/// counts the reads and writes of shaders/pass/pairs.comp, surfaces.comp and move.comp without energy book, with the
/// sizes of the layout. The arguments are means over particles.
double stepBytes(double touching, double touchingWalls);

}  // namespace vkdose
