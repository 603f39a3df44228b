#pragma once
// Reads the CSV tables of numbers in tests/oracle.

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/places.h"

namespace vkdose::test {

using TableRow = std::map<std::string, double>;

/// Rows of tests/oracle/<name> by column name. Throws if the file is missing, empty or a cell is not a number.
inline std::vector<TableRow> oracleTable(const std::string& name) {
    std::ifstream file(sourceDir() + "/tests/oracle/" + name);
    if (!file) throw std::runtime_error("cannot open tests/oracle/" + name);
    const auto cells = [](std::string line) {
        if (!line.empty() && line.back() == '\r') line.pop_back();
        std::vector<std::string> list;
        std::istringstream in(line);
        for (std::string cell; std::getline(in, cell, ',');) list.push_back(cell);
        return list;
    };
    std::string line;
    std::getline(file, line);
    const std::vector<std::string> header = cells(line);
    std::vector<TableRow> rows;
    while (std::getline(file, line)) {
        const std::vector<std::string> values = cells(line);
        if (values.size() != header.size()) throw std::runtime_error(name + ": a row of the wrong length: " + line);
        TableRow row;
        for (std::size_t c = 0; c < header.size(); ++c) {
            char* end = nullptr;
            row[header[c]] = std::strtod(values[c].c_str(), &end);
            if (end == values[c].c_str()) throw std::runtime_error(name + ": not a number: " + values[c]);
        }
        rows.push_back(row);
    }
    if (rows.empty()) throw std::runtime_error(name + " has no rows");
    return rows;
}

}  // namespace vkdose::test
