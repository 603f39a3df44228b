#include "host/app/backends.h"

#include <fmt/format.h>

#include <cstdio>
#include <string_view>

#include "host/app/tell.h"
#include "host/backend/vulkan/vulkan.h"
#include "host/vk/driver_variable.h"

namespace vkdose {

namespace {

constexpr std::string_view kVulkan = "vulkan: ";  ///< at the front of a device's description

bool hasAvx512() {
#ifdef __x86_64__
    return __builtin_cpu_supports("avx512f") != 0;
#else
    return false;
#endif
}

void tuneLavapipe(std::size_t particles) {
    // For a small canister, waking lavapipe's threads in every pass costs more time than they save.
    constexpr std::size_t kWorthThreads = 10'000;
    vk::setForDriver("LP_NUM_THREADS", "0", particles < kWorthThreads);
    // Beyond what lavapipe binds, tables are reached by address, and vectors of 256 bits are slow at that where AVX-512
    // gives eight addresses a register of their own (tools/results/README.md, "Four million spheres").
    constexpr std::size_t kMostBound = 1'030'000;
    vk::setForDriver("LP_NATIVE_VECTOR_WIDTH", "128", particles > kMostBound && hasAvx512());
}

std::vector<std::string> findingsOf(const ValidationReport& report) {
    std::vector<std::string> found;
    for (const std::string& message : report.messages) found.push_back("validation: " + message);
    if (!report.validated)
        found.emplace_back("vkdose: the validation layer is not installed (vulkan-validationlayers)");
    return found;
}

/// Prints the findings on stderr. Returns true if there are none.
bool saidNone(const std::vector<std::string>& findings) {
    for (const std::string& line : findings) tell(stderr, "{}\n", line);
    return findings.empty();
}

}  // namespace

std::unique_ptr<Backend> makeBackend(const BackendChoice& choice, std::size_t particles) {
    tuneLavapipe(particles);
    return openBackend(choice);
}

VulkanEnsemble makeEnsemble(const BackendChoice& choice, std::size_t particles) {
    tuneLavapipe(particles);
    return openEnsemble(choice);
}

BackendChoice sameBackend(const std::string& description, const BackendChoice& choice) {
    BackendChoice same = choice;
    const bool onDevice = description.starts_with(kVulkan);
    same.backend = onDevice ? "vulkan" : "reference";
    if (onDevice && same.device.empty())
        same.device = std::to_string(vk::chooseAgain(vk::listDevices(), description.substr(kVulkan.size())).index);
    return same;
}

void requireSameKind(const std::string& description, const BackendChoice& choice, const Backend& backend) {
    if (!description.starts_with(kVulkan) || !choice.device.empty()) return;
    vk::DeviceInfo here;
    here.name = backend.description().substr(kVulkan.size());
    here.usable = true;
    (void)vk::chooseAgain({here}, description.substr(kVulkan.size()));
}

BackendChoice choiceOfRank(const BackendChoice& choice, const std::vector<vk::DeviceInfo>& devices, int localRank) {
    BackendChoice own = choice;
    if (choice.backend == "reference" || !choice.device.empty()) return own;
    const std::vector<vk::DeviceInfo> best = vk::bestOf(devices);
    if (!best.empty() && best.front().isGpu())
        own.device = std::to_string(best[std::size_t(localRank) % best.size()].index);
    return own;
}

std::vector<std::string> validationFindings(const BackendChoice& choice, const Backend& backend) {
    if (!choice.validation) return {};
    return findingsOf(validationReport(backend));
}

bool validationClean(const BackendChoice& choice, const Backend& backend) {
    return saidNone(validationFindings(choice, backend));
}

bool validationClean(const BackendChoice& choice, const vk::Device& device) {
    if (!choice.validation) return true;
    return saidNone(findingsOf({device.validated(), device.validationMessages()}));
}

}  // namespace vkdose
