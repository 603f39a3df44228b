#include "host/study/member_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "host/core/exit_code.h"
#include "host/core/file.h"
#include "host/core/number.h"
#include "host/output/checkpoint.h"
#include "host/output/summary.h"
#include "host/sim/dose.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

/// The value at "a/b" as it stands in a table; empty if it is null or not there.
std::string field(const Json& summary, const char* pointer) {
    const Json value = summary.value(Json::json_pointer(pointer), Json());
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return fmt::format("{:.9g}", value.get<double>());
    return value.is_number() ? value.dump() : "";
}

/// Mean torque of the drive over the complete doses [N m]. A dose that was cut short is in no statistics. Empty if
/// there is no complete dose.
std::string meanTorque(const Table& doses) {
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < doses.rows(); ++i) {
        Dose dose;
        readRow(
            kDoseColumns, dose, [&](const char* name) { return doses.text(i, name); }, [](const char*) {});
        if (!dose.complete) continue;
        sum += dose.coilTorque;
        ++count;
    }
    return count > 0 ? cellText(sum / count, 9) : "";
}

std::string errorText(const MemberEnd& end, const Json& summary) {
    std::string error = field(summary, "/error");
    if (error.empty()) error = end.said;
    if (error.empty() && end.code > 128) error = fmt::format("ended by signal {}", end.code - 128);
    if (error.empty() && end.code != 0) error = fmt::format("ended with exit code {}", end.code);
    return error;
}

}  // namespace

struct MemberRemains {
    MemberStatus status;
    std::string error;
    Table doses;
};

namespace {

constexpr MemberColumn kColumns[] = {
    {"status", "", "ok, failed or interrupted.", nullptr, [](const MemberRemains& m) { return statusText(m.status); }},
    {"error", "", "What went wrong; empty if nothing did.", nullptr, [](const MemberRemains& m) { return m.error; }},
    {"stop_reason", "", "Why the run ended, as in summary.json.", "/stop_reason"},
    {"particles", "1", "Number of particles that were filled in.", "/inputs/particles"},
    {"filled_mass_kg", "kg", "Mass that was filled in.", "/inputs/filled_mass_kg"},
    {"doses", "1", "Number of complete doses.", "/dose_statistics/complete_doses"},
    {"dosed_mass_kg", "kg", "All the mass that came out.", "/ledger/dosed_mass_kg"},
    {"mean_dose_kg", "kg", "Mean mass of the complete doses.", "/dose_statistics/mean_kg"},
    {"sd_dose_kg", "kg", "Standard deviation of the mass of the complete doses.",
     "/dose_statistics/standard_deviation_kg"},
    {"rsd", "1", "Standard deviation over mean of the mass of the complete doses.", "/dose_statistics/rsd"},
    {"beta_kg_per_dose", "kg", "Mass per dose: the slope of the cumulative mass over the number of the dose.",
     "/analysis/beta_kg_per_dose"},
    {"beta_standard_error_kg_per_dose", "kg", "Standard error of this slope.",
     "/analysis/beta_standard_error_kg_per_dose"},
    {"beta_doses", "1", "Number of doses that the slope was taken from.", "/analysis/beta_doses"},
    {"closed_form_kg_per_dose", "kg",
     "Mass per dose by the closed form: bulk density times the volume that the coil sweeps. Of doses to a mass, the "
     "mean for the turns that they made; empty without a complete one.",
     "/closed_form/mass_per_dose_kg"},
    {"doses_to_99_percent", "1",
     "Number of doses until 99 % of the filled mass was out; empty if it did not come to "
     "that.",
     "/analysis/doses_to_99_percent"},
    {"coil_torque_Nm", "N m", "Torque of the drive, mean over the complete doses.", nullptr,
     [](const MemberRemains& m) { return meanTorque(m.doses); }},
    {"blocked_at_dose", "1", "Number of the dose at which the canister blocked; empty if it did not.",
     "/analysis/blocked_at_dose"},
    {"settled_density_kg_m3", "kg/m3", "Bulk density of the bed when it has settled.", "/settled/bulk_density_kg_m3"},
    {"pull_off_over_weight", "1",
     "Median over the settled bed's pairs of the pull-off force over the lighter's weight.",
     "/settled/pull_off_over_weight/median"},
    {"simulated_time_s", "s", "Simulated time at the end of the run.", "/simulated_time_s"},
    {"particle_steps", "1", "Moving particles times time steps, summed over the run.", "/particle_steps"},
    {"wall_time_s", "s", "Wall time spent on time steps.", "/stepping_wall_time_s"},
    {"target_dose_kg", "kg", "Mean target of the doses to a mass; empty of doses by time.", "/targets/mean_target_kg"},
    {"doses_stopped_by_mass", "1",
     "Number of these that stopped because the mass was out; the others by time or torque.",
     "/targets/stopped_by_mass"},
    {"target_error_kg", "kg", "Mean of their mass less the target.", "/targets/mean_error_kg"},
    {"overshoot_kg", "kg", "Mean of what fell after the coil was told to stop.", "/targets/mean_overshoot_kg"},
    {"rotation_s", "s", "Mean time until the coil was told to stop.", "/targets/mean_rotation_s"},
    {"rate_kg_s", "kg/s", "Mass rate while the drive turns; empty with too few windows, as are those that follow.",
     "/analysis/rate/mean_kg_s"},
    {"rate_error_kg_s", "kg/s", "Standard error of this mean.", "/analysis/rate/mean_error_kg_s"},
    {"rate_rsd", "1", "Standard deviation over mean of the rate in windows.", "/analysis/rate/rsd"},
    {"steady_from_s", "s", "Simulated time at which the steady part begins.", "/analysis/rate/steady_from_s"},
    {"steady_rate_kg_s", "kg/s", "Mass rate of the steady part.", "/analysis/rate/steady_kg_s"},
    {"steady_rate_error_kg_s", "kg/s", "Standard error of this mean.", "/analysis/rate/steady_error_kg_s"},
    {"steady_rate_rsd", "1", "Standard deviation over mean of the rate in windows of the steady part.",
     "/analysis/rate/steady_rsd"},
    {"cycle_mass_kg", "kg",
     "Mean mass of a cycle: a turn of the drive, a pocket of a wheel or a stroke. Empty with too few cycles, as are "
     "those that follow.",
     "/analysis/cycle/mean_kg"},
    {"cycle_mass_error_kg", "kg", "Standard error of this mean.", "/analysis/cycle/mean_error_kg"},
    {"cycle_rsd", "1", "Standard deviation over mean of the mass of the cycles.", "/analysis/cycle/rsd"},
    {"steady_cycle_mass_kg", "kg", "Mean mass of a cycle in the steady part.", "/analysis/cycle/steady_kg"},
    {"steady_cycle_mass_error_kg", "kg", "Standard error of this mean.", "/analysis/cycle/steady_error_kg"},
    {"steady_cycle_rsd", "1", "Standard deviation over mean of the mass of the cycles in the steady part.",
     "/analysis/cycle/steady_rsd"},
    {"closed_form_rate_kg_s", "kg/s",
     "Mass rate by the closed form, at the last speed of the drive or of the bodies that turn by themselves.",
     "/closed_form/rate_kg_s"},
};

Row namesOf(std::span<const MemberColumn> columns) {
    Row names;
    for (const MemberColumn& c : columns) names.emplace_back(c.name);
    return names;
}

}  // namespace

