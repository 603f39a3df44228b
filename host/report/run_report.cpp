#include "host/report/run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "host/analysis/balance.h"
#include "host/analysis/cycles.h"
#include "host/analysis/mass_rate.h"
#include "host/analysis/outlet.h"
#include "host/core/csv_table.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/json.h"
#include "host/model/case.h"
#include "host/output/dose_table.h"
#include "host/output/end_state.h"
#include "host/output/summary.h"
#include "host/report/fields_report.h"
#include "host/report/free_surface_report.h"
#include "host/report/player_data.h"
#include "host/report/run_figures.h"

namespace vkdose::report {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostLines = 5000;

std::string readText(const fs::path& file) {
    const std::optional<std::string> text = fileContent(file);
    if (!text) throw CaseError({{file.string(), 0, "", "", readFault(file), "give the output folder of a run"}});
    return *text;
}

/// Values in groups of `size`: the mean of those that are numbers, or the last.
std::vector<double> thinned(const std::vector<double>& values, std::size_t size, bool mean) {
    std::vector<double> few;
    for (std::size_t i = 0; i < values.size(); i += size) {
        const std::size_t end = std::min(i + size, values.size());
        double sum = 0, count = 0;
        for (std::size_t j = i; j < end; ++j)
            if (!std::isnan(values[j])) sum += values[j], ++count;
        few.push_back(mean ? sum / count : values[end - 1]);  // 0/0: NaN, as it should be
    }
    return few;
}

/// The loads of each body, whose columns begin with its name and a dot. Of [coil] only the force: its torque and power
/// are those of the drive.
Json bodySeries(const Table& series, const World& world, std::size_t size) {
    Json bodies = Json::array();
    constexpr std::string_view kLast = ".torque_Nm";
    for (const std::string& column : series.names()) {
        if (!column.ends_with(kLast)) continue;
        const std::string name = column.substr(0, column.size() - kLast.size());
        Json j{{"name", name}};
        std::vector<const char*> loads{"force_x_N", "force_y_N", "force_z_N"};
        if (!world.coil || name != kCoilName) loads.insert(loads.end(), {"torque_Nm", "power_W"});
        for (const char* load : loads) j[load] = jsonNumbers(thinned(series.column(name + "." + load), size, true));
        bodies.push_back(std::move(j));
    }
    return bodies;
}

/// The masses in the columns with this ending, behind the name of a region or powder.
Json massSeries(const Table& series, std::string_view ending, std::size_t size) {
    Json list = Json::array();
    for (const std::string& column : series.names())
        if (column.ends_with(ending))
            list.push_back({{"name", column.substr(0, column.size() - ending.size())},
                            {"mass_kg", jsonNumbers(thinned(series.column(column), size, false))}});
    return list;
}

/// The contents of the regions that do not delete; the others only gain what has been dosed.
Json contentSeries(const Table& series, const World& world, std::size_t size) {
    Json list = Json::array();
    for (Json& content : massSeries(series, ".content_kg", size)) {
        const auto named = [&](const CountRegion& region) { return content["name"] == region.name; };
        const auto region = std::find_if(world.regions.begin(), world.regions.end(), named);
        if (region != world.regions.end() && !region->deletes) list.push_back(std::move(content));
    }
    return list;
}

Json seriesJson(const Table& series, const World& world) {
    const std::size_t size = (series.rows() + kMostLines - 1) / kMostLines;
    Json j;
    for (const char* name : {"time_s", "dosed_mass_kg", "canister_mass_kg", "throat_mass_kg", "lost_mass_kg"})
        j[name] = jsonNumbers(thinned(series.column(name), std::max<std::size_t>(size, 1), false));
    for (const char* name : {"outlet_velocity_m_s", "coil_torque_Nm", "coil_power_W"})
        j[name] = jsonNumbers(thinned(series.column(name), std::max<std::size_t>(size, 1), true));
    j["bodies"] = bodySeries(series, world, std::max<std::size_t>(size, 1));
    j["regions"] = massSeries(series, ".mass_kg", std::max<std::size_t>(size, 1));
    j["contents"] = contentSeries(series, world, std::max<std::size_t>(size, 1));
    j["powders"] = massSeries(series, ".dosed_mass_kg", std::max<std::size_t>(size, 1));
    return j;
}

/// The windows of the mass rate, each at its middle. `steady` is the number of the first in the steady part.
Json rateJson(const Table& series, const Case& c) {
    const MassRate rate = massRate(flowSamples(series), windowRuleOf(c));
    const std::size_t size = std::max<std::size_t>((rate.windows.size() + kMostLines - 1) / kMostLines, 1);
    std::vector<double> times, rates;
    for (const RateWindow& w : rate.windows) {
        times.push_back((w.from + w.to) / 2);
        rates.push_back(w.rate);
    }
    return {{"window_s", jsonNumber(rate.window)},
            {"time_s", jsonNumbers(thinned(times, size, true))},
            {"kg_s", jsonNumbers(thinned(rates, size, true))},
            {"steady", rate.steady ? Json(*rate.steady / size) : Json(nullptr)},
            {"steady_kg_s", jsonNumber(rate.steadyPart.mean)}};
}

/// The mass of each cycle beside what was left. `steady` is the number of the first in the steady part.
Json cyclesJson(const Table& series, const Case& c) {
    const Cycles cycles = cyclesOf(flowSamples(series), cycleRuleOf(c));
    const std::size_t size = std::max<std::size_t>((cycles.list.size() + kMostLines - 1) / kMostLines, 1);
    std::vector<double> times, masses, left;
    for (const CycleMass& cycle : cycles.list) {
        times.push_back((cycle.start + cycle.end) / 2);
        masses.push_back(cycle.mass);
        left.push_back(cycle.left);
    }
    return {{"is", cycles.what},
            {"time_s", jsonNumbers(thinned(times, size, true))},
            {"mass_kg", jsonNumbers(thinned(masses, size, true))},
            {"left_kg", jsonNumbers(thinned(left, size, true))},
            {"steady", cycles.steady ? Json(*cycles.steady / size) : Json(nullptr)},
            {"steady_kg", jsonNumber(cycles.steadyPart.mean)}};
}

/// When the coil turned: [begin, end] [s] for each dose. The phase in a line is that of the time between this line and
/// the one before.
Json rotations(const Table& series) {
    Json list = Json::array();
    double before = 0;
    bool turning = false;
    for (std::size_t i = 0; i < series.rows(); ++i) {
        const double time = series.number(i, "time_s");
        const bool turns = series.text(i, "phase") == "rotate";
        if (turns && !turning) list.push_back({before, time});
        if (turns) list.back()[1] = time;
        turning = turns;
        before = time;
    }
    return list;
}

/// The summary. Null without one, and for that of an interruption after which the run went on.
Json summaryOf(const fs::path& folder, const Table& series) {
    const fs::path file = folder / "summary.json";
    if (!fs::exists(file)) return nullptr;
    const std::optional<Json> summary = readSummary(folder);
    if (!summary) throw CaseError({{file.string(), 0, "", "", "is not a summary", "run the case again"}});
    const Json& time = summary->value("simulated_time_s", Json());
    constexpr double kRounding = 1e-8;  // the time series has nine digits
    const bool later = time.is_number() && series.rows() > 0 &&
                       series.number(series.rows() - 1, "time_s") > time.get<double>() * (1 + kRounding);
    return later ? Json(nullptr) : *summary;
}

Json dosesJson(const Table& table, const RunSources& run) {
    const std::vector<Dose>& doses = run.doses;
    Json j;
    for (const std::string& name : table.names())
        if (name != "stopped_by") j[name] = jsonNumbers(table.column(name));
    j["stopped_by"] = Json::array();
    for (const Dose& d : doses) j["stopped_by"].push_back(cellText(d.stoppedBy, kAllDigits));
    std::vector<int> complete;
    for (const Dose& d : doses) complete.push_back(d.complete ? 1 : 0);
    j["complete"] = complete;
    j["longest_stop_s"] = j["arch_m"] = Json::array();
    const std::map<int, double> stops = outletFlow(flowSamples(run.series), filledMass(run)).longestIn;
    std::map<int, Json> arches;
    if (run.summary.is_object() && run.summary.contains("arches"))
        for (const Json& a : run.summary["arches"])
            if (a.is_object()) arches[a.value("dose", 0)] = a.value("height_m", Json());
    for (const Dose& d : doses) {
        const auto stop = stops.find(d.index);
        j["longest_stop_s"].push_back(stop == stops.end() ? 0.0 : stop->second);
        j["arch_m"].push_back(arches[d.index]);
    }
    return j;
}

}  // namespace

