#pragma once
// The warnings of a case that a test writes.

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "host/advice/advice.h"
#include "tests/model/case_files.h"

namespace vkdose::test {

/// A case that no warning is for.
inline std::filesystem::path plainCase() {
    return std::filesystem::path(VKDOSE_SOURCE_DIR) / "tests/advice/plain.toml";
}

inline std::vector<std::string> namesOf(const std::vector<Warning>& warnings) {
    std::vector<std::string> names;
    for (const Warning& w : warnings) names.push_back(w.name);
    return names;
}

/// Of a case with this text, in a folder that holds the files it names.
inline std::vector<Warning> warningsOfText(const Folder& folder, const std::string& text) {
    const Case c = loadCase(folder.write("case.toml", text));
    return warningsOf(c, insertParticles(c));
}

/// The warning of this name, or null.
inline const Warning* warningOf(const std::vector<Warning>& all, const std::string& name) {
    const auto it = std::find_if(all.begin(), all.end(), [&](const Warning& w) { return w.name == name; });
    return it == all.end() ? nullptr : &*it;
}

/// The line of that warning of the text's case; empty without it.
inline std::string lineOf(const Folder& folder, const std::string& text, const std::string& name) {
    const std::vector<Warning> found = warningsOfText(folder, text);
    const Warning* warning = warningOf(found, name);
    return warning == nullptr ? std::string() : warning->line();
}

}  // namespace vkdose::test
