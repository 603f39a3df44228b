#pragma once
// Figures as people read them.

#include <cstddef>
#include <string>

#include "host/core/grams.h"

namespace vkdose {

/// "42 s", "3 min 05 s", "2 h 10 min", "4 d 3 h"; "?" for what is not a duration.
std::string duration(double seconds);

/// "8.31 M ", "950 k ", "1.2 G ", "12 ": to stand in front of a unit.
std::string large(double x);

/// "1 dose", "2 doses": `thing` with an s where it is not one.
std::string counted(std::size_t count, const char* thing);

}  // namespace vkdose
