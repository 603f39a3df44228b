#include "host/study/calibration_finding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/study/member.h"

namespace vkdose {

namespace {

using Target = CalibrationFinding::Target;
using Parameter = CalibrationFinding::Parameter;
using Point = CalibrationFinding::Point;

using Fit = CalibrationFinding::Fit;

constexpr double kGrams = 1e3;  // a search for the mass per dose alone is in kg
constexpr double kMuch = 0.7;   // a correlation that halves the variance that is left when the other one is known

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

Parameter parameterOf(const FreeParameter& free, const SearchResult& result, const Posterior& posterior,
                      std::size_t k) {
    Parameter p{free.key, free.low, free.high, result.points[result.best][k], {}, 0, posterior.parameters[k]};
    for (const GoalResult& goal : result.goals) p.change.push_back(goal.sensitivity[k]);
    const auto weaker = [](double a, double b) { return std::abs(a) < std::abs(b); };
    p.mostlyBy = std::size_t(std::max_element(p.change.begin(), p.change.end(), weaker) - p.change.begin());
    return p;
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

std::vector<Compensation> compensations(const CalibrationFinding& f) {
    std::vector<Compensation> all;
    for (std::size_t i = 0; f.fit && i < f.parameters.size(); ++i)
        for (std::size_t j = i + 1; j < f.parameters.size(); ++j)
            if (std::abs(f.fit->correlation[i][j]) > kMuch) all.push_back({i, j, f.fit->correlation[i][j]});
    return all;
}

bool isReached(const CalibrationFinding& f, std::size_t target) {
    const Belief& figure = f.fit->figures[target];
    const Target& t = f.targets[target];
    return std::abs(figure.mean - t.value) <= 2 * std::hypot(t.uncertainty, figure.deviation);
}

std::string verdictText(LeaveOneOut::Verdict verdict) {
    switch (verdict) {
        case LeaveOneOut::Verdict::Overconfident:
            return "overconfident";
        case LeaveOneOut::Verdict::Cautious:
            return "cautious";
        case LeaveOneOut::Verdict::Blind:
            return "blind";
        default:
            return "honest";
    }
}

CalibrationFinding findingOf(const Study& study, const SearchResult& result, const Posterior& posterior,
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
        f.targets[g].leaveOneOut = result.goals[g].leaveOneOut;
        f.targets[g].leaveOneOut.error *= scale;
    }
    for (std::size_t k = 0; k < aim.parameters.size(); ++k)
        f.parameters.push_back(parameterOf(aim.parameters[k], result, posterior, k));
    f.fit = Fit{posterior.correlation, posterior.figures,    posterior.draws, posterior.sampled,
                posterior.steps,       posterior.acceptance, posterior.rHat,  posterior.effective};
    for (Belief& figure : f.fit->figures) figure = {figure.mean * scale, figure.deviation * scale};
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

}  // namespace vkdose
