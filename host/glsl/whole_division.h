#pragma once
// Divisions of whole numbers in a compiled shader. By zero, and of the least number by -1, Vulkan leaves them open, and
// a software device may end the process with a signal.

#include <cstdint>
#include <vector>

namespace vkdose {

/// Changes every / and % of int, uint and their vectors: where the divisor is 0, or the division is that of the least
/// int by -1, the divisor becomes 1. So x / 0 is x, x % 0 is 0, and the least int by -1 is itself, as two's complement
/// has it. All other divisions keep their bits. Constants are left alone: the compiler has folded them.
void guardWholeDivisions(std::vector<std::uint32_t>& spirv);

}  // namespace vkdose
