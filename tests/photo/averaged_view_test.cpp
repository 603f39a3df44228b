// One bed, photographed and simulated: photographs that are averaged and read give the surface that the element test of
// a drum has of the same spheres.

#include <cmath>
#include <vector>

#include "host/analysis/drum.h"
#include "host/core/random.h"
#include "host/photo/mean_picture.h"
#include "host/photo/profile.h"
#include "tests/photo/drawing.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::photo;
using namespace vkdose::test;

namespace {

constexpr double kSize = 0.1e-3;  ///< of a pixel [m]
constexpr int kAcross = 200, kUp = 400;
constexpr double kHalf = kAcross * kSize / 2;

/// Spheres of 1 mm below an S-shaped surface in a drum whose bed rises and falls by a millimetre from photograph to
/// photograph, with some in flight.
Particles bedOf(std::uint64_t photograph) {
    Particles p;
    const double rise = 1e-3 * (2 * uniforms(3, Stream::Jitter, photograph)[0] - 1);
    for (std::uint64_t i = 0; i < 8000; ++i) {
        const auto place = uniforms(100 + photograph, Stream::Jitter, i);
        const double x = (2 * place[0] - 1) * 1.1 * kHalf, top = 9e-3 * std::sin(x / 9e-3) + rise;
        p.add({x, top - 0.5e-3 - (top - 0.5e-3 + 20e-3) * place[1], 0}, 0.5e-3);
    }
    for (std::uint64_t i = 0; i < 20; ++i) {
        const auto place = uniforms(200 + photograph, Stream::Jitter, i);
        p.add({(2 * place[0] - 1) * kHalf, 12e-3 + 6e-3 * place[1], 0}, 0.5e-3);
    }
    return p;
}

/// Dark powder before a lit background.
Grey photographOf(const Particles& powder) {
    Grey grey(kAcross, kUp);
    for (auto& v : grey.value) v = 200;
    for (std::size_t i = 0; i < powder.size(); ++i)
        blot(grey, (powder.position[i].x + kHalf) / kSize, kUp / 2.0 - powder.position[i].y / kSize,
             powder.radius[i] / kSize, 40);
    return grey;
}

}  // namespace

TEST_CASE("averaged photographs of a bed have the slope that the drum's front view has of its spheres") {
    constexpr int kPhotographs = 24;
    MeanPicture mean;
    DrumFront front(kHalf, 1e-3, kPhotographs);
    AveragedView view(kHalf, kSize);
    for (int i = 0; i < kPhotographs; ++i) {
        const Particles powder = bedOf(std::uint64_t(i));
        front.add(powder);
        view.add(powder);
        mean.add(pictureOf(photographOf(powder)), std::to_string(i));
    }
    Reading reading;
    reading.lengthMm = 2e3 * kHalf;
    const auto seen = front.angle();
    const Surface surface = surfaceOf(mean.mean(), reading);
    const auto read = slopeOf(surface);
    REQUIRE(seen);
    REQUIRE(read);
    constexpr double kDegreeAngle = kPi / 180;
    // The photograph's median of 3 x 3 and its threshold, between the means of the two kinds, move the edge by a pixel.
    CHECK(near(*read / kDegreeAngle, seen->angle / kDegreeAngle, 1, 0.5));
    CHECK(near(*read / kDegreeAngle, 41, 1, 4));  // steep, so that it is a comparison
    const auto heights = view.surface();
    double off = 0;
    for (int c = 0; c < kAcross; ++c)
        off += surface.points.at(std::size_t(c)).heightMm.value() / (1e3 * kSize) - kUp / 2.0 -
               heights.at(std::size_t(c)).value() / kSize;
    CHECK(near(off / kAcross, 0, 1, 0.7));  // in pixels
}
