#pragma once
// Places where powder is dosed or counted.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "host/core/vec.h"

namespace vkdose {

struct CountRegion {
    enum class Kind { Beyond, Box };
    std::string name;
    Kind kind = Kind::Beyond;
    Vec3 point{0}, normal{0, 0, 1};  ///< Beyond: the half space on the side of `normal` (unit) of the plane through it
    Vec3 low{0}, high{0};            ///< Box
    bool deletes = true;             ///< a particle whose centre is in it is dosed; false: it is only counted
    /// Index of the one of World::bodies that carries it: the region is given where the body starts, and moves and
    /// turns with it. Without a body it rests. One that deletes rests.
    std::optional<std::size_t> body = std::nullopt;

    /// How far inside a point is: the distance to the nearest face, negative outside [m].
    double depth(const Vec3& x) const;
    bool holds(const Vec3& x) const { return depth(x) > 0; }
};

/// Most regions of a case, and most of them that delete: a device has places for so many.
inline constexpr std::size_t kMaxRegions = 16;
inline constexpr std::size_t kMaxOutlets = 4;

}  // namespace vkdose
