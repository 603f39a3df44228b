#pragma once
// Random numbers that depend only on (seed, stream, index, attempt). They have no state, can be drawn in any order, and
// are the same on every platform.
// Philox4x32-10 of Random123: Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC11.

#include <Random123/philox.h>

#include <array>
#include <cstdint>

namespace vkdose {

/// The use of the numbers. Two uses with the same index get different numbers.
enum class Stream : std::uint32_t { Radius = 1, Jitter = 2, Shuffle = 3 };

/// Two independent numbers, uniform in the open interval (0, 1), 53 bits each.
inline std::array<double, 2> uniforms(std::uint64_t seed, Stream stream, std::uint64_t index,
                                      std::uint32_t attempt = 0) {
    const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x & 0xffffffffU); };
    const auto high = [](std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32U); };
    const r123::Philox4x32::ctr_type counter{{low(index), high(index), attempt, static_cast<std::uint32_t>(stream)}};
    const r123::Philox4x32::key_type key{{low(seed), high(seed)}};
    const r123::Philox4x32::ctr_type word = r123::Philox4x32()(counter, key);
    const auto unit = [](std::uint32_t a, std::uint32_t b) {
        const std::uint64_t bits = (static_cast<std::uint64_t>(a) << 32U) | b;
        return (static_cast<double>(bits >> 11U) + 0.5) * 0x1p-53;  // half a step off, so never 0; see below for 1
    };
    // The largest value is (2^53 - 1/2) 2^-53, which rounds to 1; one step less keeps the interval open.
    const auto open = [](double u) { return u < 1.0 ? u : 1.0 - 0x1p-53; };
    return {open(unit(word[0], word[1])), open(unit(word[2], word[3]))};
}

}  // namespace vkdose
