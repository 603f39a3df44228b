#pragma once

#include <exception>
#include <string>

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

/// What an error means to whoever started the program.
struct Refusal {
    ExitCode code = kRunError;
    std::string text;  ///< one line, of a case as many as it has faults
};
Refusal refusalOf(const std::exception_ptr& error);

/// The last line of what the program said on stderr, without its name in front.
std::string lastSaid(std::string text);

}  // namespace vkdose
