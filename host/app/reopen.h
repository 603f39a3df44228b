#pragma once
// A run that a stop rule ended goes on when the rule is replaced.

#include <filesystem>

#include "host/model/case.h"
#include "host/output/checkpoint.h"

namespace vkdose {

/// The end of the run in `folder`, from which it can go on with other keys of [stop]. Throws CheckpointError if
/// something else than these keys ended it, or if it kept no state of its end.
Checkpoint endToReopen(const std::filesystem::path& folder);

/// Throws CaseError if the stop rule of `c` would end the run again where `end` is.
void requireOpen(const Case& c, const Checkpoint& end);

}  // namespace vkdose
