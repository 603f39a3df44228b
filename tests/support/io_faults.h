#pragma once
// Runs the program on a spoilt disk: the preloaded library of io_faults.cpp.

#include <string>

namespace vkdose::test {

/// Shell in front of the program (Sandbox::vkdose): the calls on files whose path ends with `file` have the faults
/// `faults`. Each call that is spoilt leaves a line in the file `told`.
inline std::string onBadDisk(const std::string& file, const std::string& faults, const std::string& told = "told") {
    // The sanitizers want to be the first library; this one only hands on what it does not spoil.
    return "env LD_PRELOAD=" VKDOSE_IO_FAULTS " ASAN_OPTIONS=verify_asan_link_order=0 VKDOSE_IO_FILE='" + file +
           "' VKDOSE_IO_FAULT=" + faults + " VKDOSE_IO_TOLD=" + told + " ";
}

}  // namespace vkdose::test
