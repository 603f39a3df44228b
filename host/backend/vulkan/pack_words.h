#pragma once
// Words of the table `geometry`, which holds floats as their bits.

#include <bit>
#include <cstddef>
#include <cstdint>

#include "geometry/shape_form.h"
#include "host/core/error.h"
#include "shaders/shared/geometry.h"

namespace vkdose {

inline std::uint32_t bits(float x) {
    return std::bit_cast<std::uint32_t>(x);
}

inline gpu::uvec4 bits(const gpu::vec4& v) {
    return {bits(v.x), bits(v.y), bits(v.z), bits(v.w)};
}

inline gpu::uvec4 bits(const glm::vec3& v, std::uint32_t last) {
    return {bits(v.x), bits(v.y), bits(v.z), last};
}

inline gpu::uvec4 bits(const glm::vec3& v, float last = 0.0f) {
    return bits(v, bits(last));
}

using geometry::Around;

/// A place in the table. Throws RunError if it has no room for it.
inline std::uint32_t tableIndex(std::size_t i) {
    if (i > 0xffffffffu) throw RunError("the bodies need more than 2^32 vectors of the device's memory");
    return std::uint32_t(i);
}

}  // namespace vkdose