Json experimentJson(const fs::path& file) {
    const BalanceReadings balance = readBalance(file);
    std::vector<double> doses(balance.mass.size());
    std::iota(doses.begin(), doses.end(), 1.0);
    Json j;
    j["name"] = file.filename().string();
    j["dose"] = jsonNumbers(doses);
    j["mass_kg"] = jsonNumbers(balance.mass);
    j["cumulative_mass_kg"] = jsonNumbers(balance.cumulative);
    return j;
}

Json runJson(const fs::path& folder, const std::optional<fs::path>& experiment) {
    return runJson(folder, experiment, {}, {});
}

Json runJson(const fs::path& folder, const std::optional<fs::path>& experiment, const FrameSource& frames,
             const std::vector<Photograph>& photographs) {
    const Case c = loadResolvedCase(readText(folder / "case.toml"), folder / "case.toml");
    const Table series = Table::read(folder / "timeseries.csv");
    const Table doseTable = Table::read(folder / "doses.csv");
    RunSources sources{c, series, dosesOf(doseTable), summaryOf(folder, series), {}};
    if (sources.summary.is_object() && fs::exists(folder / "particles.csv"))
        sources.particles = endParticles(folder / "particles.csv", sources.c);
    if (sources.particles && !c.world.bodies.empty()) {
        const Frame end = vkdose::readEndState(folder, c);
        sources.bodies = bodyPoses(c.world, end.time, end.coilAngle, end.bodiesMoved);
    }

    Json j;
    j["kind"] = "run";
    j["name"] = c.name;
    j["reason"] = c.reason;
    j["facts"] = runFacts(sources);
    j["doses"] = dosesJson(doseTable, sources);
    j["series"] = seriesJson(series, c.world);
    j["rotations"] = rotations(series);
    j["rate"] = rateJson(series, c);
    j["cycles"] = cyclesJson(series, c);
    j["rate_leads"] = rateLeads(sources);
    j["holds"] = c.canister ? "canister" : "device";
    j["beta_below_kg"] =
        jsonNumber(figuresOf(sources.doses, supplyOf(sources), sources.c.schedule.stop).window.cumulativeBelow);
    j["filled_mass_kg"] = jsonNumber(filledMass(sources));
    j["experiment"] = experiment ? experimentJson(*experiment) : Json(nullptr);
    const int lastDose = sources.doses.empty() ? 0 : sources.doses.back().index;
    j["surface"] = surfaceJson(c, frames, sources.particles, lastDose, photographs);
    const Json& surface = j["surface"];
    j["fields"] = fieldsJson(folder, c);
    j["player"] = playerJson(c, frames, surface.is_null() ? 0 : surface["z_m"].size(),
                             kMostCharacters - streamCharacters(j["fields"]));
    j["case"] = c.resolved;
    return j;
}

}  // namespace vkdose::report
