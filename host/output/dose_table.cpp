#include "host/output/dose_table.h"

namespace vkdose {

std::vector<Dose> dosesOf(const Table& table) {
    std::vector<Dose> doses(table.rows());
    for (std::size_t i = 0; i < table.rows(); ++i)
        readRow(
            kDoseColumns, doses[i], [&](const char* name) { return table.text(i, name); },
            [&](const char* name) { (void)table.number(i, name); });
    return doses;
}

}  // namespace vkdose
