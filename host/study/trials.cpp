#include "host/study/trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "host/analysis/cycles.h"
#include "host/analysis/mass_rate.h"
#include "host/output/summary.h"

namespace vkdose {

namespace {

/// A figure of a run that is over, and its error; NaN where there is none.
Measured figureIn(const std::filesystem::path& folder, const std::string& figure) {
    const auto summary = readSummary(folder).value_or(nlohmann::ordered_json::object());
    const auto at = [&](const std::string& pointer) {
        const auto value = summary.value(nlohmann::ordered_json::json_pointer(pointer), nlohmann::ordered_json());
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
    std::string pointer = "/measures/" + figure;
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    return {at(pointer), std::numeric_limits<double>::quiet_NaN()};
}

Trial figureOf(const SweepFolder& folder, const std::string& figure, int from, int to) {
    Trial trial;
    for (int number = from; number < to; ++number) {
        const Measured value = figureIn(folder.memberFolder(number), figure);
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
