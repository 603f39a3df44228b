#pragma once
// Every table that vkdose writes into its output folders, for the manual.

#include <vector>

#include "host/output/run_tables.h"

namespace vkdose {

/// The tables of a run, then those of a sweep.
std::vector<OutputTable> outputTables();

}  // namespace vkdose
