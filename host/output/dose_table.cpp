#include "host/output/dose_table.h"

namespace vkdose {

std::vector<Dose> dosesOf(const Table& table) {
    std::vector<Dose> doses(table.rows());
    for (std::size_t i = 0; i < table.rows(); ++i)
        readRow(
            kDoseColumns, doses[i],
            [&](const char* name) { return table.has(name) ? table.text(i, name) : std::string(); },
            [&](const char* name) { (void)(table.has(name) ? table.number(i, name) : 0); });
    return doses;
}

}  // namespace vkdose
