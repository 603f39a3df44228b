#pragma once

namespace vkdose {

/// Others within reach and skin of one sphere that a row of a backend's neighbour list holds.
inline constexpr int kMaxNeighbours = 64;

}  // namespace vkdose
