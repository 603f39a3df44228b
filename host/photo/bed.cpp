#include "host/photo/bed.h"

#include <fmt/format.h>
#include <leptonica/allheaders.h>

#include <algorithm>
#include <cmath>

namespace vkdose::photo {

namespace {

constexpr double kLeastContrast = 10;
constexpr double kMostDisorder = 0.2;

Picture bitsOf(const Mask& mask) {
    Picture bits = held(pixCreate(mask.width, mask.height, 1));
    for (int y = 0; y < mask.height; ++y) {
        l_uint32* line = pixGetData(bits.pix()) + std::ptrdiff_t(y) * pixGetWpl(bits.pix());
        for (int x = 0; x < mask.width; ++x)
            if (mask.at(x, y) != 0) SET_DATA_BIT(line, x);
    }
    return bits;
}

Mask maskOf(const Picture& bits) {
    Mask mask(bits.width(), bits.height());
    for (int y = 0; y < mask.height; ++y) {
        const l_uint32* line = pixGetData(bits.pix()) + std::ptrdiff_t(y) * pixGetWpl(bits.pix());
        for (int x = 0; x < mask.width; ++x) mask.at(x, y) = std::uint8_t(GET_DATA_BIT(line, x));
    }
    return mask;
}

/// The mask without the patches of fewer pixels.
Mask withoutPatches(const Mask& mask, double pixels, int connectivity) {
    const Picture bits = bitsOf(mask);
    Pix* kept = pixSelectByArea(bits.pix(), float(pixels), connectivity, L_SELECT_IF_GTE, nullptr);
    return maskOf(held(kept));
}

/// The pixels that are connected with the lowest `rows`.
Mask reachingDown(const Mask& mask, int rows) {
    Mask lowest = mask;
    std::fill_n(lowest.value.begin(), std::ptrdiff_t(mask.width) * std::max(0, mask.height - rows), std::uint8_t(0));
    const Picture seed = bitsOf(lowest), all = bitsOf(mask);
    return maskOf(held(pixSeedfillBinary(nullptr, seed.pix(), all.pix(), 8)));
}

/// Share of the pairs of neighbours, side by side or one above the other, whose pixels are of different kinds.
double disorder(const Mask& mask) {
    double pairs = 0, different = 0;
    for (int y = 0; y < mask.height; ++y) {
        for (int x = 0; x < mask.width; ++x) {
            if (x + 1 < mask.width) {
                pairs += 1;
                different += mask.at(x, y) != mask.at(x + 1, y) ? 1 : 0;
            }
            if (y + 1 < mask.height) {
                pairs += 1;
                different += mask.at(x, y) != mask.at(x, y + 1) ? 1 : 0;
            }
        }
    }
    return different / pairs;
}

}  // namespace

Mask darkPixels(const Grey& grey, int threshold) {
    Mask mask(grey.width, grey.height);
    std::transform(grey.value.begin(), grey.value.end(), mask.value.begin(),
                   [threshold](std::uint8_t v) { return std::uint8_t(v < threshold ? 1 : 0); });
    return mask;
}

Mask inverse(const Mask& mask) {
    Mask out(mask.width, mask.height);
    std::transform(mask.value.begin(), mask.value.end(), out.value.begin(),
                   [](std::uint8_t v) { return std::uint8_t(1 - v); });
    return out;
}

Powder lowerKind(const Mask& dark) {
    double count[2] = {0, 0}, rows[2] = {0, 0};
    for (int y = 0; y < dark.height; ++y) {
        for (int x = 0; x < dark.width; ++x) {
            count[dark.at(x, y)] += 1;
            rows[dark.at(x, y)] += y;
        }
    }
    // The means are compared without dividing, because a kind may be missing.
    return rows[1] * count[0] >= rows[0] * count[1] ? Powder::Dark : Powder::Light;
}

void requireContrast(const Grey& grey, const Mask& dark) {
    double count[2] = {0, 0}, sum[2] = {0, 0};
    for (std::size_t i = 0; i < grey.value.size(); ++i) {
        count[dark.value[i]] += 1;
        sum[dark.value[i]] += grey.value[i];
    }
    const double apart = count[0] > 0 && count[1] > 0 ? std::abs(sum[0] / count[0] - sum[1] / count[1]) : 0;
    const char* const remedy =
        "set --roi to the canister's inside, light it better, or give the --threshold between powder and background";
    if (!(apart >= kLeastContrast))
        throw PhotoError(
            fmt::format("there is no contrast in the region: its two kinds of grey are {:.1f} of 255 "
                        "apart, 10 are needed; {}",
                        apart, remedy));
    const double mixed = disorder(dark);
    if (mixed > kMostDisorder)
        throw PhotoError(
            fmt::format("dark and light are mixed in the region like noise ({:.0f} % of all neighbours "
                        "differ); {}",
                        mixed * 100, remedy));
}

Mask bedOf(const Mask& powder, int speck) {
    const double area = double(speck) * double(speck);
    const Mask filled = inverse(withoutPatches(inverse(powder), area, 4));
    return reachingDown(withoutPatches(filled, area, 8), std::max(speck, 1));
}

}  // namespace vkdose::photo
