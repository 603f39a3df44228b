#pragma once
// The machine that figures of speed belong to.

#include <string>

namespace vkdose::bench {

/// The first processor in the text of /proc/cpuinfo and the widest vectors that it computes with:
/// "Intel(R) Xeon(R) Processor, AVX-512". What the text does not tell is left out.
std::string processorIn(const std::string& cpuinfo);

/// The same of this machine; empty where the system does not tell.
std::string processorText();

}  // namespace vkdose::bench
