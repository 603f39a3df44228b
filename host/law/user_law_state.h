#pragma once
// Whose law made the state of a backend.

#include <memory>

#include "host/core/record.h"
#include "host/law/user_law.h"

namespace vkdose {

/// Notes in a state under which user's law it came about, if it did under one.
void putLaw(const std::shared_ptr<const UserLaw>& law, Record& record);
/// Throws RecordError if the state came about under another law: its memory means something else.
void requireLaw(const std::shared_ptr<const UserLaw>& law, const Record& record);

}  // namespace vkdose
