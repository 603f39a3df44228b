#pragma once
// A study: a base case and what is varied of it. Every combination of the axes, times every seed, is a member.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/model/case_tree.h"
#include "host/study/calibration_aim.h"

namespace vkdose {

/// A key of the base case ("contact.friction") and its value, which knows where it was written.
struct Setting {
    std::string key;
    Node value;
};

/// Keys of the base case that move together.
struct Axis {
    std::vector<std::string> keys;
    std::vector<std::vector<Node>> points;  ///< a value for each key
    std::vector<FreeParameter> box = {};    ///< that the points fill; empty if they are given one by one
};

struct Study {
    std::filesystem::path file;
    std::string text;  ///< the file as read
    std::string name;
    std::string reason;
    std::filesystem::path base;          ///< case file
    std::vector<std::uint64_t> seeds;    ///< empty: the base case's own
    std::vector<Setting> set;            ///< of every member
    std::vector<std::string> overrides;  ///< those of them that stand on the command line: "key.path=value"
    std::vector<Axis> axes;
    std::optional<CalibrationAim> calibration;

    /// The keys that differ between members, in the order of the file: those of the axes, then the free parameters of
    /// a calibration, then "base" if its targets are figures of several cases.
    std::vector<std::string> keys() const;
    bool severalBases() const;
};

/// More members than this in one study are a slip.
inline constexpr std::size_t kMostMembers = 10000;

/// Throws CaseError with every fault found. The base case and the members are not checked yet: see membersOf.
/// `overrides` ("key.path=value") replace values of every member.
Study readStudy(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// Puts overrides into what holds for every member; the record of the study tells them. Throws CaseError for keys that
/// the study varies, or that are not the members'.
void applyOverrides(Study& study, const std::vector<std::string>& overrides);

}  // namespace vkdose
