#pragma once
// The phases of a run's schedule.

#include <array>
#include <cstddef>
#include <string_view>

#include "host/core/columns.h"

namespace vkdose {

enum class Phase { Settle, Rotate, Rest, Reverse };
template <>
struct Words<Phase> {
    static constexpr std::array<const char*, 4> kNames{"settle", "rotate", "rest", "reverse"};
};
inline std::string_view phaseName(Phase phase) {
    return Words<Phase>::kNames.at(std::size_t(phase));
}

}  // namespace vkdose
