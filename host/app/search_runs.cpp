#include "host/app/search_runs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "host/app/tell.h"
#include "host/core/file.h"
#include "host/output/measured.h"
#include "host/output/summary.h"
#include "host/study/calibration_finding.h"

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
    std::string pointer = "/measures/" + figure;
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    return {at(pointer), std::numeric_limits<double>::quiet_NaN()};
}

std::vector<std::optional<std::uint64_t>> seedsOf(const Study& study) {
    if (study.seeds.empty()) return {std::nullopt};
    return {study.seeds.begin(), study.seeds.end()};
}

std::vector<Member> membersAt(const Study& study, const std::vector<Parameters>& points, int& next) {
    std::vector<Member> members;
    for (const Parameters& p : points)
        for (const std::filesystem::path& base : basesOf(study))
            for (const auto& seed : seedsOf(study))
                members.push_back(memberAt(study, next++, seed, settingsAt(study, p), base));
    return members;
}

}  // namespace

std::vector<Setting> settingsAt(const Study& study, const Parameters& p) {
    std::vector<Setting> all;
    for (std::size_t i = 0; i < p.size(); ++i)
        all.push_back(settingOf(study, study.calibration->parameters[i].key, p[i]));
    return all;
}

std::vector<std::filesystem::path> basesOf(const Study& study) {
    const std::vector<std::filesystem::path> bases = study.calibration->bases();
    return bases.empty() ? std::vector{study.base} : bases;
}

SearchRuns::SearchRuns(const Study& study, SweepFolder& folder, MemberRunner& runner, SweepObserver& observer,
                       const std::atomic<bool>& stop, bool retryFailed)
    : study_(study),
      bases_(basesOf(study)),
      folder_(folder),
      runner_(runner),
      observer_(observer),
      stop_(stop),
      retry_(retryFailed) {}

std::optional<std::vector<Trials>> SearchRuns::operator()(const std::vector<Parameters>& points) {
    const std::vector<Member> members = membersAt(study_, points, next_);
    for (const Member& m : members) folder_.requireSame(m);
    const bool ended = std::all_of(members.begin(), members.end(),
                                   [&](const Member& m) { return folder_.status(m.number).has_value(); });
    // Later points follow from what these gave. To run a failed one again would lead to others.
    const bool last = !std::filesystem::exists(folder_.memberFolder(next_));
    if (!last && retry_) tellFailed(members);
    if (!ended || (last && retry_)) forgetFinding(folder_.path());
    if (!runMembers(folder_, members, runner_, observer_, stop_, retry_ && last).whole) return std::nullopt;
    std::vector<Trials> trials;
    for (std::size_t i = 0; i < points.size(); ++i)
        trials.push_back(trialsOf(members[i * bases_.size() * seedsOf(study_).size()].number));
    return trials;
}

std::vector<Member> SearchRuns::first(const Study& study) {
    std::vector<Parameters> points;
    (void)search(*study.calibration, [&](const std::vector<Parameters>& batch) {
        points = batch;
        return std::optional<std::vector<Trials>>();
    });
    int next = 0;
    return membersAt(study, points, next);
}

void SearchRuns::tellFailed(const std::vector<Member>& members) const {
    for (const Member& m : members)
        if (folder_.status(m.number) == MemberStatus::Failed)
            tell(stderr,
                 "vkdose: member {:04} failed and is left so, because later points of the search follow from it\n",
                 m.number);
}

/// The trials of a point, whose members have numbers from `first` on.
Trials SearchRuns::trialsOf(int first) const {
    const int count = int(seedsOf(study_).size());
    if (study_.calibration->targets.empty()) return {massPerDoseOf(first, first + count)};
    Trials trials;
    for (const CalibrationTarget& t : study_.calibration->targets) {
        const auto place = std::find(bases_.begin(), bases_.end(), t.base) - bases_.begin();
        trials.push_back(figureOf(t.figure, first + int(place) * count, first + int(place + 1) * count));
    }
    return trials;
}

Trial SearchRuns::figureOf(const std::string& figure, int from, int to) const {
    Trial trial;
    for (int number = from; number < to; ++number) {
        const Measured value = figureIn(folder_.memberFolder(number), figure);
        if (folder_.status(number) != MemberStatus::Ok || !std::isfinite(value.value)) continue;
        trial.values.push_back(value.value);
        trial.error = value.error;
    }
    return trial;
}

/// From the table, so that a search that goes on sees the same digits as one that was not interrupted.
Trial SearchRuns::massPerDoseOf(int from, int to) const {
    const Table& table = folder_.members();
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

}  // namespace vkdose
