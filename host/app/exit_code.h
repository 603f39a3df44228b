#pragma once

#include <exception>
#include <string>

#include "host/core/exit_code.h"

namespace vkdose {

/// An error as the caller of the program sees it.
struct Refusal {
    ExitCode code = kRunError;
    std::string text;  ///< one line, of a case as many as it has faults
};
Refusal refusalOf(const std::exception_ptr& error);

/// The last line of what the program said on stderr, without its name in front.
std::string lastSaid(std::string text);

}  // namespace vkdose
