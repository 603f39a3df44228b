#include "host/backend/vulkan/law_trial.h"

#include <fmt/format.h>

#include <map>
#include <mutex>

#include "host/backend/vulkan/pass_code.h"
#include "host/vk/buffer.h"
#include "host/vk/commands.h"
#include "host/vk/pipeline.h"
#include "shaders/shared/layout.h"

namespace vkdose {
namespace {

using gpu::vec4;

constexpr std::size_t kPoints = 96, kPointVectors = 3, kLoadingVectors = 3 + kMostLawParameters / 4, kMemoryVectors = 2;
static_assert(kMostLawProperties == 4);

std::vector<vec4> packed(const std::vector<LawLoading>& loadings) {
    std::vector<vec4> vectors;
    for (const LawLoading& l : loadings) {
        vectors.emplace_back(float(l.radius), float(l.mass), float(l.deepest), float(l.speed));
        for (std::size_t k = 0; k < l.own.size(); k += 4)
            vectors.emplace_back(float(l.own[k]), float(l.own[k + 1]), float(l.own[k + 2]), float(l.own[k + 3]));
        for (const LawProperties& side : {l.sides.i, l.sides.j})
            vectors.emplace_back(float(side[0]), float(side[1]), float(side[2]), float(side[3]));
    }
    return vectors;
}

std::vector<vec4> answersOf(const vk::DeviceChoice& choice, std::span<const std::uint32_t> shader,
                            const std::vector<vec4>& questions) {
    const std::size_t count = questions.size() / kLoadingVectors, vectors = count * kPoints * kPointVectors;
    const vk::Device device(choice);
    vk::Buffer asked(device, "the loadings of a law", questions.size() * sizeof(vec4));
    const vk::Buffer answered(device, "the answers of a law", vectors * sizeof(vec4));
    asked.writeAll(questions);
    const vk::Buffer remembered(device, "the memory of a law", count * kMemoryVectors * sizeof(vec4));
    const vk::BindingSet bindings(device, {&asked, &answered, &remembered}, sizeof(std::uint32_t));
    const vk::Pipeline pipeline(device, bindings, shader, {});
    vk::Commands commands(device);
    commands.begin();
    bindings.bind(commands.handle());
    pipeline.bind(commands.handle());
    // A dispatch for each point: lavapipe ends the loops of an invocation after 65,535 trips together.
    for (std::uint32_t point = 0; point < kPoints; ++point) {
        bindings.push(commands.handle(), &point);
        commands.dispatch(std::uint32_t(count), 1, 1);
        commands.barrier();
    }
    commands.hostBarrier();
    commands.submit();
    return answered.readAll<vec4>(vectors);
}

}  // namespace

std::vector<std::vector<LawPoint>> tryLaw(const vk::DeviceChoice& device, const UserLaw& law,
                                          const std::vector<LawLoading>& loadings) {
    static std::mutex mutex;
    static std::map<std::string, std::vector<vec4>> known;
    const std::vector<vec4> questions = packed(loadings);
    std::string key = law.shader + '\n' + device.name + '\n';
    for (const vec4& v : questions) key += fmt::format("{:a} {:a} {:a} {:a} ", v.x, v.y, v.z, v.w);
    const std::lock_guard lock(mutex);
    auto found = known.find(key);
    if (found == known.end()) {
        const std::span<const std::uint32_t> shader = compiledNow("law/trial.comp", &law, {});
        found = known.emplace(key, answersOf(device, shader, questions)).first;
    }
    std::vector<std::vector<LawPoint>> points(loadings.size());
    const vec4* v = found->second.data();
    for (std::vector<LawPoint>& loading : points)
        for (std::size_t k = 0; k < kPoints; ++k, v += kPointVectors)
            loading.push_back({double(v[0].x),
                               double(v[0].y),
                               double(v[0].z),
                               double(v[0].w),
                               double(v[1].x),
                               double(v[1].y),
                               double(v[1].z),
                               double(v[1].w),
                               {double(v[2].x), double(v[2].y), double(v[2].z), double(v[2].w)}});
    return points;
}

void tryLawsOnDevices() {
    setLawTrial([](const UserLaw& law, const std::vector<LawLoading>& loadings) {
        return tryLaw(vk::DeviceChoice{}, law, loadings);
    });
}

}  // namespace vkdose
