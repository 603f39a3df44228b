#include "host/study/calibration_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "host/core/csv_table.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/json.h"
#include "host/study/finding_file.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;
using Target = CalibrationFinding::Target;
using Parameter = CalibrationFinding::Parameter;
using Point = CalibrationFinding::Point;
using Fit = CalibrationFinding::Fit;

constexpr const char* kMethod = "transitional Markov chain Monte Carlo";

Json leaveOneOutJson(const LeaveOneOut& l) {
    if (l.points == 0) return nullptr;
    return {{"points", l.points},
            {"error", jsonNumber(l.error)},
            {"standardised_error", jsonNumber(l.standardised)},
            {"largest_standardised_error", jsonNumber(l.largest)},
            {"predictive_r2", jsonNumber(l.predictiveR2)},
            {"verdict", verdictText(l.verdict())}};
}

Json targetJson(const Target& t) {
    return {{"name", t.name},
            {"unit", t.unit},
            {"base", t.base},
            {"value", jsonNumber(t.value)},
            {"uncertainty", jsonNumber(t.uncertainty)},
            {"weight", jsonNumber(t.weight)},
            {"believed", jsonNumber(t.believed)},
            {"deviation", jsonNumber(t.deviation)},
            {"leave_one_out", leaveOneOutJson(t.leaveOneOut)}};
}

Json parameterJson(const Parameter& p) {
    return {{"key", p.key},
            {"low", jsonNumber(p.low)},
            {"high", jsonNumber(p.high)},
            {"chosen", jsonNumber(p.chosen)},
            {"change_in_uncertainties", jsonNumbers(p.change)},
            {"mostly_by", p.mostlyBy},
            {"median", jsonNumber(p.fits.median)},
            {"interval_95", {jsonNumber(p.fits.low), jsonNumber(p.fits.high)}},
            {"constrained", p.constrained()}};
}

Json fitJson(const CalibrationFinding& f) {
    if (!f.fit) return nullptr;
    Json j{{"method", kMethod},
           {"sampled", f.fit->sampled},
           {"steps", f.fit->steps},
           {"acceptance", jsonNumber(f.fit->acceptance)},
           {"r_hat", jsonNumber(f.fit->rHat)},
           {"effective", jsonNumber(f.fit->effective)},
           {"draws", f.fit->draws.size()}};
    for (const char* list : {"correlation", "compensations", "figures"}) j[list] = Json::array();
    for (const std::vector<double>& row : f.fit->correlation) j["correlation"].push_back(jsonNumbers(row));
    for (const Compensation& c : compensations(f)) j["compensations"].push_back({c.first, c.second});
    for (std::size_t g = 0; g < f.fit->figures.size(); ++g)
        j["figures"].push_back({{"mean", jsonNumber(f.fit->figures[g].mean)},
                                {"deviation", jsonNumber(f.fit->figures[g].deviation)},
                                {"reached", isReached(f, g)}});
    return j;
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

LeaveOneOut readLeaveOneOut(const Json& j) {
    if (j.is_null()) return {};
    return {j.at("points").get<std::size_t>(), numberOf(j.at("error")), numberOf(j.at("standardised_error")),
            numberOf(j.at("largest_standardised_error")), numberOf(j.at("predictive_r2"))};
}

Target readTarget(const Json& j) {
    return {j.at("name").get<std::string>(), j.at("unit").get<std::string>(), j.at("base").get<std::string>(),
            numberOf(j.at("value")),         numberOf(j.at("uncertainty")),   numberOf(j.at("weight")),
            numberOf(j.at("believed")),      numberOf(j.at("deviation")),     readLeaveOneOut(j.at("leave_one_out"))};
}

Parameter readParameter(const Json& j) {
    Parameter p;
    p.key = j.at("key").get<std::string>();
    p.low = numberOf(j.at("low"));
    p.high = numberOf(j.at("high"));
    p.chosen = numberOf(j.at("chosen"));
    p.change = numbersOf(j.at("change_in_uncertainties"));
    p.mostlyBy = j.at("mostly_by").get<std::size_t>();
    p.fits = {numberOf(j.at("median")), numberOf(j.at("interval_95").at(0)), numberOf(j.at("interval_95").at(1))};
    return p;
}

std::optional<Fit> readFit(const Json& j) {
    if (j.is_null()) return std::nullopt;
    Fit fit;
    for (const Json& row : j.at("correlation")) fit.correlation.push_back(numbersOf(row));
    for (const Json& figure : j.at("figures"))
        fit.figures.push_back({numberOf(figure.at("mean")), numberOf(figure.at("deviation"))});
    fit.sampled = j.at("sampled").get<std::size_t>();
    fit.steps = j.at("steps").get<int>();
    fit.acceptance = numberOf(j.at("acceptance"));
    fit.rHat = numberOf(j.at("r_hat"));
    fit.effective = numberOf(j.at("effective"));
    return fit;
}

/// Throws CaseError if there is no such file, or a column or a number is missing.
std::vector<Parameters> readDraws(const fs::path& file, const std::vector<Parameter>& parameters) {
    const Table table = Table::read(file);
    std::vector<Parameters> draws(table.rows());
    for (std::size_t i = 0; i < draws.size(); ++i)
        for (const Parameter& p : parameters) {
            draws[i].push_back(table.number(i, p.key));
            if (!std::isfinite(draws[i].back()))
                table.refuse(i, p.key, "is no finite number", "run vkdose calibrate again to write the file");
        }
    return draws;
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
    const bool grid = f.points.empty() && f.parameters.empty() && !f.fit;
    const auto square = [&](const Fit& fit) {
        return fit.figures.size() == targets && fit.correlation.size() == parameters &&
               std::all_of(fit.correlation.begin(), fit.correlation.end(),
                           [&](const std::vector<double>& row) { return row.size() == parameters; });
    };
    return targets > 0 && (grid || (f.best < f.points.size() && f.fit && square(*f.fit))) &&
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
    f.fit = readFit(j.at("fit"));
    f.confirmingSeeds = j.at("confirming_seeds").get<std::vector<std::uint64_t>>();
    for (const Json& c : j.at("confirmations")) f.confirmations.push_back(readConfirmation(c));
    f.met = j.at("met").get<bool>();
    return f;
}

}  // namespace

