#pragma once
// A photograph in two colours: which of its pixels are the bed of powder.

#include "host/photo/photograph.h"

namespace vkdose::photo {

/// One entry for each pixel, as in Grey: 1 or 0.
using Mask = Grey;

enum class Powder { Automatic, Dark, Light };

/// 1 where `grey` is below `threshold`.
Mask darkPixels(const Grey& grey, int threshold);

/// Which of the two kinds lies lower on the average: never Automatic.
Powder lowerKind(const Mask& dark);

/// Throws PhotoError if the two kinds in `dark` cannot be told apart in `grey`: one is missing, their mean greys are
/// less than 10 of 255 apart, or they are mixed like noise (more than a fifth of all neighbours differ; of pure noise
/// 30 %).
void requireContrast(const Grey& grey, const Mask& dark);

/// The bed: patches of powder that reach the picture's lower edge to within `speck` [pixels], diagonal neighbours
/// joined, holes of less than speck x speck filled and patches of less left out.
Mask bedOf(const Mask& powder, int speck);

/// 1 where `mask` is 0.
Mask inverse(const Mask& mask);

}  // namespace vkdose::photo
