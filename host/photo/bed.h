#pragma once
// Splits a photograph into two colours, and finds the pixels that are the bed of powder.

#include "host/photo/photograph.h"

namespace vkdose::photo {

/// One entry for each pixel, as in Grey: 1 or 0.
using Mask = Grey;

enum class Powder { Automatic, Dark, Light };

/// 1 where `grey` is below `threshold`.
Mask darkPixels(const Grey& grey, int threshold);

/// The one of the two kinds that lies lower on the average. Never Automatic.
Powder lowerKind(const Mask& dark);

/// Throws PhotoError if the two kinds in `dark` cannot be told apart in `grey`. This is so if one is missing, if their
/// mean greys are less than 10 of 255 apart, or if they are mixed like noise (more than a fifth of all neighbours
/// differ; in pure noise 30 % do).
void requireContrast(const Grey& grey, const Mask& dark);

/// The bed: the patches of powder that reach the picture's lower edge to within `speck` [pixels]. Diagonal neighbours
/// are joined. Holes of less than speck x speck pixels are filled, and patches of less are left out.
Mask bedOf(const Mask& powder, int speck);

/// 1 where `mask` is 0.
Mask inverse(const Mask& mask);

}  // namespace vkdose::photo
