#pragma once
// Lengths as people read them.

namespace vkdose {

/// A length in millimetres.
constexpr double mm(double metres) {
    return metres * 1e3;
}

}  // namespace vkdose
