#include "host/output/dose_table.h"

namespace vkdose {

std::vector<Dose> dosesOf(const Table& table) {
    std::vector<Dose> doses(table.rows());
    const bool older = !table.has("stopped_by");
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const auto text = [&](const char* name) { return table.text(i, name); };
        const auto wrong = [&](const char* name) {
            if (table.text(i, name) != "nan")
                table.refuse(i, name, "is not one of its values", "run the case again; the table has been changed");
        };
        readRow(kPlainDoseColumns, doses[i], text, [&](const char* name) { (void)table.number(i, name); });
        if (!older) readRow(kStopColumns, doses[i], text, wrong);
    }
    return doses;
}

}  // namespace vkdose
