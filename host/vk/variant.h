#pragma once
// The ways in which one pass is compiled (shaders/passes.cmake).

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

namespace vkdose::vk {

struct Variant {
    unsigned macros;  ///< that were defined for it, a bit each
    std::span<const std::uint32_t> code;
};

/// Among the variants whose macros are all `wanted`, the one with the most macros. Each pass has a plain variant
/// without macros, so there always is one.
constexpr const Variant& best(std::span<const Variant> variants, unsigned wanted) {
    const auto rank = [wanted](const Variant& v) { return (v.macros & ~wanted) == 0 ? std::popcount(v.macros) : -1; };
    const auto lower = [&rank](const Variant& a, const Variant& b) { return rank(a) < rank(b); };
    return *std::max_element(variants.begin(), variants.end(), lower);
}

/// Its code.
constexpr std::span<const std::uint32_t> pick(std::span<const Variant> variants, unsigned wanted) {
    return best(variants, wanted).code;
}

}  // namespace vkdose::vk
