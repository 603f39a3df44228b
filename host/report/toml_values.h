#pragma once
// Values of TOML files by their dotted keys.

#include <toml++/toml.h>

#include <filesystem>
#include <map>
#include <string>

#include "host/report/expected.h"

namespace vkdose::report {

/// Throws CaseError if the file cannot be read or is not TOML.
toml::table parseToml(const std::filesystem::path& file);

/// Every number, text and truth value below `table`, by its dotted key; a key that holds dots itself is the same as a
/// table
/// ("contact.friction" = 0.5). What lies in arrays is left out.
std::map<std::string, Setting> settingsOf(const toml::table& table);

/// A word or a number as it stands in a CSV.
Setting settingOf(const std::string& text);

}  // namespace vkdose::report
