#pragma once

namespace vkdose {

/// What the program returns to the shell.
enum ExitCode {
    kOk = 0,
    kDisagree = 1,       ///< compare, verify: a quantity is outside its tolerance; sweep: a member failed
    kBadInput = 2,       ///< bad case or usage; nothing was written
    kRunError = 3,       ///< the run could not go on
    kDeviceError = 4,    ///< no usable device, or the device failed
    kOutputError = 5,    ///< a result could not be written
    kInterrupted = 130,  ///< Ctrl-C; what was computed is kept
};

}  // namespace vkdose
