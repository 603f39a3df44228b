#include "host/core/grams.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vkdose {

std::string grams(double kilograms) {
    const double g = kilograms * 1e3;
    if (!(std::abs(g) < 0.1) || g == 0) return fmt::format("{:.3f}", g);
    return fmt::format("{:.{}f}", g, std::min(9, 2 - static_cast<int>(std::floor(std::log10(std::abs(g))))));
}

std::string signedGrams(double kilograms) {
    return (kilograms < 0 ? "" : "+") + grams(kilograms);
}

}  // namespace vkdose
