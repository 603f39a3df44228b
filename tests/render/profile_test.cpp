// A photograph taken by the ray caster: the profile found in it is that of the particles.

#include "host/photo/profile.h"
#include "host/analysis/free_surface.h"
#include "tests/render/scenes.h"
#include "tests/support/near.h"
#include "tests/support/places.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr double kPixel = 0.15e-3;  // [m]
constexpr int kWidth = 400;         // 60 mm, the canister's length
constexpr int kHeight = 560;

/// From -x, the canister's lowest point and rear wall in the lower left corner.
render::Camera besideTheCanister(const Canister& canister) {
    render::Camera c = frontCamera(kWidth, kHeight, kPixel);
    c.right = {0, 0, 1};
    c.towards = {-1, 0, 0};
    c.target = {0, -canister.width / 2, 0};
    c.centreX = 0;
    c.centreY = kHeight;
    return c;
}

/// Before a light wall.
photo::Grey photograph(const render::Image& image) {
    photo::Grey grey(image.width, image.height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const render::Image::Pixel& p = image.pixels[i];
        const double powder = (p.red + p.green + p.blue) / 3.0, share = p.cover / 255.0;
        grey.value[i] = std::uint8_t(std::lround(share * powder + (1 - share) * 225));
    }
    return grey;
}

}  // namespace

TEST_CASE("the profile of a picture of the settled bed is the surface of its particles") {
    const Case c = loadCase(sourceDir() + "/tools/bench-data/bed-48g.toml");
    const Particles particles = insertParticles(c).particles;
    render::Scene scene;
    for (std::size_t i = 0; i < particles.size(); ++i)
        addSphere(scene, particles.position[i], particles.radius[i], {0.25, 0.13, 0.06});
    Studio studio;
    const photo::Grey grey = photograph(studio.draw(scene, besideTheCanister(*c.canister)));

    photo::Reading reading;
    reading.mmPerPixel = kPixel * 1e3;
    const photo::Surface found = photo::surfaceOf(photo::pictureOf(grey), reading);
    const SurfaceProfile known = surfaceProfile(particles, *c.canister, kWidth, Across::Highest);
    REQUIRE(found.points.size() == known.height.size());
    // To a pixel, which is half of the grid's own and what the picture blurs; the median of 3 x 3 may take the height
    // of a column beside it, where the flanks of single spheres are steep.
    const int last = kWidth - 1;
    double sum = 0;
    for (int i = 0; i <= last; ++i) {
        REQUIRE(found.points[std::size_t(i)].heightMm);
        const double height = *found.points[std::size_t(i)].heightMm * 1e-3;
        const auto [low, high] = std::minmax_element(known.height.begin() + std::max(i - 1, 0),
                                                     known.height.begin() + std::min(i + 1, last) + 1);
        CAPTURE(i, height, *low, *high);
        CHECK(height > *low - kPixel);
        CHECK(height < *high + kPixel);
        sum += height - known.height[std::size_t(i)];
    }
    CHECK(near(sum / kWidth, 0, kPixel, 0.1));
}
