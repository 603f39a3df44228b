#include "host/render/colour.h"

#include <algorithm>
#include <cmath>

namespace vkdose::render {

namespace {

/// Ends of the map: lightness and hue [degrees] go straight from one to the other.
constexpr double kLightness[2] = {0.44, 0.86};
constexpr double kHue[2] = {268, 444};
/// Chroma, and how much more of it amid the map: about as much as sRGB holds.
constexpr double kChroma = 0.12, kMoreChroma = 0.04;

double encoded(double x) {
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}
double decoded(double x) {
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

/// Ottosson's colour space, from its lightness and the two opponent axes to linear sRGB; his matrices.
Vec3 fromPerceived(double lightness, double a, double b) {
    const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
    const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
    const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
    return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
            -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
            -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

}  // namespace

Vec3 mapColour(double t) {
    if (std::isnan(t)) return Vec3(0.6);
    t = std::clamp(t, 0.0, 1.0);
    const double hue = (kHue[0] + (kHue[1] - kHue[0]) * t) * kPi / 180;
    const double chroma = kChroma + kMoreChroma * std::sin(kPi * t);
    const Vec3 light = fromPerceived(kLightness[0] + (kLightness[1] - kLightness[0]) * t, chroma * std::cos(hue),
                                     chroma * std::sin(hue));
    Vec3 colour;
    for (int i = 0; i < 3; ++i) colour[i] = encoded(std::clamp(light[i], 0.0, 1.0));
    return colour;
}

Vec3 linearLight(const Vec3& srgb) {
    return {decoded(srgb.x), decoded(srgb.y), decoded(srgb.z)};
}

double lightness(const Vec3& srgb) {
    const Vec3 c = linearLight(srgb);
    return 0.2104542553 * std::cbrt(0.4122214708 * c.x + 0.5363325363 * c.y + 0.0514459929 * c.z) +
           0.7936177850 * std::cbrt(0.2119034982 * c.x + 0.6806995451 * c.y + 0.1073969566 * c.z) -
           0.0040720468 * std::cbrt(0.0883024619 * c.x + 0.2817188376 * c.y + 0.6299787005 * c.z);
}

}  // namespace vkdose::render
