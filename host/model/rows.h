#pragma once

namespace vkdose {

/// Most entries of a row: other particles within reach and skin of one sphere.
inline constexpr int kMaxNeighbours = 64;

}  // namespace vkdose
