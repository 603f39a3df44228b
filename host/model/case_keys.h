#pragma once
// Every key of a case file. The readers (case_sections.h) take units, bounds, words and defaults from here. The keys of
// the top of the file stand in case_keys.cpp.

#include <cstdint>

#include "host/core/key.h"

namespace vkdose {

/// The largest number of a dose.
inline constexpr std::int64_t kMostDoses = 1'000'000'000;
inline constexpr std::int64_t kMostPockets = 1000;  // of a wheel

/// The tables of a case file in the order of the manual.
std::span<const KeyTable> caseKeys();

// Their parts, in this order, each in a file of its name (powder_keys.cpp).
std::span<const KeyTable> powderKeys();
std::span<const KeyTable> contactKeys();
std::span<const KeyTable> apparatusKeys();
std::span<const KeyTable> runKeys();
std::span<const KeyTable> evaluationKeys();

}  // namespace vkdose
