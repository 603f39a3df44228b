#pragma once
// The result of the benchmark as people and programs read it.

#include <string>
#include <vector>

#include "host/bench/measure.h"

namespace vkdose::bench {

/// Head and lines of the table on the terminal.
std::string headLine();
std::string tableLine(const Row& row);

/// Where the time of a step goes and what it moves, indented below a line; empty for the plain loop or without figures.
std::string detailLines(const Row& row);

/// Everything, in SI units; figures that were not measured are missing (JSON) or empty (CSV).
std::string jsonTable(const std::vector<Row>& rows);
std::string csvTable(const std::vector<Row>& rows);

}  // namespace vkdose::bench
