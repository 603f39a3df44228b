#pragma once
// TOML text as a case tree.

#include <optional>
#include <string>

#include "host/model/case_tree.h"

namespace vkdose {

/// The tree of a text; `name` stands for the file in messages. Throws CaseError when the text is not TOML.
Node parseToml(const std::string& text, const std::string& name);

/// The same, but nothing when the text breaks the grammar. Throws CaseError when it is too large to be a case.
std::optional<Node> tomlTree(const std::string& text, const std::string& name);

}  // namespace vkdose
