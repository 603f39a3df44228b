#pragma once
// The result of the benchmark in the forms that people and programs read.

#include <string>
#include <vector>

#include "host/bench/measure.h"

namespace vkdose::bench {

/// Head and lines of the table on the terminal.
std::string headLine();
std::string tableLine(const Row& row);

/// The time of each part of a step and the bytes it moves, indented below a line. Empty for the plain loop or without
/// figures.
std::string detailLines(const Row& row);

/// On what device, by what driver and processor a row was measured, in lines.
std::string machineLines(const Row& row);

/// How many times as long as in the workload `without` a step of a sphere takes in `name`, in a sentence. Empty unless
/// a backend has figures of both.
std::string ratioLine(const std::vector<Row>& rows, const std::string& name, const std::string& without);

/// Everything, in SI units; figures that were not measured are missing (JSON) or empty (CSV).
std::string jsonTable(const std::vector<Row>& rows);
std::string csvTable(const std::vector<Row>& rows);

}  // namespace vkdose::bench
