#pragma once
// Draws spheres, a coil and bodies on a Vulkan device, by rays in a compute pass: no window, no graphics queue.

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/coil.h"
#include "host/analysis/drawn_bodies.h"
#include "host/render/camera.h"
#include "host/vk/device.h"
#include "host/vk/pipeline.h"

namespace vkdose::render {

/// A triangle of a body in the world.
struct SceneFacet {
    Facet facet;
    bool seeThrough = false;
};

/// All that can be seen.
struct Scene {
    std::vector<Vec3> centre;    ///< of the spheres [m]
    std::vector<double> radius;  ///< [m]
    std::vector<Vec3> colour;    ///< sRGB, 0 ... 1
    std::optional<geometry::Coil> coil;
    double coilAngle = 0;  ///< rotation about +z since its start [rad]
    std::vector<SceneFacet> facets;
    std::optional<CutPlane> cut;
};

/// A picture of a scene alone, transparent where nothing is.
struct Image {
    struct Pixel {
        std::uint8_t red, green, blue, cover;  ///< sRGB of what is there; how much of the pixel it covers, 255: all
    };
    int width = 0, height = 0;
    std::vector<Pixel> pixels;  ///< row by row from the top
    /// Of the nearest thing in the pixel that is not seen through, as Camera::Place::depth [m]; -1e30: nothing.
    std::vector<float> depth;

    const Pixel& at(int x, int y) const { return pixels[std::size_t(y) * width + x]; }
    float depthAt(int x, int y) const { return depth[std::size_t(y) * width + x]; }
};

class RayCaster {
  public:
    explicit RayCaster(const vk::Device& device);

    /// The same scene and camera give the same bits on the same device. Throws DeviceError if the device cannot hold
    /// the scene.
    Image draw(const Scene& scene, const Camera& camera);

  private:
    const vk::Device& device_;
    std::optional<vk::Pipeline> pipeline_;  ///< made with the first picture's bindings, good for those of all
};

}  // namespace vkdose::render
