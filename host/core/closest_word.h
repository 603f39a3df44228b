#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vkdose {

/// The word of `known` that `word` was probably meant to be; empty when none is close.
std::string closestWord(std::string_view word, const std::vector<std::string>& known);

}  // namespace vkdose
