#include "host/backend/vulkan/store_trial.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <mutex>
#include <string>

#include "host/vk/buffer.h"
#include "host/vk/commands.h"
#include "host/vk/pipeline.h"
#include "spirv/passes.h"

namespace vkdose {
namespace {

// A try stores half a megabyte. That takes a core some 0.1 to 0.2 ms, several times as long as a submission.
constexpr std::uint32_t kGroups = 64, kInvocations = 64 * kGroups, kRounds = 4;
constexpr int kTries = 5;

double secondsOf(vk::Commands& commands, const vk::BindingSet& bindings, const vk::Pipeline& pipeline) {
    commands.begin();
    bindings.bind(commands.handle());
    pipeline.bind(commands.handle());
    for (std::uint32_t round = 0; round < kRounds; ++round) {
        commands.dispatch(kGroups, 1, 1);
        commands.barrier();
    }
    commands.hostBarrier();
    const auto start = std::chrono::steady_clock::now();
    commands.submit();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

StoreTrial tryStores(const vk::Device& device) {
    constexpr std::size_t kVectors = 2 * std::size_t(kInvocations);
    const vk::Buffer plainBuffer(device, "the trial of plain stores", kVectors * sizeof(gpu::vec4));
    const vk::Buffer packedBuffer(device, "the trial of packed stores", kVectors * sizeof(gpu::vec4));
    const vk::BindingSet toPlain(device, {&plainBuffer}, 4), toPacked(device, {&packedBuffer}, 4);
    const vk::Pipeline plain(device, toPlain, vk::pick(spirv::store_trial, 0), {});
    const vk::Pipeline packed(device, toPacked, vk::pick(spirv::store_trial, spirv::TEXEL_READS | spirv::PACKED_STORES),
                              {});
    vk::Commands commands(device);
    StoreTrial trial;
    trial.plain.seconds = trial.packed.seconds = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kTries; ++k) {
        trial.plain.seconds = std::min(trial.plain.seconds, secondsOf(commands, toPlain, plain));
        trial.packed.seconds = std::min(trial.packed.seconds, secondsOf(commands, toPacked, packed));
    }
    trial.plain.stored = plainBuffer.readAll<gpu::vec4>(kVectors);
    trial.packed.stored = packedBuffer.readAll<gpu::vec4>(kVectors);
    return trial;
}

bool storesFasterPacked(const vk::Device& device) {
    if (!device.hasInt64()) return false;
    static std::mutex mutex;
    static std::map<std::string, bool> known;
    const std::lock_guard lock(mutex);
    const std::string key = device.info().name + '\n' + device.info().driver;
    const auto found = known.find(key);
    if (found != known.end()) return found->second;
    const StoreTrial trial = tryStores(device);
    // On a fast device starting the work takes longer than the stores, and chance would choose.
    constexpr double kClearGain = 0.9;
    return known.emplace(key, trial.packed.seconds < kClearGain * trial.plain.seconds).first->second;
}

}  // namespace vkdose
