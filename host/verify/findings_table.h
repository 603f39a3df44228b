#pragma once
// The findings as people and programs read them.

#include <string>
#include <vector>

#include "host/verify/finding.h"

namespace vkdose::verify {

/// One line for the terminal; the reason of the tolerance ends it.
std::string headLine();
std::string tableLine(const Check& check);

/// Where and on what the suite ran.
struct Setting {
    std::string backend;  ///< Backend::description()
    double seconds;       ///< wall time
};

std::string markdownTable(const std::vector<Check>& checks, const Setting& setting);
std::string jsonTable(const std::vector<Check>& checks, const Setting& setting);

std::size_t failures(const std::vector<Check>& checks);

/// "117 of 117 known answers met, 3 of 3 other figures plausible"
std::string tally(const std::vector<Check>& checks);

}  // namespace vkdose::verify
