#include "host/study/calibration_finding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/json.h"
#include "host/study/member.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;
using Target = CalibrationFinding::Target;
using Parameter = CalibrationFinding::Parameter;
using Point = CalibrationFinding::Point;

constexpr double kGrams = 1e3;  // a search for the mass per dose alone is in kg

std::vector<Target> targetsOf(const Study& study) {
    const CalibrationAim& aim = *study.calibration;
    const std::string base = study.base.filename().string();
    if (aim.targets.empty()) return {{"beta", "g", base, aim.target * kGrams, aim.tolerance * kGrams, 1, 0, 0}};
    std::vector<Target> all;
    for (const CalibrationTarget& t : aim.targets)
        all.push_back({aim.nameOf(t), "", t.base.filename().string(), t.value, t.uncertainty, t.weight, 0, 0});
    return all;
}

void scaleBy(Confirmed& figure, double scale) {
    figure.found.value *= scale;
    figure.found.error *= scale;
}

Parameter parameterOf(const FreeParameter& free, const SearchResult& result, std::size_t k) {
    Parameter p{free.key, free.low, free.high, result.points[result.best][k], {}, 0, result.parameterError[k],
                true,     {}};
    for (const GoalResult& goal : result.goals) p.change.push_back(goal.sensitivity[k]);
    const auto weaker = [](double a, double b) { return std::abs(a) < std::abs(b); };
    p.mostlyBy = std::size_t(std::max_element(p.change.begin(), p.change.end(), weaker) - p.change.begin());
    p.constrained = !(p.error > p.high - p.low);
    const auto& [low, high] = result.compatible[k];
    if (low <= high) p.mayMeet = {low, high};
    return p;
}

Json targetJson(const Target& t) {
    return {{"name", t.name},
            {"unit", t.unit},
            {"base", t.base},
            {"value", jsonNumber(t.value)},
            {"uncertainty", jsonNumber(t.uncertainty)},
            {"weight", jsonNumber(t.weight)},
            {"believed", jsonNumber(t.believed)},
            {"deviation", jsonNumber(t.deviation)}};
}

Json parameterJson(const Parameter& p) {
    return {{"key", p.key},
            {"low", jsonNumber(p.low)},
            {"high", jsonNumber(p.high)},
            {"chosen", jsonNumber(p.chosen)},
            {"change_in_uncertainties", jsonNumbers(p.change)},
            {"mostly_by", p.mostlyBy},
            {"error", jsonNumber(p.error)},
            {"constrained", p.constrained},
            {"may_meet", p.mayMeet ? Json({p.mayMeet->first, p.mayMeet->second}) : Json(nullptr)}};
}

Json pointJson(const Point& p) {
    Json values = Json::array();
    for (const Measured& m : p.values) values.push_back({jsonNumber(m.value), jsonNumber(m.error)});
    return {{"at", jsonNumbers(p.at)}, {"values", values}};
}

Json confirmationJson(const CalibrationFinding::Confirmation& c) {
    Json figures = Json::array();
    for (const Confirmed& f : c.figures)
        figures.push_back({{"mean", jsonNumber(f.found.value)},
                           {"error", jsonNumber(f.found.error)},
                           {"runs", f.runs},
                           {"verdict", verdictText(f.verdict)}});
    return {{"at", c.at}, {"met", c.met}, {"figures", figures}};
}

double numberOf(const Json& j) {
    return j.is_null() ? std::numeric_limits<double>::quiet_NaN() : j.get<double>();
}

std::vector<double> numbersOf(const Json& list) {
    std::vector<double> all;
    for (const Json& j : list) all.push_back(numberOf(j));
    return all;
}

Target readTarget(const Json& j) {
    return {j.at("name").get<std::string>(), j.at("unit").get<std::string>(), j.at("base").get<std::string>(),
            numberOf(j.at("value")),         numberOf(j.at("uncertainty")),   numberOf(j.at("weight")),
            numberOf(j.at("believed")),      numberOf(j.at("deviation"))};
}

