#pragma once
// Every key of a case file. The readers (read_powder.cpp, read_apparatus.cpp, read_field.cpp, case.cpp) take units,
// bounds, words and defaults from here.

#include "host/model/key.h"

namespace vkdose {

/// The tables of a case file in the order of the manual.
std::span<const KeyTable> caseKeys();

}  // namespace vkdose
