#pragma once
// The executable specification: physics.md in double precision, serial, to be read beside it. See backend.h for the
// time step.

#include <memory>

#include "host/backend/backend.h"

namespace vkdose {

std::unique_ptr<Backend> makeReferenceBackend();

}  // namespace vkdose
