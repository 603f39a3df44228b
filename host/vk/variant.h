#pragma once
// The ways in which one pass is compiled (shaders/passes.cmake).

#include <bit>
#include <cstdint>
#include <span>

namespace vkdose::vk {

struct Variant {
    unsigned macros;  ///< that were defined for it, a bit each
    std::span<const std::uint32_t> code;
};

/// Among the variants whose macros are all `wanted`, the code of the one with the most macros. Each pass has a plain
/// variant without macros, so there always is one.
constexpr std::span<const std::uint32_t> pick(std::span<const Variant> variants, unsigned wanted) {
    const Variant* best = nullptr;
    for (const Variant& v : variants)
        if ((v.macros & ~wanted) == 0 && (best == nullptr || std::popcount(v.macros) > std::popcount(best->macros)))
            best = &v;
    return best->code;
}

}  // namespace vkdose::vk