const std::span<const MemberColumn> kMemberColumns = kColumns;
const Row kOutputColumns = namesOf(kColumns);

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

namespace {

/// Whether the summary says what the figure is, or that there is none: a run without doses to a mass has no `targets`.
bool tells(const Json& summary, const char* figure) {
    const Json::json_pointer pointer(figure), group = pointer.parent_pointer();
    if (summary.contains(pointer)) return true;
    return !group.empty() && (!summary.contains(group) || summary.at(group).is_null());
}

}  // namespace

MemberResult readResult(const fs::path& folder, const MemberEnd& end) {
    const Json summary = readSummary(folder).value_or(Json::object());
    const Table table = dosesIn(folder);
    MemberResult result;
    for (std::size_t i = 0; i < table.rows(); ++i) result.doses.push_back(table.row(i));
    if (end.code == kInterrupted) {
        result.status = MemberStatus::Interrupted;
    } else if (end.code != 0) {
        result.error = errorText(end, summary);
    } else if (summary.empty() || table.names().empty()) {
        result.error = fmt::format("the run left no whole result in {}", folder.string());
    } else {
        result.status = MemberStatus::Ok;
    }
    const MemberRemains remains{result.status, result.error, table};
    for (const MemberColumn& c : kMemberColumns) {
        result.told.push_back(c.inSummary == nullptr || tells(summary, c.inSummary));
        result.outputs.push_back(c.inSummary != nullptr ? field(summary, c.inSummary) : c.own(remains));
    }
    return result;
}

Table dosesIn(const fs::path& folder) {
    const Table table = Table::salvage(folder / "doses.csv");
    // Those of bodies, regions and powders follow; members of a study may differ in them.
    const Row common = columnNames(kDoseColumns);
    const Row& names = table.names();
    if (names.size() < common.size() || !std::equal(common.begin(), common.end(), names.begin())) return {};
    Table doses(common);
    for (std::size_t i = 0; i < table.rows(); ++i) {
        Row row = table.row(i);
        row.resize(common.size());
        doses.add(std::move(row));
    }
    return doses;
}

bool isOver(const fs::path& folder) {
    const Json summary = readSummary(folder).value_or(Json::object());
    return !fs::exists(folder / kCheckpointName) && summary.contains("error") && summary["error"].is_null() &&
           !summary.value("interrupted", true);
}

double timeReached(const fs::path& folder) {
    constexpr std::size_t kTail = 4096;  // several lines
    const std::string tail = fileEnd(folder / "timeseries.csv", kTail).value_or("");
    const std::size_t end = tail.rfind('\n');
    if (end == std::string::npos || end == 0) return 0;
    const std::size_t start = tail.rfind('\n', end - 1);
    if (start == std::string::npos) return 0;  // the header
    const std::string_view line = std::string_view(tail).substr(start + 1, end - start - 1);
    return std::max(0.0, numberOf(line.substr(0, line.find(','))).value_or(0));
}

}  // namespace vkdose
