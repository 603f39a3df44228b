#pragma once

#include <vector>

#include "host/core/csv_table.h"
#include "host/sim/dose.h"

namespace vkdose {

/// The doses in a table with the columns of doses.csv. A column that an earlier vkdose did not write reads as NaN, 0 or
/// false. Throws CaseError, which names the place, if a field is not a number.
std::vector<Dose> dosesOf(const Table& table);

}  // namespace vkdose
