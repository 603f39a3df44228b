#pragma once
// Vulkan backends for tests: with validation on, and a check that it had nothing to say.

#include <cstdlib>

#include "host/backend/reference/reference.h"
#include "host/backend/vulkan/vulkan.h"
#include "tests/support/catch.h"
#include "tests/support/places.h"

namespace vkdose::test {

/// The device the suite runs on: VKDOSE_TEST_DEVICE, or the first one the automatic choice takes.
inline vk::DeviceChoice testDevice() {
    const char* name = std::getenv("VKDOSE_TEST_DEVICE");
    return {name == nullptr ? "" : name, true};
}

inline std::unique_ptr<Backend> gpu(VulkanOptions options = {}) {
    options.device = testDevice();
    return makeVulkanBackend(options);
}

/// The reference, or a Vulkan backend.
inline std::unique_ptr<Backend> made(bool reference, const VulkanOptions& options = {}) {
    return reference ? makeReferenceBackend() : gpu(options);
}

/// Options of a backend whose tables are reached by address. A device without addresses binds them, and says so.
inline VulkanOptions byAddress(VulkanOptions options = {}) {
    static const bool has = vk::Device(testDevice()).hasAddresses();
    if (!has) WARN("the device gives no addresses of buffers; its tables are bound");
    options.addressed = has;
    return options;
}

inline std::vector<std::unique_ptr<Backend>> gpuEnsemble(std::size_t members) {
    VulkanOptions options;
    options.device = testDevice();
    return makeVulkanEnsemble(options, members);
}

/// Fails the test if the validation layer is missing or complained.
inline void requireClean(const ValidationReport& report) {
    if (unvalidated() && !report.validated) {
        WARN("not validated: the validation layer is not installed");
        return;
    }
    REQUIRE(report.validated);
    for (const std::string& message : report.messages) FAIL_CHECK(message);
}
inline void requireClean(const Backend& backend) {
    requireClean(validationReport(backend));
}

/// The paper's contact parameters (k in N/m, settling adhesion), torsion switched on so that it is tested as well.
inline ContactLaw paperLaw(double kcOverK = 0.3) {
    ContactLaw law;
    const double k = 24067;
    for (int c = 0; c < kContactClasses; ++c) {
        ContactParameters& p = law.between(0, c);
        p.k1 = k / 5;
        p.k2Max = k;
        p.kc = kcOverK * k;
        p.plasticityDepth = 0.05;
        p.gamma = 0.0827;
        p.mu = c == 0 ? 0.5 : 0.2 + 0.1 * c;  // every class its own friction, so that a mix-up shows
        p.kt = p.kr = 0.286 * k;
        p.gammaT = p.gammaR = 0.286 * p.gamma;
        p.muR = 0.5;
        p.kTo = 0.2 * k;
        p.gammaTo = 0.2 * p.gamma;
        p.muTo = 0.1;
    }
    return law;
}

inline RuledWorld emptyWorld() {
    RuledWorld w;
    w.law = paperLaw();
    w.density() = 1427;
    w.timeStep = 2.26e-6;
    w.skin = 0.15e-3;
    w.domain = {Vec3(-1), Vec3(1)};
    return w;
}

/// The paper's canister, narrow coil.
inline RuledWorld canisterWorld() {
    RuledWorld w = emptyWorld();
    w.walls = {geometry::Trough{0.0115, 0.06}, geometry::Plane{{0, 0, 0}, {0, 0, 1}},
               geometry::Front{0.06, 0.0115, 0.01}};
    w.coil = geometry::Coil{0.0104, 0.00875, 0.001, 0.07};
    w.domain = {{-0.02, -0.02, -0.01}, {0.02, 1.0, 0.08}};
    w.throatZ = 0.06;
    w.outletZ = 0.07;
    return w;
}

}  // namespace vkdose::test
