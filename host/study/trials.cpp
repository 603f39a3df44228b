#include "host/study/trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "host/analysis/cycles.h"
#include "host/analysis/mass_rate.h"
#include "host/core/columns.h"
#include "host/output/figure_words.h"
#include "host/output/summary.h"
#include "host/sim/body_loads.h"

namespace vkdose {

namespace {

/// The figures of the doses, as targets name them, and where summary.json has them.
struct DoseFigure {
    const char* name;
    const char* pointer;
};
constexpr DoseFigure kDoseFigures[] = {{"dose.mean_kg", "/dose_statistics/mean_kg"},
                                       {"dose.rsd", "/dose_statistics/rsd"},
                                       {"dose.left_kg", "/ledger/canister_mass_kg"}};

constexpr const char* kRegionFigures[] = {"mass_kg", "content_kg", "largest_content_kg"};

/// "body.largest_torque_Nm", "region.content_kg": of the body, wall or region with this name.
double namedFigure(const nlohmann::ordered_json& summary, const std::string& figure) {
    const std::string whose = figure.substr(0, figure.find('.')), name = figure.substr(figure.find('.') + 1);
    for (const char* list : {"bodies", "regions"})
        for (const auto& one : summary.value(list, nlohmann::ordered_json::array()))
            if (one.value("name", "") == whose && one.contains(name) && one[name].is_number())
                return one[name].get<double>();
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

RunFigures::RunFigures(const std::filesystem::path& folder)
    : summary_(readSummary(folder).value_or(nlohmann::ordered_json::object())) {}

Measured RunFigures::at(const std::string& figure) const {
    const auto at = [&](const std::string& pointer) {
        const auto value = summary_.value(nlohmann::ordered_json::json_pointer(pointer), nlohmann::ordered_json());
        return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
    };
    if (figure == kMassPerDose)
        return {at("/analysis/beta_kg_per_dose") * 1e3, at("/analysis/beta_standard_error_kg_per_dose") * 1e3};
    const auto ofSeries = [&](const char* kind, const auto& f) {
        const std::string all = fmt::format("/analysis/{}/", kind);
        return Measured{at(all + f.name), f.error ? at(all + f.error) : std::numeric_limits<double>::quiet_NaN()};
    };
    if (const RateFigure* f = figureNamed(kRateFigures, kRateName, figure)) return ofSeries(kRateName, *f);
    if (const CycleFigure* f = figureNamed(kCycleFigures, kCycleName, figure)) return ofSeries(kCycleName, *f);
    for (const DoseFigure& f : kDoseFigures)
        if (figure == f.name) return {at(f.pointer), std::numeric_limits<double>::quiet_NaN()};
    const auto ofMeasure = [&](std::string pointer) {
        std::replace(pointer.begin(), pointer.end(), '.', '/');
        return at("/measures/" + pointer);
    };
    const double measure = ofMeasure(figure);
    if (!std::isfinite(measure)) return {namedFigure(summary_, figure), std::numeric_limits<double>::quiet_NaN()};
    // Where a measure tells the error of angle_deg, it is its angle_error_deg.
    const std::size_t unit = figure.rfind('_');
    return {measure, unit == std::string::npos ? std::numeric_limits<double>::quiet_NaN()
                                               : ofMeasure(figure.substr(0, unit) + "_error" + figure.substr(unit))};
}

namespace {

Trial figureOf(const SweepFolder& folder, const std::string& figure, int from, int to) {
    Trial trial;
    for (int number = from; number < to; ++number) {
        const Measured value = RunFigures(folder.memberFolder(number)).at(figure);
        if (folder.status(number) != MemberStatus::Ok || !std::isfinite(value.value)) continue;
        trial.values.push_back(value.value);
        trial.error = value.error;
    }
    return trial;
}

/// From the table, so that a search that goes on sees the same digits as one that was not interrupted.
Trial massPerDoseOf(const SweepFolder& folder, int from, int to) {
    const Table& table = folder.members();
    Trial trial;
    for (int number = from; number < to; ++number) {
        for (std::size_t row = 0; row < table.rows(); ++row) {
            const double beta = table.number(row, "beta_kg_per_dose");
            if (table.text(row, "member") != std::to_string(number) || table.text(row, "status") != "ok" ||
                std::isnan(beta))
                continue;
            trial.values.push_back(beta);
            trial.error = table.number(row, "beta_standard_error_kg_per_dose");
        }
    }
    return trial;
}

}  // namespace

std::vector<std::string> figureNames(const Case& c) {
    std::vector<std::string> names{kMassPerDose};
    for (const DoseFigure& f : kDoseFigures) names.emplace_back(f.name);
    for (const RateFigure& f : kRateFigures) names.push_back(std::string(kRateName) + "." + f.name);
    for (const CycleFigure& f : kCycleFigures) names.push_back(std::string(kCycleName) + "." + f.name);
    for (const ElementTest& m : c.measures)
        for (const std::string& figure : figureNames(m)) names.push_back(m.name + "." + figure);
    for (const std::string& body : loadNames(c.world))
        forEachColumn(kBodyPeakColumns, [&](const auto& column) { names.push_back(body + "." + column.name); });
    for (const CountRegion& region : c.world.regions)
        for (const char* figure : kRegionFigures) names.push_back(region.name + "." + figure);
    return names;
}

std::vector<std::filesystem::path> basesOf(const Study& study) {
    const std::vector<std::filesystem::path> bases = study.calibration->bases();
    return bases.empty() ? std::vector{study.base} : bases;
}

Trials trialsOf(const Study& study, const SweepFolder& folder, int first, int seeds) {
    if (study.calibration->targets.empty()) return {massPerDoseOf(folder, first, first + seeds)};
    const std::vector<std::filesystem::path> bases = basesOf(study);
    Trials trials;
    for (const CalibrationTarget& t : study.calibration->targets) {
        const auto place = std::find(bases.begin(), bases.end(), t.base) - bases.begin();
        trials.push_back(figureOf(folder, t.figure, first + int(place) * seeds, first + int(place + 1) * seeds));
    }
    return trials;
}

}  // namespace vkdose