Parameter readParameter(const Json& j) {
    Parameter p;
    p.key = j.at("key").get<std::string>();
    p.low = numberOf(j.at("low"));
    p.high = numberOf(j.at("high"));
    p.chosen = numberOf(j.at("chosen"));
    p.change = numbersOf(j.at("change_in_uncertainties"));
    p.mostlyBy = j.at("mostly_by").get<std::size_t>();
    p.error = numberOf(j.at("error"));
    p.constrained = j.at("constrained").get<bool>();
    const Json& range = j.at("may_meet");
    if (!range.is_null()) p.mayMeet = {numberOf(range.at(0)), numberOf(range.at(1))};
    return p;
}

Point readPoint(const Json& j) {
    Point p;
    p.at = numbersOf(j.at("at"));
    for (const Json& value : j.at("values")) p.values.push_back({numberOf(value.at(0)), numberOf(value.at(1))});
    return p;
}

Confirmed readConfirmed(const Json& j) {
    using Verdict = Confirmed::Verdict;
    Confirmed c{{numberOf(j.at("mean")), numberOf(j.at("error"))}, j.at("runs").get<std::size_t>(), {}};
    for (const Verdict v : {Verdict::Met, Verdict::Missed, Verdict::Uncertain, Verdict::Incomplete})
        if (verdictText(v) == j.at("verdict").get<std::string>()) c.verdict = v;
    return c;
}

CalibrationFinding::Confirmation readConfirmation(const Json& j) {
    CalibrationFinding::Confirmation c{j.at("at").get<std::string>(), {}, j.at("met").get<bool>()};
    for (const Json& figure : j.at("figures")) c.figures.push_back(readConfirmed(figure));
    return c;
}

/// Whether every list has an entry for each target, parameter or point that it is about.
bool isWhole(const CalibrationFinding& f) {
    const std::size_t targets = f.targets.size(), parameters = f.parameters.size();
    const auto good = [&](const Parameter& p) { return p.change.size() == targets && p.mostlyBy < targets; };
    const auto complete = [&](const Point& p) { return p.at.size() == parameters && p.values.size() == targets; };
    const auto judged = [&](const CalibrationFinding::Confirmation& c) { return c.figures.size() == targets; };
    const bool grid = f.points.empty() && f.parameters.empty();
    return targets > 0 && (grid || f.best < f.points.size()) &&
           std::all_of(f.parameters.begin(), f.parameters.end(), good) &&
           std::all_of(f.points.begin(), f.points.end(), complete) &&
           std::all_of(f.confirmations.begin(), f.confirmations.end(), judged);
}

CalibrationFinding findingIn(const Json& j) {
    CalibrationFinding f;
    for (const Json& t : j.at("targets")) f.targets.push_back(readTarget(t));
    for (const Json& p : j.at("parameters")) f.parameters.push_back(readParameter(p));
    for (const Json& p : j.at("points")) f.points.push_back(readPoint(p));
    f.best = j.at("best").get<std::size_t>();
    f.misfit = numberOf(j.at("misfit"));
    f.confirmingSeeds = j.at("confirming_seeds").get<std::vector<std::uint64_t>>();
    for (const Json& c : j.at("confirmations")) f.confirmations.push_back(readConfirmation(c));
    f.met = j.at("met").get<bool>();
    return f;
}

}  // namespace

std::vector<Setting> settingsAt(const Study& study, const Parameters& p) {
    std::vector<Setting> all;
    for (std::size_t i = 0; i < p.size(); ++i)
        all.push_back(settingOf(study, study.calibration->parameters[i].key, p[i]));
    return all;
}

std::string placeText(const std::vector<Setting>& point) {
    std::string text;
    for (const Setting& s : point) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", s.key, tableText(s.value));
    return text;
}

