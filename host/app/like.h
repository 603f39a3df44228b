#pragma once
// `vkdose powders --like`: a powder by its laboratory figures.

#include "host/app/commands.h"

namespace vkdose {

/// The folder of the element tables. Throws UsageError if they did not come with the program.
std::filesystem::path tablesFolder();

/// Prints the powder, and writes it if it is to be written. Gives the exit code. Throws UsageError.
int likeCommand(const PowdersOptions& options);

}  // namespace vkdose
