#include "host/render/ray_caster.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "host/render/colour.h"
#include "host/render/ray_grid.h"
#include "host/vk/buffer.h"
#include "host/vk/commands.h"
#include "shaders/shared/picture.h"
#include "spirv/passes.h"

namespace vkdose::render {

namespace {

using gpu::uvec4;
using gpu::vec4;

constexpr std::uint32_t kGroup = 8;   // invocations in both directions of a workgroup, as cast.comp says
constexpr std::uint32_t kRays = 3;    // per pixel and direction
constexpr int kJointsPerTurn = 128;   // chords then leave the wire's centre line by 0.0003 of its radius
const Vec3 kLight(-0.45, 0.6, 0.66);  // from the left, above and the viewer: right, up, towards

/// The origin lies amid the spheres, or amid the bodies where there are none, so that floats have their smallest
/// rounding errors there.
Vec3 originOf(const Scene& scene) {
    Vec3 low(0), high(0);
    if (!scene.centre.empty()) low = high = scene.centre[0];
    for (const Vec3& c : scene.centre) {
        low = glm::min(low, c);
        high = glm::max(high, c);
    }
    if (scene.centre.empty() && !scene.facets.empty()) return scene.facets[0].facet.corners[0];
    return 0.5 * (low + high);
}

/// Points of the wire's centre line, and its angle about the axis there.
std::vector<vec4> jointsOf(const geometry::Coil& coil, double turned, const Vec3& origin) {
    const int pieces = std::max(1, int(std::ceil(coil.length / coil.pitch * kJointsPerTurn)));
    const double start = std::remainder(turned + coil.startAngle, 2 * kPi);
    std::vector<vec4> joints;
    for (int i = 0; i <= pieces; ++i) {
        const double s = coil.length * i / pieces, angle = start + coil.hand * 2 * kPi * s / coil.pitch;
        const Vec3 x(coil.radius * std::cos(angle), coil.radius * std::sin(angle), coil.zStart + s);
        joints.push_back(vec4(glm::vec3(x - origin), float(angle)));
    }
    return joints;
}

vec4 packed(const Vec3& v, double w) {
    return {glm::vec3(v), float(w)};
}

gpu::PictureParams paramsOf(const Scene& scene, const Camera& camera, const Vec3& origin, const Grid& grid,
                            std::size_t joints) {
    gpu::PictureParams p{};
    p.right = packed(camera.right, camera.pixel);
    p.up = packed(camera.up, camera.eye);
    p.towards = packed(camera.towards, 0);
    p.target = packed(camera.target - origin, 0);
    p.centre = vec4(float(camera.centreX), float(camera.centreY), 0, 0);
    p.light = packed(glm::normalize(kLight.x * camera.right + kLight.y * camera.up + kLight.z * camera.towards), 0);
    if (scene.cut) p.cut = packed(scene.cut->normal, scene.cut->offset - glm::dot(scene.cut->normal, origin));
    p.box = vec4(grid.low, grid.edge);
    if (scene.coil)
        p.wire = vec4(float(-origin.x), float(-origin.y), float(scene.coil->radius), float(scene.coil->wireRadius));
    p.cells = uvec4(grid.cells, scene.centre.size() + joints);
    p.size = uvec4(camera.width, camera.height, scene.centre.size(), kRays);
    return p;
}

/// Corners of a triangle, the first with its kind, and its normals there.
std::vector<vec4> packed(const std::vector<SceneFacet>& facets, const Vec3& origin) {
    std::vector<vec4> values;
    for (const SceneFacet& f : facets) {
        const double kind = f.seeThrough ? gpu::kSeeThrough : f.facet.solid ? gpu::kSolid : gpu::kSheet;
        for (const Vec3& corner : f.facet.corners) values.push_back(packed(corner - origin, kind));
        for (const Vec3& normal : f.facet.normals) values.push_back(packed(normal, 0));
    }
    return values;
}

/// Whether tables are read through texel views. A software device reads a storage buffer ray by ray. No table that
/// can be bound has too many values for a view.
bool readsTexels(const vk::Device& device) {
    const VkPhysicalDeviceLimits& most = device.limits();
    return device.info().type == "CPU" && most.maxTexelBufferElements >= most.maxStorageBufferRange / sizeof(float);
}

/// A buffer of these values. If there are none, a buffer that nothing reads.
template <typename T>
std::unique_ptr<vk::Buffer> filled(const vk::Device& device, const char* name, const std::vector<T>& values,
                                   VkFormat view = VK_FORMAT_UNDEFINED) {
    const std::size_t bytes = std::max<std::size_t>(values.size(), 1) * sizeof(T);
    auto buffer = std::make_unique<vk::Buffer>(device, name, bytes, view);
    buffer->writeAll(values);
    return buffer;
}

Image unpacked(const std::vector<glm::uvec2>& words, const Camera& camera) {
    Image image{camera.width, camera.height, {}, {}};
    image.pixels.reserve(words.size());
    image.depth.reserve(words.size());
    for (const glm::uvec2& w : words) {
        const auto byte = [&w](int shift) { return std::uint8_t(w.x >> shift & 255u); };
        image.pixels.push_back({byte(0), byte(8), byte(16), byte(24)});
        image.depth.push_back(std::bit_cast<float>(w.y));
    }
    return image;
}

}  // namespace

RayCaster::RayCaster(const vk::Device& device) : device_(device) {}

Image RayCaster::draw(const Scene& scene, const Camera& camera) {
    const Vec3 origin = originOf(scene);
    std::vector<vec4> spheres, paint, joints;
    for (std::size_t i = 0; i < scene.centre.size(); ++i) {
        spheres.push_back(packed(scene.centre[i] - origin, scene.radius[i]));
        paint.push_back(packed(linearLight(scene.colour[i]), 0));
    }
    if (scene.coil) joints = jointsOf(*scene.coil, scene.coilAngle, origin);
    std::vector<Corners> triangles;
    for (const SceneFacet& f : scene.facets) {
        const geometry::Triangle& t = f.facet.corners;
        triangles.push_back({glm::vec3(t[0] - origin), glm::vec3(t[1] - origin), glm::vec3(t[2] - origin)});
    }
    const Grid grid = gridOf(spheres, joints, scene.coil ? float(scene.coil->wireRadius) : 0.0f, triangles);

    const std::vector<gpu::PictureParams> params{paramsOf(scene, camera, origin, grid, joints.size())};
    const auto paramsBuffer = filled(device_, "the picture's parameters", params);
    const bool texels = readsTexels(device_);
    const auto viewed = [&](VkFormat format) { return texels ? format : VK_FORMAT_UNDEFINED; };
    const VkFormat floats = viewed(VK_FORMAT_R32G32B32A32_SFLOAT);
    const auto sphereBuffer = filled(device_, "the picture's spheres", spheres, floats);
    const auto paintBuffer = filled(device_, "the picture's colours", paint, floats);
    const auto jointBuffer = filled(device_, "the picture's wire", joints, floats);
    const auto facetBuffer = filled(device_, "the picture's bodies", packed(scene.facets, origin), floats);
    const auto cellBuffer = filled(device_, "the picture's cells", grid.parts, viewed(VK_FORMAT_R32G32B32A32_UINT));
    const auto entryBuffer = filled(device_, "the picture's grid", grid.entries, viewed(VK_FORMAT_R32_UINT));
    const std::size_t pixels = std::size_t(camera.width) * camera.height;
    const vk::Buffer picture(device_, "the picture", pixels * sizeof(glm::uvec2));
    const vk::BindingSet bindings(device_,
                                  {paramsBuffer.get(), sphereBuffer.get(), paintBuffer.get(), jointBuffer.get(),
                                   cellBuffer.get(), entryBuffer.get(), &picture, facetBuffer.get()},
                                  sizeof(std::uint32_t));
    if (!pipeline_)
        pipeline_.emplace(device_, bindings, vk::pick(spirv::cast, texels ? spirv::TEXEL_READS : 0),
                          std::span<const std::uint32_t>());

    vk::Commands commands(device_);
    commands.begin();
    bindings.bind(commands.handle());
    pipeline_->bind(commands.handle());
    commands.dispatch((std::uint32_t(camera.width) + kGroup - 1) / kGroup,
                      (std::uint32_t(camera.height) + kGroup - 1) / kGroup, 1);
    commands.hostBarrier();
    commands.submit();
    return unpacked(picture.readAll<glm::uvec2>(pixels), camera);
}

}  // namespace vkdose::render