CalibrationFinding findingOf(const Study& study, const SearchResult& result,
                             const std::vector<std::uint64_t>& confirmingSeeds) {
    const CalibrationAim& aim = *study.calibration;
    const double scale = aim.targets.empty() ? kGrams : 1;
    CalibrationFinding f;
    f.targets = targetsOf(study);
    f.best = result.best;
    f.misfit = result.misfit;
    f.met = result.met;
    f.confirmingSeeds = confirmingSeeds;
    for (const Confirmation& c : result.confirmations) {
        std::vector<Confirmed> figures = c.figures;
        for (Confirmed& figure : figures) scaleBy(figure, scale);
        f.confirmations.push_back({placeText(settingsAt(study, result.points[c.point])), figures, c.met()});
    }
    for (std::size_t g = 0; g < f.targets.size(); ++g) {
        f.targets[g].believed = result.goals[g].mean * scale;
        f.targets[g].deviation = result.goals[g].deviation * scale;
    }
    for (std::size_t k = 0; k < aim.parameters.size(); ++k)
        f.parameters.push_back(parameterOf(aim.parameters[k], result, k));
    for (std::size_t i = 0; i < result.points.size(); ++i) {
        Point& p = f.points.emplace_back(Point{result.points[i], {}});
        for (const GoalResult& goal : result.goals)
            p.values.push_back({goal.values[i].value * scale, goal.values[i].error * scale});
    }
    return f;
}

CalibrationFinding findingOf(const Study& study, const std::vector<Setting>& point, double believed,
                             const Confirmed& confirmed, const std::vector<std::uint64_t>& confirmingSeeds) {
    CalibrationFinding f;
    f.targets = targetsOf(study);
    CalibrationFinding::Target& target = f.targets.front();
    target.believed = believed * kGrams;
    target.deviation = std::numeric_limits<double>::quiet_NaN();  // a line between two points has no error of its own
    f.misfit = std::pow((target.believed - target.value) / target.uncertainty, 2);
    f.confirmingSeeds = confirmingSeeds;
    Confirmed figure = confirmed;
    scaleBy(figure, kGrams);
    f.met = figure.verdict == Confirmed::Verdict::Met;
    f.confirmations.push_back({placeText(point), {figure}, f.met});
    return f;
}

Json findingJson(const CalibrationFinding& finding) {
    Json j{{"met", finding.met}, {"misfit", jsonNumber(finding.misfit)}};
    for (const char* list : {"targets", "parameters", "points"}) j[list] = Json::array();
    for (const Target& t : finding.targets) j["targets"].push_back(targetJson(t));
    for (const Parameter& p : finding.parameters) j["parameters"].push_back(parameterJson(p));
    for (const Point& p : finding.points) j["points"].push_back(pointJson(p));
    j["best"] = finding.best;
    j["confirming_seeds"] = finding.confirmingSeeds;
    j["confirmations"] = Json::array();
    for (const auto& c : finding.confirmations) j["confirmations"].push_back(confirmationJson(c));
    return j;
}

void writeFinding(const fs::path& folder, const CalibrationFinding& finding) {
    const std::string text = findingJson(finding).dump(2, ' ', false, Json::error_handler_t::replace);
    replaceFile(folder / kFindingName, text + "\n");
}

void forgetFinding(const fs::path& folder) {
    std::error_code code;
    fs::remove(folder / kFindingName, code);
    if (code) throw OutputError(fmt::format("cannot remove {}: {}", (folder / kFindingName).string(), code.message()));
}

std::optional<CalibrationFinding> readFinding(const fs::path& folder) {
    const fs::path file = folder / kFindingName;
    if (!fs::exists(file)) return std::nullopt;
    try {
        CalibrationFinding f = findingIn(Json::parse(fileContent(file).value_or("")));
        if (isWhole(f)) return f;
    } catch (const Json::exception&) {  // told below, as what is incomplete
    }
    throw CaseError(
        {{file.string(), 0, "", "", "is not the finding of a calibration", "run vkdose calibrate again to write it"}});
}

}  // namespace vkdose
