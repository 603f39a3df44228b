#include "host/output/dose_table.h"

#include <string_view>

namespace vkdose {

std::vector<Dose> dosesOf(const Table& table) {
    std::vector<Dose> doses(table.rows());
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const auto text = [&](const char* name) { return table.text(i, name); };
        const auto wrong = [&](const char* name) {
            if (std::string_view(name) == "stopped_by")
                table.refuse(i, name, "is not one of its values", "run the case again; the table has been changed");
            (void)table.number(i, name);  // an empty cell is none
        };
        readRow(kDoseColumns, doses[i], text, wrong);
    }
    return doses;
}

}  // namespace vkdose
