#pragma once
// The narrow phase of bodies on the device, alone: tests/pass/body_features.comp.

#include <algorithm>
#include <map>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/shape.h"
#include "host/backend/vulkan/pack_bodies.h"
#include "host/backend/vulkan/split.h"
#include "host/vk/commands.h"
#include "host/vk/pipeline.h"
#include "spirv/body_features.spv.h"
#include "spirv/body_features_texel.spv.h"
#include "tests/geometry/facets.h"
#include "tests/support/catch.h"
#include "tests/support/gpu.h"

namespace vkdose::test {

inline RigidBody bodyOf(std::vector<geometry::Shape> shapes) {
    RigidBody body;
    body.name = "part";
    body.shapes = std::move(shapes);
    return body;
}

/// The mesh of the facets, for spheres that reach as far as `reach` [m].
inline std::shared_ptr<const geometry::MeshSurface> meshOf(const Facets& facets, double reach) {
    return std::make_shared<geometry::MeshSurface>(geometry::makeMesh(geometry::soupOf(facets, "facets"), 1e-10).mesh,
                                                   reach);
}

struct Answer {
    std::uint32_t count = 0;
    bool mayTouch = false, mayBeNear = false;
    bool sameFromList = true;  ///< what a list of the mesh's parts, made a little way off, gives
    std::vector<geometry::Feature> features;  ///< normal in the world; distance
};

struct Query {
    Vec3 centre{0};  ///< in the world [m]
    double radius = 0;
    std::uint32_t body = 0;
};

/// Runs tests/pass/body_features.comp.
class Narrow {
  public:
    static constexpr std::size_t kQueries = 4096, kBodies = 4;

    std::vector<Answer> ask(const PackedBodies& bodies, const std::vector<geometry::Pose>& poses,
                            const std::vector<Query>& queries) {
        REQUIRE(bodies.table.size() <= kVectors);
        REQUIRE(queries.size() <= kQueries);
        geometry_.writeAll(bodies.table);
        std::vector<gpu::BodyMotion> motions;
        for (const geometry::Pose& pose : poses) motions.push_back(packMotion({}, pose, {}));
        motions_.writeAll(motions);
        std::vector<gpu::vec4> centres;
        for (const Query& q : queries) {
            const Split3 s(q.centre);
            centres.emplace_back(s.high, float(q.radius));
            centres.emplace_back(s.low, float(q.body));
        }
        queries_.writeAll(centres);
        vk::Commands commands(device_);
        commands.begin();
        bindings_.bind(commands.handle());
        pipeline({bodies.kinds, bodies.places}).bind(commands.handle());
        const auto count = std::uint32_t(queries.size());
        bindings_.push(commands.handle(), &count);
        commands.dispatch((count + 63) / 64, 1, 1);
        commands.hostBarrier();
        commands.submit();
        for (const std::string& message : device_.validationMessages()) FAIL_CHECK(message);
        return answers(queries);
    }

    const vk::Device& device() const { return device_; }

  private:
    static constexpr std::size_t kVectors = 1 << 21;

    /// `constants`: the kinds of shapes, and in how many places a sphere touches them at most.
    const vk::Pipeline& pipeline(const std::vector<std::uint32_t>& constants) {
        const auto known = pipelines_.find(constants);
        if (known != pipelines_.end()) return known->second;
        const std::span<const std::uint32_t> texel(body_features_texel_spv), plain(body_features_spv);
        return pipelines_
            .emplace(std::piecewise_construct, std::forward_as_tuple(constants),
                     std::forward_as_tuple(device_, bindings_, texels_ ? texel : plain, constants))
            .first->second;
    }

    std::vector<Answer> answers(const std::vector<Query>& queries) const {
        const auto counts = counts_.readAll<gpu::uvec4>(queries.size());
        const auto places = places_.readAll<gpu::vec4>(queries.size() * geometry::kMaxFeatures);
        std::vector<Answer> all;
        for (std::size_t q = 0; q < queries.size(); ++q) {
            Answer a{counts[q].x, counts[q].y != 0, counts[q].z != 0, counts[q].w != 0, {}};
            for (std::size_t k = 0; k < std::min<std::size_t>(a.count, geometry::kMaxFeatures); ++k) {
                const gpu::vec4 p = places[q * geometry::kMaxFeatures + k];
                geometry::Feature f;
                f.normal = Vec3(glm::vec3(p));
                f.distance = queries[q].radius - double(p.w);
                a.features.push_back(f);
            }
            all.push_back(std::move(a));
        }
        return all;
    }

    vk::Device device_{testDevice()};
    // As the passes do: through a texel view, where the device has long enough ones.
    const bool texels_ = device_.limits().maxTexelBufferElements >= kVectors;
    vk::Buffer geometry_{device_, "geometry", kVectors * sizeof(gpu::uvec4),
                         texels_ ? VK_FORMAT_R32G32B32A32_UINT : VK_FORMAT_UNDEFINED};
    vk::Buffer motions_{device_, "motions", kBodies * sizeof(gpu::BodyMotion)};
    vk::Buffer queries_{device_, "queries", 2 * kQueries * sizeof(gpu::vec4)};
    vk::Buffer counts_{device_, "counts", kQueries * sizeof(gpu::uvec4)};
    vk::Buffer places_{device_, "places", kQueries* geometry::kMaxFeatures * sizeof(gpu::vec4)};
    vk::BindingSet bindings_{device_, {&geometry_, &motions_, &queries_, &counts_, &places_}, 4};
    std::map<std::vector<std::uint32_t>, vk::Pipeline> pipelines_;  // by their constants
};

}  // namespace vkdose::test
