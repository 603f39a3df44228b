#include "host/analysis/balance.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "host/core/csv_table.h"
#include "host/core/error.h"

namespace vkdose {

BalanceReadings readBalance(const std::filesystem::path& file) {
    const Table table = Table::read(file, LastLine::Whole);
    const bool sums = table.has("cumulative_g");
    if (!table.has("dose") || table.has("mass_g") == sums)
        throw CaseError({{file.string(), 1, "", "", "the header is not dose and either mass_g or cumulative_g",
                          "give a CSV with the columns dose and mass_g, or dose and cumulative_g"}});
    const char* column = sums ? "cumulative_g" : "mass_g";
    std::vector<double> read;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        if (table.number(i, "dose") != double(i + 1))
            table.refuse(i, "dose", fmt::format("dose {} should come here", i + 1), "give every dose once, in order");
        read.push_back(table.number(i, column) * 1e-3);
        if (!std::isfinite(read.back())) table.refuse(i, column, "is not a number", "give the balance's reading in g");
    }
    BalanceReadings balance;
    balance.mass = balance.cumulative = read;
    if (sums)
        std::adjacent_difference(read.begin(), read.end(), balance.mass.begin());
    else
        std::partial_sum(read.begin(), read.end(), balance.cumulative.begin());
    return balance;
}

}  // namespace vkdose
