#pragma once
// Contrast of a photograph: removes the uneven light and stretches the rest over the range of greys.

#include "host/photo/photograph.h"

namespace vkdose::photo {

/// The threshold between two kinds of pixels that makes the variance between them largest. Pixels below it are dark. N.
/// Otsu, "A threshold selection method from gray-level histograms", IEEE Trans. Syst. Man Cybern. 9 (1979) 62-66.
/// Between two separate humps it lies in the middle. 0 if all pixels are equal.
int otsu(const Grey& grey);

/// The picture as even light would show it. The light is assumed to be the exponential of a quadratic polynomial of the
/// place. The things that it falls on are assumed to be of two kinds, told apart by `otsu`. Both are found in turn by
/// least squares. Then the values are stretched so that a two-hundredth is black and as much is white.
Grey evenLight(const Grey& grey);

}  // namespace vkdose::photo
