#pragma once
// The executable specification: physics.md as a serial program in double precision. Read the two side by side. See
// backend.h for the time step.

#include <memory>

#include "host/backend/backend.h"

namespace vkdose {

std::unique_ptr<Backend> makeReferenceBackend();

}  // namespace vkdose
