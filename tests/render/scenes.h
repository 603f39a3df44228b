#pragma once
// Scenes and cameras of the tests, and a brute-force picture to hold the ray caster against.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "host/render/ray_caster.h"
#include "tests/support/gpu.h"

namespace vkdose::test {

/// Rays per pixel and direction of the ray caster.
inline constexpr int kRays = 3;

/// Draws on the suite's device; fails the test if the validation layer has anything to say.
class Studio {
  public:
    Studio() = default;
    Studio(const Studio&) = delete;
    Studio& operator=(const Studio&) = delete;
    ~Studio() {
        if (!unvalidated()) CHECK(device_.validated());
        for (const std::string& message : device_.validationMessages()) FAIL_CHECK(message);
    }
    render::Image draw(const render::Scene& scene, const render::Camera& camera) { return caster_.draw(scene, camera); }
    render::RayCaster& caster() { return caster_; }

  private:
    vk::Device device_{testDevice()};
    render::RayCaster caster_{device_};
};

/// Looks along -z with parallel rays: x to the right, y up, the origin in the middle.
inline render::Camera frontCamera(int width, int height, double pixel) {
    render::Camera c;
    c.right = {1, 0, 0};
    c.up = {0, 1, 0};
    c.towards = {0, 0, 1};
    c.target = Vec3(0);
    c.pixel = pixel;
    c.centreX = width / 2.0;
    c.centreY = height / 2.0;
    c.width = width;
    c.height = height;
    return c;
}

inline void addSphere(render::Scene& scene, const Vec3& centre, double radius, const Vec3& colour) {
    scene.centre.push_back(centre);
    scene.radius.push_back(radius);
    scene.colour.push_back(colour);
}

inline render::Scene cloud(std::size_t n, double side, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-0.5, 0.5), radius(0.6e-3, 1.9e-3), shade(0, 1);
    render::Scene scene;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 centre = side * Vec3(unit(random), unit(random), unit(random));
        addSphere(scene, centre, radius(random), {shade(random), shade(random), shade(random)});
    }
    return scene;
}

struct Ray {
    Vec3 origin, way;
};

/// Through the middle of one of the parts of a pixel that the ray caster looks at, 0 ... 8.
inline Ray rayOf(const render::Camera& c, int x, int y, int part) {
    const double px = x + (part % kRays + 0.5) / kRays, py = y + (part / kRays + 0.5) / kRays;
    const Vec3 point = c.target + c.right * ((px - c.centreX) * c.pixel) - c.up * ((py - c.centreY) * c.pixel);
    if (c.eye == 0) return {point + c.towards * 10.0, -c.towards};
    const Vec3 eye = c.target + c.towards * c.eye;
    return {eye, glm::normalize(point - eye)};
}

/// The spheres that a pixel shows, one by one in double precision.
struct Sight {
    int hits = 0;
    double depth = -1e30;
    bool face = false;  ///< a cut surface in all of it
};

inline Sight brutePixel(const render::Scene& scene, const render::Camera& c, int x, int y) {
    Sight sight;
    int faces = 0;
    for (int part = 0; part < kRays * kRays; ++part) {
        const Ray ray = rayOf(c, x, y, part);
        double begin = 0;
        if (scene.cut)
            begin =
                (scene.cut->offset - glm::dot(scene.cut->normal, ray.origin)) / glm::dot(scene.cut->normal, ray.way);
        double nearest = 1e30;
        bool opened = false;
        for (std::size_t i = 0; i < scene.centre.size(); ++i) {
            const Vec3 to = scene.centre[i] - ray.origin;
            const double along = glm::dot(to, ray.way), off = glm::dot(to, to) - along * along;
            const double rest = scene.radius[i] * scene.radius[i] - off;
            if (rest <= 0) continue;
            const double in = along - std::sqrt(rest), out = along + std::sqrt(rest);
            if (out < begin) continue;
            if (std::max(in, begin) < nearest) {
                nearest = std::max(in, begin);
                opened = in < begin;
            }
        }
        if (nearest > 1e29) continue;
        ++sight.hits;
        faces += opened;
        sight.depth = std::max(sight.depth, glm::dot(ray.origin + nearest * ray.way - c.target, c.towards));
    }
    sight.face = faces == kRays * kRays;
    return sight;
}

/// Groups of pixels covered at least half that hang together, each with its number of pixels and its middle.
struct Blob {
    double pixels = 0, x = 0, y = 0;
};
inline std::vector<Blob> blobs(const render::Image& image) {
    std::vector<char> seen(image.pixels.size(), 0);
    const auto open = [&](int x, int y) {
        return x >= 0 && y >= 0 && x < image.width && y < image.height && image.at(x, y).cover > 127 &&
               seen[std::size_t(y) * image.width + x] == 0;
    };
    std::vector<Blob> found;
    for (int y0 = 0; y0 < image.height; ++y0)
        for (int x0 = 0; x0 < image.width; ++x0) {
            if (!open(x0, y0)) continue;
            Blob blob;
            std::vector<std::pair<int, int>> todo{{x0, y0}};
            seen[std::size_t(y0) * image.width + x0] = 1;
            while (!todo.empty()) {
                const auto [x, y] = todo.back();
                todo.pop_back();
                blob.pixels += 1;
                blob.x += x + 0.5;
                blob.y += y + 0.5;
                for (const auto& [u, v] : {std::pair{x + 1, y}, {x - 1, y}, {x, y + 1}, {x, y - 1}})
                    if (open(u, v)) {
                        seen[std::size_t(v) * image.width + u] = 1;
                        todo.emplace_back(u, v);
                    }
            }
            blob.x /= blob.pixels;
            blob.y /= blob.pixels;
            found.push_back(blob);
        }
    return found;
}

}  // namespace vkdose::test
