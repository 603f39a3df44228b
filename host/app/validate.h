#pragma once
// `vkdose test validate`: the comparisons with the literature (host/validate), run and judged.

#include <string>
#include <vector>

#include "host/app/commands.h"

namespace vkdose {

struct ValidateOptions {
    std::vector<std::string> names;  ///< of comparisons; empty: all
    bool full = false;               ///< the studies at full size
    bool list = false;               ///< only tell which there are
    bool judge = false;              ///< begin no run: judge those that have ended
    SweepOptions sweep;              ///< of each study: `study` is the comparison's own
};

/// Those that `vkdose test validate` can be told.
std::vector<std::string> comparisonNames();

int validateCommand(const ValidateOptions& options);

}  // namespace vkdose
