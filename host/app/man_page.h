#pragma once
// Pages of the manual for man(1), from the commands and options of the program.

#include <string>
#include <vector>

#include "host/app/command_table.h"

namespace vkdose {

/// vkdose(1): every command in a line.
std::string manPage(const std::vector<CommandText>& commands);

/// "vkdose-test-verify": the name of a command's page.
std::string manName(const CommandText& command);

/// vkdose-COMMAND(1): its options and examples.
std::string manPage(const CommandText& command);

}  // namespace vkdose
