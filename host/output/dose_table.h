#pragma once

#include <vector>

#include "host/core/csv_table.h"
#include "host/sim/dose.h"

namespace vkdose {

/// The doses in a table with the columns of doses.csv. An older table does not tell what stopped the coil. Throws
/// CaseError, which names the place, if a column is missing or a field is not a number.
std::vector<Dose> dosesOf(const Table& table);

}  // namespace vkdose
