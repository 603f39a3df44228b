#pragma once
// The tables of a sweep as tests compare them.

#include <filesystem>

#include "host/study/csv_table.h"

namespace vkdose::test {

/// The rows of members.csv without the time on the clock.
inline std::vector<Row> timeless(const std::filesystem::path& folder) {
    CsvTable table = readTable(folder / "members.csv");
    const std::size_t wall = table.column("wall_time_s").value();
    for (Row& row : table.rows) row.erase(row.begin() + std::ptrdiff_t(wall));
    return table.rows;
}

}  // namespace vkdose::test
