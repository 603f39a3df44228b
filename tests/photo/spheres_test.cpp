// A bed of spheres drawn with light and shade: its profile is the upper outline of the spheres, known to rounding.

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "host/photo/profile.h"
#include "tests/photo/drawing.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::photo;
using namespace vkdose::test;

namespace {

constexpr double kPixel = 0.1;  ///< [mm]
constexpr int kWidth = 600, kHeight = 300;

struct Sphere {
    double z, y, depth, radius;  ///< [mm]; y from the lowest point, depth towards the viewer
};

/// Spheres of the paper's sizes, everywhere below a slope with a hollow, layer behind layer.
std::vector<Sphere> bed() {
    std::vector<Sphere> spheres;
    for (std::uint64_t i = 0; i < 6000; ++i) {
        const auto place = uniforms(11, Stream::Jitter, i), size = uniforms(11, Stream::Radius, i);
        const double z = 60 * place[0], radius = 0.625 + 1.25 * size[0];
        const double top = 9 + 0.15 * z - 3 * std::exp(-std::pow((z - 35) / 6, 2));
        const double y = radius + (top - 2 * radius) * place[1];
        spheres.push_back({z, y, size[1] * 20, radius});
    }
    return spheres;
}

/// Upper outline over a place [mm]; below everything where there is no sphere.
double outline(const std::vector<Sphere>& spheres, double z) {
    double top = -std::numeric_limits<double>::infinity();
    for (const Sphere& s : spheres) {
        const double dz = z - s.z;
        if (std::abs(dz) < s.radius) top = std::max(top, s.y + std::sqrt(s.radius * s.radius - dz * dz));
    }
    return top;
}

/// Brown powder seen from the side in light from above, its spheres dark at their lower rims, before a light wall.
Grey photograph(const std::vector<Sphere>& spheres, double noise) {
    Grey grey(kWidth, kHeight);
    std::vector<double> nearest(grey.value.size(), -1), value(grey.value.size(), 205);
    for (const Sphere& s : spheres) {
        const int x0 = int((s.z - s.radius) / kPixel) - 1, x1 = int((s.z + s.radius) / kPixel) + 1;
        for (int x = std::max(x0, 0); x <= std::min(x1, kWidth - 1); ++x) {
            for (int y = 0; y < kHeight; ++y) {
                const double dz = (x + 0.5) * kPixel - s.z, dy = (kHeight - y - 0.5) * kPixel - s.y;
                const double inside = s.radius * s.radius - dz * dz - dy * dy;
                if (inside <= 0) continue;
                const double towards = std::sqrt(inside), depth = s.depth + towards;
                const auto i = std::size_t(y) * kWidth + std::size_t(x);
                if (depth <= nearest[i]) continue;
                nearest[i] = depth;
                const double lit = std::max(0.0, (0.75 * dy + 0.6 * towards + 0.25 * dz) / s.radius);
                value[i] = 30 + 85 * lit;
            }
        }
    }
    for (std::size_t i = 0; i < value.size(); ++i) {
        const double lamp = 1.15 - 0.35 * double(i % kWidth) / kWidth;
        const double v = value[i] * lamp + noise * normalDeviate(5, i);
        grey.value[i] = std::uint8_t(std::lround(std::clamp(v, 0.0, 255.0)));
    }
    return grey;
}

}  // namespace

TEST_CASE("the profile of a bed of spheres is their outline") {
    const std::vector<Sphere> spheres = bed();
    for (const double noise : {0.0, 6.0}) {
        Reading r;
        r.mmPerPixel = kPixel;
        const Surface s = surfaceOf(pictureOf(photograph(spheres, noise)), r);
        REQUIRE(s.powder == Powder::Dark);
        double sum = 0;
        int far = 0;
        for (const SurfacePoint& p : s.points) {
            REQUIRE(p.heightMm);
            const double error = (*p.heightMm - outline(spheres, p.zMm)) / kPixel;
            sum += error;
            far += std::abs(error) > 1 ? 1 : 0;
        }
        // In pixels: the grid's half, and on the flanks of single spheres, which are as steep as one likes, whatever
        // the median of 3 x 3 does to a cusp. So a few columns may be off by more than one, and the mean hardly at all.
        CAPTURE(noise, far, sum / kWidth);
        CHECK(far < kWidth / 100);
        CHECK(near(sum / kWidth, 0, 1, 0.1));
    }
}
