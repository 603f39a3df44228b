#pragma once
// Colours of a picture: the map from 0 ... 1, and light.

#include "host/core/vec.h"

namespace vkdose::render {

/// Red, green and blue in 0 ... 1, as a screen takes them (sRGB). The map goes from dark blue over purple and red to a
/// light yellow in equal steps of lightness, so that it reads in print and for colour-blind readers. `t` outside 0 ...
/// 1 takes the colour of the end. A `t` that is not a number is grey.
Vec3 mapColour(double t);

/// sRGB (IEC 61966-2-1) to linear light, component by component.
Vec3 linearLight(const Vec3& srgb);

/// Lightness L of a colour in sRGB after Ottosson (2020), "A perceptual color space for image processing", 0 ... 1.
double lightness(const Vec3& srgb);

}  // namespace vkdose::render
