#pragma once
// The fields that a run kept (fields/ of its folder), as its page takes them: maps of a plane and height profiles.
//
// A map's stream, deflated and in base64, holds for each map and each quantity a byte for every cell, rows from above:
// the difference from the map before (the first one's from 0), modulo 256. The byte is a level of the quantity's scale,
// on which `most` is the largest value once dosing has begun, and what lies beyond takes the level of the end:
//
//   linear   255 v / most
//   root     255 sqrt(v / most), for what spans decades
//   signed   128 +- 127 sqrt(|v| / most)

#include <filesystem>

#include "host/model/case.h"
#include "host/report/run_report.h"

namespace vkdose::report {

/// Levels that all maps of a page may take together [bytes]; a page holds four characters for three of them.
inline constexpr std::size_t kMostFieldBytes = 3'000'000;

/// Below this level of density there are but the tails of kernels, and no velocity worth a scale.
inline constexpr int kSparseLevel = 5;

/// `fields` of runJson: {maps, profiles}; null if the run has kept none. Of more maps than there is room for only every
/// n-th and the last; a field of which not even two fit has no stream. Fields in one place, along one line and in three
/// directions are not among them. Throws CaseError if a file is damaged.
Json fieldsJson(const std::filesystem::path& folder, const Case& c, std::size_t mostBytes = kMostFieldBytes);

/// Characters that its streams take.
std::size_t streamCharacters(const Json& fields);

}  // namespace vkdose::report
