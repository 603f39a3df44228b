#pragma once
// Values of a tree of TOML by their dotted keys.

#include <map>
#include <string>

#include "host/model/case_tree.h"
#include "host/report/expected.h"

namespace vkdose::report {

/// Every number, text and truth value below `table`, by its dotted key; a key that holds dots itself is the same as a
/// table ("contact.friction" = 0.5). What lies in arrays is left out.
std::map<std::string, Setting> settingsOf(const Node& table);

/// A word or a number as it stands in a CSV.
Setting settingOf(const std::string& text);

/// The text of a key of `table`; `otherwise` if it has none.
std::string textIn(const Node& table, std::string_view key, const std::string& otherwise);

}  // namespace vkdose::report
