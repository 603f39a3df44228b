#include "host/app/backends.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

#include "host/app/tell.h"
#include "host/backend/vulkan/vulkan.h"

namespace vkdose {

namespace {

/// For a small canister, waking lavapipe's threads in every pass costs more time than they save. Other drivers ignore
/// this variable. A value that the user has set is kept.
void chooseThreads(std::size_t particles) {
    constexpr const char* kVariable = "LP_NUM_THREADS";
    constexpr std::size_t kWorthThreads = 10000;
    static const bool chosen = std::getenv(kVariable) != nullptr;
    if (chosen) return;
    if (particles < kWorthThreads)
        setenv(kVariable, "0", 1);
    else
        unsetenv(kVariable);
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
    chooseThreads(particles);
    return openBackend(choice);
}

std::vector<std::unique_ptr<Backend>> makeEnsemble(const BackendChoice& choice, std::size_t members,
                                                   std::size_t particles) {
    chooseThreads(particles);
    return openEnsemble(choice, members);
}

BackendChoice sameBackend(const std::string& description, const BackendChoice& choice) {
    const std::string vulkan = "vulkan: ";
    BackendChoice same = choice;
    const bool onDevice = description.rfind(vulkan, 0) == 0;
    same.backend = onDevice ? "vulkan" : "reference";
    if (onDevice && same.device.empty()) same.device = description.substr(vulkan.size());
    return same;
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
