#pragma once
// Completion of the command line by the shells, printed by `vkdose manual completion SHELL`.

#include <string>
#include <vector>

#include "host/app/command_table.h"

namespace vkdose {

std::string bashCompletion(const std::vector<CommandText>& tree);
std::string zshCompletion(const std::vector<CommandText>& tree);
std::string fishCompletion(const std::vector<CommandText>& tree);

}  // namespace vkdose
