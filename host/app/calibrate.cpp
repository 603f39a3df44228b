#include "host/app/commands.h"
#include "host/app/exit_code.h"

namespace vkdose {

int calibrateCommand(const SweepOptions&) {
    return kBadInput;
}

}  // namespace vkdose
