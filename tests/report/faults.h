#pragma once
// The message for bad input.

#include <functional>
#include <string>

#include "host/core/error.h"

namespace vkdose::test {

/// The first fault with which `what` refuses; "none" if it does not.
inline std::string faultOf(const std::function<void()>& what) {
    try {
        what();
    } catch (const CaseError& e) {
        return e.faults().front().text();
    }
    return "none";
}

}  // namespace vkdose::test
