#pragma once
// `vkdose powders FILE --confirm N`: element tests of a powder with draws of its parameters.

#include "host/app/commands.h"

namespace vkdose {

/// Runs the tests of the figures that the powder's laboratory measured, prints both beside each other, and writes them
/// into the powder's file. Gives the exit code: kDisagree if a figure is not met. Throws CaseError.
int confirmCommand(const PowdersOptions& options);

}  // namespace vkdose
