#pragma once
// Contrast of a photograph: the light that falls unevenly is taken off, and what is left fills the range of greys.

#include "host/photo/photograph.h"

namespace vkdose::photo {

/// The threshold between two kinds of pixels that makes the variance between them largest: dark is below. N. Otsu, "A
/// threshold selection method from gray-level histograms", IEEE Trans. Syst. Man Cybern. 9 (1979) 62-66. Between two
/// separate humps, in the middle. 0 if all pixels are equal.
int otsu(const Grey& grey);

/// The picture as even light would show it. Light is taken to be the exponential of a quadratic polynomial of the
/// place, what it falls on to be of two kinds, told apart by `otsu`; both are found in turn by least squares. Then the
/// values are stretched so that a two-hundredth is black and as much white.
Grey evenLight(const Grey& grey);

}  // namespace vkdose::photo
