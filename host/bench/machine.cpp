#include "host/bench/machine.h"

#include <array>
#include <sstream>
#include <utility>

#include "host/core/file.h"

namespace vkdose::bench {

namespace {

/// What stands behind the first of these names and its colon.
std::string valueOf(const std::string& cpuinfo, const std::string& name) {
    std::istringstream lines(cpuinfo);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t colon = line.find(':');
        if (colon == std::string::npos || line.compare(0, name.size(), name) != 0) continue;
        const std::size_t begin = line.find_first_not_of(" \t", colon + 1);
        return begin == std::string::npos ? "" : line.substr(begin);
    }
    return "";
}

/// Of x86 and of ARM, widest first.
constexpr std::array<std::pair<const char*, const char*>, 7> kVectors{{{"avx512f", "AVX-512"},
                                                                       {"avx2", "AVX2"},
                                                                       {"avx", "AVX"},
                                                                       {"sse4_2", "SSE4.2"},
                                                                       {"sve2", "SVE2"},
                                                                       {"sve", "SVE"},
                                                                       {"asimd", "NEON"}}};

}  // namespace

std::string processorIn(const std::string& cpuinfo) {
    std::string model = valueOf(cpuinfo, "model name");
    const std::string flags = " " + valueOf(cpuinfo, "flags") + " " + valueOf(cpuinfo, "Features") + " ";
    for (const auto& [flag, name] : kVectors)
        if (flags.find(std::string(" ") + flag + " ") != std::string::npos)
            return model.empty() ? name : model + ", " + name;
    return model;
}

std::string processorText() {
    return processorIn(fileContent("/proc/cpuinfo").value_or(""));
}

}  // namespace vkdose::bench
