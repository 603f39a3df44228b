#pragma once
// A case as a file that people read and edit.

#include <string>

#include "host/model/case_tree.h"

namespace vkdose {

/// The tree as TOML: a line for each value, a header for each table.
std::string readableText(const Node& tree);

}  // namespace vkdose
