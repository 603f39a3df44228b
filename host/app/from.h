#pragma once
// A run that begins with the powder of another one.

#include "host/app/play.h"

namespace vkdose {

/// A run from the state of another one, with the case of `input`, or with that of the other run if `input` names none.
/// Throws UsageError if there is no such state, CheckpointError if it cannot be read, and CaseError for every key in
/// which the case does not fit the powder.
ReadyRun readyFrom(const CaseOptions& input, const StartOptions& start);

}  // namespace vkdose