Json findingJson(const CalibrationFinding& finding) {
    Json j{{"met", finding.met}, {"misfit", jsonNumber(finding.misfit)}};
    for (const char* list : {"targets", "parameters", "points"}) j[list] = Json::array();
    for (const Target& t : finding.targets) j["targets"].push_back(targetJson(t));
    for (const Parameter& p : finding.parameters) j["parameters"].push_back(parameterJson(p));
    for (const Point& p : finding.points) j["points"].push_back(pointJson(p));
    j["best"] = finding.best;
    j["fit"] = fitJson(finding);
    j["confirming_seeds"] = finding.confirmingSeeds;
    j["confirmations"] = Json::array();
    for (const auto& c : finding.confirmations) j["confirmations"].push_back(confirmationJson(c));
    return j;
}

std::string drawsText(const CalibrationFinding& f) {
    Row head;
    for (const Parameter& p : f.parameters) head.push_back(p.key);
    std::string text = csvLine(head) + "\n";
    for (const Parameters& draw : f.fit->draws) {
        Row row;
        for (const double x : draw) row.push_back(fmt::format("{}", x));
        text += csvLine(row) + "\n";
    }
    return text;
}

void writeFinding(const fs::path& folder, const CalibrationFinding& finding) {
    // The draws first: a folder with calibration.json has them.
    if (finding.fit) replaceFile(folder / kDrawsName, drawsText(finding));
    writeFindingFile(folder / kFindingName, findingJson(finding));
}

void forgetFinding(const fs::path& folder) {
    removeFindings({folder / kFindingName, folder / kDrawsName});
}

std::optional<CalibrationFinding> readFinding(const fs::path& folder) {
    std::optional<CalibrationFinding> found;
    const auto whole = [&](const Json& j) { return isWhole(found.emplace(findingIn(j))); };
    if (readFindingFile(folder / kFindingName, whole, "the finding of a calibration", "vkdose calibrate").is_null())
        return std::nullopt;
    if (found->fit) found->fit->draws = readDraws(folder / kDrawsName, found->parameters);
    return found;
}

}  // namespace vkdose
