#pragma once
// The members of a study: each a case, validated before anything runs.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/study/study.h"

namespace vkdose {

struct Member {
    int number = 0;  ///< from 0
    std::uint64_t seed = 1;
    std::vector<std::string> values;  ///< of Study::keys, as they stand in tables
    std::string caseText;             ///< the resolved case
    std::size_t particles = 0;
    double expectedTime = 0;  ///< simulated time that it will take by the closed forms [s]
    double expectedWork = 0;  ///< particle-steps that it will take by the closed forms
    double settlingWork = 0;  ///< those of its longest settling
    std::string bed;          ///< bedText
};

/// Every combination of the axes for the first seed, the last axis fastest, then for the next seed. In this order seeds
/// that are appended later leave the numbers as they are. Throws CaseError with every fault of every member, each
/// reported once.
std::vector<Member> membersOf(const Study& study);

/// A member at a point of its own: a value for each of the keys, in their order. It varies `base`, or the study's base
/// if that is empty. Throws CaseError.
Member memberAt(const Study& study, int number, std::optional<std::uint64_t> seed, const std::vector<Setting>& point,
                const std::filesystem::path& base = {});

/// The study at a point as the text of a case, ready to run, with the study's first seed. It has the keys of the base
/// case and of the study, and no defaults: who reads it finds the keys that were varied, and not what follows from
/// them. Throws CaseError.
std::string caseAt(const Study& study, const std::vector<Setting>& point, const std::string& name,
                   const std::string& reason);

/// A key set to a number that no file holds; six digits.
Setting settingOf(const Study& study, const std::string& key, double value);

/// A value as it stands in a table: a string without its quotes.
std::string tableText(const Node& value);

}  // namespace vkdose
