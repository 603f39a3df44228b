#pragma once
// The numbers that a user's law gives each particle (UserLaw::properties), in the state of the backend.

#include "host/core/record.h"
#include "host/model/particles.h"

namespace vkdose::reference {

/// Nothing where particles have none.
void saveProperties(const Particles& particles, Record& record);
/// Throws RecordError if the record does not fit the particles.
void restoreProperties(const Record& record, Particles& particles);

}  // namespace vkdose::reference
