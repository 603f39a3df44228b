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
    /// How particle state is read: through texel-buffer views where the device's limit allows, or always from storage
    /// buffers.
    enum class Reads { Automatic, Storage } reads = Reads::Automatic;
    std::uint32_t workgroup = 64;      ///< invocations; a power of two, at most 128
    std::uint32_t mostGroups = 65535;  ///< in one row of a dispatch, what every device can do; more go in layers
    std::uint32_t batch = 0;  ///< steps per submission; 0: adapted to the device. Changes no bit of the result.
};

/// Throws DeviceError if there is no such device or it cannot compute.
std::unique_ptr<Backend> makeVulkanBackend(const VulkanOptions& options);
inline std::unique_ptr<Backend> makeVulkanBackend(const vk::DeviceChoice& device) {
    return makeVulkanBackend(VulkanOptions{device});
}

/// Backends of canisters that share the device's tables and step together, each to be used from a thread of its own:
/// all must load before any can, `advance` returns when all who are still there have asked for as many steps, and one
/// that is destroyed is no longer waited for. Results are those of a backend of its own, to the bit; the coil may turn
/// at another rate and the schedule be another one for each. The surfaces must be of the same kinds, in the same order.
std::vector<std::unique_ptr<Backend>> makeVulkanEnsemble(const VulkanOptions& options, std::size_t members);

/// Messages the validation layer gave to a backend made by makeVulkanBackend; `validated` tells whether it listened.
struct ValidationReport {
    bool validated = false;
    std::vector<std::string> messages;
};
ValidationReport validationReport(const Backend& backend);

/// How the device's time divides between the passes, and the size of its tables.
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

/// Advances a loaded Vulkan backend by `steps` with a time mark after every pass, which costs some speed itself. Throws
/// what `advance` throws; std::invalid_argument if the backend is another one.
VulkanProfile profile(Backend& backend, std::uint32_t steps, double coilRate);

/// Bytes on the device of all tables of a loaded Vulkan backend and of those it shares them with.
/// std::invalid_argument if the backend is another one.
double tableBytes(const Backend& backend);

/// Bytes that one particle's step moves between kernels and tables if no cache holds anything, from the layout and the
/// reads and writes of shaders/pass/pairs.comp, surfaces.comp and move.comp without energy book: an estimate. Arguments
/// are means over particles.
double stepBytes(double touching, double touchingWalls);

}  // namespace vkdose
