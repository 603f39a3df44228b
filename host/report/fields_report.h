#pragma once
// The fields that a run kept (fields/ of its folder), as its page takes them: maps of a plane and height profiles.
//
// A map's stream is deflated and in base64. It holds for each map and each quantity a byte for every cell, rows from
// above. The byte is the difference from the map before (the first map's from 0), modulo 256, of the level on the
// quantity's scale. On this scale `most` is the largest value once dosing has begun. Values beyond the scale take the
// level of its end:
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

/// Below this level of density a cell holds only the tails of kernels, so its values do not set the scales.
inline constexpr int kSparseLevel = 5;

/// `fields` of runJson: {maps, profiles}; null if the run has kept none. If there is no room for all maps, only every
/// n-th and the last are taken. A field of which not even two maps fit has no stream. Fields in one place, along one
/// line and in three directions are not included. Throws CaseError if a file is damaged.
Json fieldsJson(const std::filesystem::path& folder, const Case& c, std::size_t mostBytes = kMostFieldBytes);

/// Characters that its streams take.
std::size_t streamCharacters(const Json& fields);

}  // namespace vkdose::report
