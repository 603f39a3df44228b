#pragma once
// Every key of a study file. Its readers (study.cpp, calibration_aim.cpp) take units, bounds, words and defaults from
// here.

#include "host/core/key.h"

namespace vkdose {

/// The tables of a study file in the order of the manual.
std::span<const KeyTable> studyKeys();

}  // namespace vkdose
