#include "host/validate/runs.h"

#include <fmt/format.h>

#include <charconv>
#include <limits>

#include "host/core/csv_table.h"
#include "host/core/error.h"
#include "host/output/summary.h"

namespace vkdose::validate {

namespace fs = std::filesystem;

double Run::value(const std::string& key) const {
    const auto found = at.find(key);
    double number = 0;
    if (found != at.end()) {
        const std::string& text = found->second;
        const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (fault == std::errc() && end == text.data() + text.size()) return number;
    }
    throw CaseError({{folder.string(), 0, key, found == at.end() ? "" : found->second, "is not a number that varies",
                      "evaluate the study that came with vkdose"}});
}

Vec3 Run::vector(const std::string& key) const {
    const auto found = at.find(key);
    const std::string text = found == at.end() ? "" : found->second;
    Vec3 numbers(0);
    int count = 0;
    const char *next = text.data(), *const end = next + text.size();
    while (next != end && count < 3) {
        const auto [after, fault] = std::from_chars(next, end, numbers[count]);
        count += fault == std::errc() ? 1 : 0;
        next = fault == std::errc() ? after : next + 1;
    }
    if (count == 3) return numbers;
    throw CaseError({{folder.string(), 0, key, text, "is not three numbers that vary",
                      "evaluate the study that came with vkdose"}});
}

double Run::figure(const std::string& pointer) const {
    const nlohmann::ordered_json::json_pointer place(pointer);
    if (!summary.contains(place) || !summary.at(place).is_number()) return std::numeric_limits<double>::quiet_NaN();
    return summary.at(place).get<double>();
}

std::vector<double> Run::series(const std::string& column) const {
    return Table::read(folder / "timeseries.csv").column(column);
}

std::vector<Run> readRuns(const fs::path& sweep) {
    const Table members = Table::read(sweep / "members.csv");
    std::vector<Run> runs;
    for (std::size_t row = 0; row < members.rows(); ++row) {
        if (members.text(row, "status") != "ok") continue;
        Run run;
        run.folder = sweep / "members" / fmt::format("{:04}", static_cast<int>(members.number(row, "member")));
        bool within = false;
        for (const std::string& name : members.names()) {  // the keys stand between the seed and the status
            if (name == "status") break;
            if (within) run.at[name] = members.text(row, name);
            within = within || name == "seed";
        }
        const auto summary = readSummary(run.folder);
        if (!summary)
            throw CaseError({{(run.folder / "summary.json").string(), 0, "", "", "is missing or not whole",
                              "run the comparison again in another folder"}});
        run.summary = *summary;
        runs.push_back(std::move(run));
    }
    return runs;
}

}  // namespace vkdose::validate
