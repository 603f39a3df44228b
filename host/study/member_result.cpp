#include "host/study/member_result.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "host/core/file.h"
#include "host/output/checkpoint.h"
#include "host/output/run_folder.h"

namespace vkdose {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

constexpr int kInterruptedCode = 130;

Json readSummary(const fs::path& folder) {
    std::ifstream stream = inputFile(folder / "summary.json");
    Json summary = stream ? Json::parse(stream, nullptr, false) : Json();
    return summary.is_object() ? summary : Json::object();
}

/// The value at "a/b" as it stands in a table; empty if it is null or not there.
std::string field(const Json& summary, const char* pointer) {
    const Json value = summary.value(Json::json_pointer(pointer), Json());
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return fmt::format("{:.9g}", value.get<double>());
    return value.is_number() ? value.dump() : "";
}

/// Complete doses only: one that was cut short is in no statistics.
struct Doses {
    std::vector<double> cumulative;  ///< [kg]
    double torque = 0;               ///< mean [N m]
};

Doses completeDoses(const Table& table) {
    Doses doses;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        if (table.text(i, "complete") != "1") continue;
        doses.cumulative.push_back(numberIn(table.text(i, "cumulative_mass_kg")));
        doses.torque += numberIn(table.text(i, "coil_torque_Nm"));
    }
    if (!doses.cumulative.empty()) doses.torque /= double(doses.cumulative.size());
    return doses;
}

std::string errorText(const MemberEnd& end, const Json& summary) {
    std::string error = field(summary, "/error");
    if (error.empty()) error = end.said;
    if (error.empty() && end.code > 128) error = fmt::format("ended by signal {}", end.code - 128);
    if (error.empty() && end.code != 0) error = fmt::format("ended with exit code {}", end.code);
    return error;
}

}  // namespace

const Row kOutputColumns{"status",
                         "error",
                         "stop_reason",
                         "particles",
                         "filled_mass_kg",
                         "doses",
                         "dosed_mass_kg",
                         "mean_dose_kg",
                         "sd_dose_kg",
                         "rsd",
                         "beta_kg_per_dose",
                         "beta_standard_error_kg_per_dose",
                         "beta_doses",
                         "closed_form_kg_per_dose",
                         "doses_to_99_percent",
                         "coil_torque_Nm",
                         "blocked_at_dose",
                         "simulated_time_s",
                         "particle_steps",
                         "wall_time_s"};

std::string statusText(MemberStatus status) {
    switch (status) {
        case MemberStatus::Ok:
            return "ok";
        case MemberStatus::Interrupted:
            return "interrupted";
        default:
            return "failed";
    }
}

MemberResult readResult(const fs::path& folder, const MemberEnd& end) {
    const Json summary = readSummary(folder);
    const Table table = dosesIn(folder);
    MemberResult result;
    for (std::size_t i = 0; i < table.rows(); ++i) result.doses.push_back(table.row(i));
    if (end.code == kInterruptedCode) {
        result.status = MemberStatus::Interrupted;
    } else if (end.code != 0) {
        result.error = errorText(end, summary);
    } else if (summary.empty() || table.names().empty()) {
        result.error = fmt::format("the run left no whole result in {}", folder.string());
    } else {
        result.status = MemberStatus::Ok;
    }
    const Doses doses = completeDoses(table);
    std::map<std::string, std::string> out{
        {"status", statusText(result.status)},
        {"error", result.error},
        {"stop_reason", field(summary, "/stop_reason")},
        {"particles", field(summary, "/inputs/particles")},
        {"filled_mass_kg", field(summary, "/inputs/filled_mass_kg")},
        {"doses", field(summary, "/dose_statistics/complete_doses")},
        {"dosed_mass_kg", field(summary, "/ledger/dosed_mass_kg")},
        {"mean_dose_kg", field(summary, "/dose_statistics/mean_kg")},
        {"sd_dose_kg", field(summary, "/dose_statistics/standard_deviation_kg")},
        {"rsd", field(summary, "/dose_statistics/rsd")},
        {"beta_kg_per_dose", field(summary, "/analysis/beta_kg_per_dose")},
        {"beta_standard_error_kg_per_dose", field(summary, "/analysis/beta_standard_error_kg_per_dose")},
        {"beta_doses", field(summary, "/analysis/beta_doses")},
        {"doses_to_99_percent", field(summary, "/analysis/doses_to_99_percent")},
        {"blocked_at_dose", field(summary, "/analysis/blocked_at_dose")},
        {"closed_form_kg_per_dose", field(summary, "/closed_form/mass_per_dose_kg")},
        {"simulated_time_s", field(summary, "/simulated_time_s")},
        {"particle_steps", field(summary, "/particle_steps")},
        {"wall_time_s", field(summary, "/stepping_wall_time_s")},
    };
    if (!doses.cumulative.empty()) out["coil_torque_Nm"] = fmt::format("{:.9g}", doses.torque);
    for (const std::string& column : kOutputColumns) result.outputs.push_back(out[column]);
    return result;
}

Table dosesIn(const fs::path& folder) {
    Table table = Table::salvage(folder / "doses.csv");
    return table.names() == *csvFields(kDosesHeader) ? table : Table();
}

bool isOver(const fs::path& folder) {
    const Json summary = readSummary(folder);
    return !fs::exists(folder / kCheckpointName) && summary.contains("error") && summary["error"].is_null() &&
           !summary.value("interrupted", true);
}

double timeReached(const fs::path& folder) {
    std::ifstream stream = inputFile(folder / "timeseries.csv");
    stream.seekg(0, std::ios::end);
    const std::streamoff size = stream ? std::streamoff(stream.tellg()) : 0;
    constexpr std::streamoff kTail = 4096;  // several lines
    std::string tail(std::size_t(std::min(size, kTail)), '\0');
    if (tail.empty()) return 0;
    stream.seekg(size - std::streamoff(tail.size()));
    stream.read(tail.data(), std::streamsize(tail.size()));
    const std::size_t end = tail.rfind('\n');
    if (end == std::string::npos || end == 0) return 0;
    const std::size_t start = tail.rfind('\n', end - 1);
    if (start == std::string::npos) return 0;  // the header
    return std::max(0.0, std::strtod(tail.c_str() + start + 1, nullptr));
}

}  // namespace vkdose
