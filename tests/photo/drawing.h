#pragma once
// Photographs drawn by a test: a bed whose surface is known, under light, noise and dirt that a test asks for.

#include <cmath>
#include <functional>

#include "host/core/random.h"
#include "host/core/vec.h"
#include "host/photo/photograph.h"

namespace vkdose::test {

/// The view in front of the camera. Pixels whose centre lies below the surface are powder.
struct Drawing {
    int width = 300, height = 200;
    /// Height of the surface over the picture's lower edge [pixels], at x pixels from the left; NaN: no powder there.
    std::function<double(double)> surface = [](double) { return 80.0; };
    double powder = 60, background = 190;                               ///< grey in even light
    std::function<double(double, double)> light = [](double, double) {  ///< factor at x, y in 0 ... 1
        return 1.0;
    };
    double noise = 0;        ///< standard deviation [grey]
    std::uint64_t seed = 1;  ///< of the noise
    int edgeSamples = 4;     ///< per pixel and direction: how much of it is powder
};

inline double normalDeviate(std::uint64_t seed, std::uint64_t index) {
    const auto u = uniforms(seed, Stream::Jitter, index);
    return std::sqrt(-2 * std::log(u[0])) * std::cos(2 * kPi * u[1]);
}

inline photo::Grey draw(const Drawing& d) {
    photo::Grey grey(d.width, d.height);
    for (int y = 0; y < d.height; ++y) {
        for (int x = 0; x < d.width; ++x) {
            int inside = 0;
            for (int j = 0; j < d.edgeSamples; ++j)
                for (int i = 0; i < d.edgeSamples; ++i) {
                    const double px = x + (i + 0.5) / d.edgeSamples, py = y + (j + 0.5) / d.edgeSamples;
                    inside += d.height - py < d.surface(px) ? 1 : 0;  // false for NaN
                }
            const double share = double(inside) / (d.edgeSamples * d.edgeSamples);
            const double flat = share * d.powder + (1 - share) * d.background;
            const double lit = flat * d.light((x + 0.5) / d.width, (y + 0.5) / d.height);
            const auto index = std::uint64_t(y) * std::uint64_t(d.width) + std::uint64_t(x);
            const double value = lit + (d.noise > 0 ? d.noise * normalDeviate(d.seed, index) : 0);
            grey.at(x, y) = std::uint8_t(std::lround(std::min(std::max(value, 0.0), 255.0)));
        }
    }
    return grey;
}

/// A disc of one grey, centre and radius in pixels from the upper left corner.
inline void blot(photo::Grey& grey, double cx, double cy, double radius, std::uint8_t value) {
    for (int y = 0; y < grey.height; ++y)
        for (int x = 0; x < grey.width; ++x)
            if (std::hypot(x + 0.5 - cx, y + 0.5 - cy) < radius) grey.at(x, y) = value;
}

}  // namespace vkdose::test
