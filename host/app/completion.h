#pragma once
// Completion of the command line by the shells, printed by `vkdose completion SHELL`.

#include <string>
#include <vector>

#include "host/app/command_table.h"

namespace vkdose {

std::string bashCompletion(const std::vector<CommandText>& commands);
std::string zshCompletion(const std::vector<CommandText>& commands);
std::string fishCompletion(const std::vector<CommandText>& commands);

}  // namespace vkdose
