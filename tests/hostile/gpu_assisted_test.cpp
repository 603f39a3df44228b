// The passes under the validation layer's GPU-assisted checks, which put a bounds check before every access of a
// buffer: no pass reads or writes outside.
#include "host/backend/vulkan/pack.h"
#include "host/backend/vulkan/passes.h"
#include "tests/support/gpu.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// While it lives, the validation layer checks on the device as well.
class Assisted {
  public:
    Assisted() { setenv("VK_LAYER_ENABLES", "VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT", 1); }
    ~Assisted() { unsetenv("VK_LAYER_ENABLES"); }
    Assisted(const Assisted&) = delete;
    Assisted& operator=(const Assisted&) = delete;
};

/// Its messages on the device, without those on features that it switches on for itself.
std::vector<std::string> withoutItsOwn(std::vector<std::string> messages) {
    std::erase_if(messages, [](const std::string& m) { return m.find("Internal Warning: ") != std::string::npos; });
    return messages;
}

/// Whether the layer has given the checks up, because the device cannot do what they need. Without them a test would
/// judge nothing, so it is skipped.
bool givenUp(const std::vector<std::string>& messages) {
    for (const std::string& m : messages)
        if (m.find("GPU-AV is being disabled") != std::string::npos) {
            WARN("skipped: the layer's GPU-assisted checks need more than this device has: " << m);
            return true;
        }
    return false;
}

}  // namespace

TEST_CASE("GPU-assisted checks find an access outside a buffer", "[slow]") {
    const Assisted assisted;
    vk::Device device(testDevice());
    REQUIRE(device.validated());
    if (givenUp(device.validationMessages())) return;
    Particles p;
    p.add({0, 0, 0}, 1e-3);
    const RuledWorld world = emptyWorld();
    gpu::Member member = packMember(world, world.law, p);
    member.roster.z = 1;  // a batch of one step
    Passes passes(device, tableSizes(world, Crowd(p), member, {64, 65535, device.limits().maxStorageBufferRange}));
    passes.members.write(0, &member, sizeof member);
    std::vector<gpu::vec4> half(std::size_t(gpu::kFields) * 64);
    packState(p, 64, 0, half);
    passes.state.writeAll(half);
    passes.reset();
    gpu::Control control = passes.controlOf(0);
    control.wanted = gpu::uvec4(0U);  // goes on with the lists, which hold a pair ...
    control.listed.x = 1;
    passes.setControl(0, control);
    const glm::uvec2 pair(0U, 100'000U);  // ... with a particle that there is not
    passes.entries.write(0, &pair, sizeof pair);
    vk::Commands commands(device);
    commands.begin();
    passes.recordSteps(commands, 1, true);
    commands.hostBarrier();
    commands.submit();
    const std::vector<std::string> messages = withoutItsOwn(device.validationMessages());
    REQUIRE_FALSE(messages.empty());
    CHECK_THAT(messages.front(), Catch::Contains("out of bounds"));
}

TEST_CASE("no pass reaches outside its buffers while a heap falls on the turning coil", "[slow]") {
    const Assisted assisted;
    for (const auto reads : {VulkanOptions::Reads::Automatic, VulkanOptions::Reads::Storage}) {
        VulkanOptions options;
        options.reads = reads;
        const auto backend = test::gpu(options);
        if (givenUp(validationReport(*backend).messages)) return;
        Particles p;
        for (int i = 0; i < 67; ++i)
            p.add({-6e-3 + 3e-3 * (i % 5), 0.0128 + 2.9e-3 * (i / 35), 3e-3 + 3e-3 * (i / 5 % 7)}, 1.4e-3, {0, -1, 0});
        backend->load(canisterWorld(), p);
        const Sensors end = backend->advance(500, -9.0);
        CHECK(end.maxOverlapRatio > 0);  // something was touched
        CHECK(end.rebuilds > 1);
        ValidationReport report = validationReport(*backend);
        report.messages = withoutItsOwn(report.messages);
        requireClean(report);
    }
}
