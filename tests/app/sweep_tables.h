#pragma once
// The tables of a sweep as tests compare them.

#include <algorithm>
#include <filesystem>

#include "host/core/csv_table.h"

namespace vkdose::test {

/// The rows of members.csv without the time on the clock.
inline std::vector<Row> timeless(const std::filesystem::path& folder) {
    const Table table = Table::salvage(folder / "members.csv");
    const auto wall = std::find(table.names().begin(), table.names().end(), "wall_time_s") - table.names().begin();
    std::vector<Row> rows;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        rows.push_back(table.row(i));
        rows.back().erase(rows.back().begin() + wall);
    }
    return rows;
}

}  // namespace vkdose::test
