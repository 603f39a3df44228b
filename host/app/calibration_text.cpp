#include "host/app/calibration_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "host/app/text.h"
#include "host/core/printable.h"

namespace vkdose {

namespace {

constexpr double kAgreed = 1.05;  // R-hat of samples that agree

std::string pointText(const std::vector<std::string>& keys, const Row& values) {
    std::string text;
    for (std::size_t i = 0; i < keys.size(); ++i)
        text += fmt::format("{}{} {}", i == 0 ? "" : ", ", keys[i], values[i]);
    return text.empty() ? "all" : text;
}

std::string curveText(const std::string& name, const Curve& curve, const CalibrationAim& aim, bool chosen) {
    std::string text = name + "\n";
    for (const CurvePoint& p : curve.points)
        text += fmt::format("    {} {:<8.4g} beta {:<18} g   RSD {:<16} %   {}\n", aim.along, p.along,
                            withError(p.beta, p.betaError, 1e3), withError(p.rsd, p.rsdError, 100),
                            counted(p.seeds, "seed"));
    for (const Crossing& c : curve.crossings)
        text +=
            fmt::format("  {} {} {}, RSD {} %{}\n",
                        c.off == 0 ? "crosses the target at"
                                   : fmt::format("is {:.2g} g off the target, within the tolerance, at", c.off * 1e3),
                        aim.along, withError(c.along, c.alongError), withError(c.rsd, c.rsdError, 100),
                        chosen && &c == &curve.crossings.front() ? "   <- chosen" : "");
    if (curve.crossings.empty()) text += "  does not come to the target\n";
    return text;
}

std::string inUnit(const CalibrationFinding::Target& t) {
    return t.unit.empty() ? "" : " " + t.unit;
}

/// "beta 0.0764 +- 0.0041 g"
std::string figureText(const CalibrationFinding::Target& t, double value, double error) {
    return fmt::format("{} {}{}", printable(t.name), withError(value, error), inUnit(t));
}

std::string pointsText(const CalibrationFinding& f) {
    std::string text;
    for (std::size_t i = 0; i < f.points.size(); ++i) {
        for (std::size_t k = 0; k < f.parameters.size(); ++k)
            text += fmt::format("    {} {:<10.6g}", f.parameters[k].key, f.points[i].at[k]);
        for (std::size_t g = 0; g < f.targets.size(); ++g)
            text += " " + figureText(f.targets[g], f.points[i].values[g].value, f.points[i].values[g].error);
        text += fmt::format("{}\n", i == f.best ? "   <- chosen" : "");
    }
    return text;
}

/// Which target constrains which parameter.
std::string sensitivityText(const CalibrationFinding& f) {
    std::string text = "change from bound to bound by the slope there, in uncertainties of the target:\n";
    for (const CalibrationFinding::Parameter& p : f.parameters) {
        std::string line;
        for (std::size_t g = 0; g < f.targets.size(); ++g)
            line += fmt::format("{}{} {:+.3g}", g > 0 ? ", " : "", printable(f.targets[g].name), p.change[g]);
        text += fmt::format("    {}: {}\n", p.key, line);
    }
    return text;
}

/// How well a surrogate predicts points that it has not seen, and how well it knows that.
std::string leaveOneOutText(const CalibrationFinding::Target& t, const std::string& cure) {
    const LeaveOneOut& l = t.leaveOneOut;
    std::string text = fmt::format(
        "    {} of {} off by {:.2g}{}, {:.2g} times what is expected, at most {:.2g} times; predictive R2 {:.2g}\n",
        printable(t.name), counted(l.points, "point"), l.error, inUnit(t), l.standardised, l.largest, l.predictiveR2);
    switch (l.verdict()) {
        case LeaveOneOut::Verdict::Overconfident:
            return text +
                   fmt::format(
                       "    warning: the surrogate is surer than it may be, so the intervals are too narrow{}\n", cure);
        case LeaveOneOut::Verdict::Blind:
            return text + fmt::format(
                              "    warning: the surrogate predicts little: the points are too few, or the parameters "
                              "hardly move this figure{}\n",
                              cure);
        case LeaveOneOut::Verdict::Cautious:
            return text + "    the surrogate is less sure than it may be, so the intervals are wider than need be\n";
        default:
            return text;
    }
}

/// "contact.friction 0.31, 95 % from 0.25 to 0.38, mostly by heap.angle_deg"
std::string parameterText(const CalibrationFinding& f, std::size_t k) {
    const CalibrationFinding::Parameter& p = f.parameters[k];
    std::string with;
    for (const Compensation& c : compensations(f))
        if (c.first == k || c.second == k)
            with += (with.empty() ? "" : " and ") + f.parameters[c.first == k ? c.second : c.first].key;
    return fmt::format("    {} {:.4g}, 95 % from {:.4g} to {:.4g}, {}\n", p.key, p.fits.median, p.fits.low, p.fits.high,
                       !with.empty()     ? "only together with " + with
                       : p.constrained() ? "mostly by " + printable(f.targets[p.mostlyBy].name)
                                         : "the targets do not constrain it within its bounds");
}

/// The correlation of each two parameters, and of which two only a combination is known.
std::string correlationText(const CalibrationFinding& f) {
    std::string text;
    for (std::size_t i = 1; i < f.parameters.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            text += fmt::format("    correlation of {} and {} {:+.2f}\n", f.parameters[j].key, f.parameters[i].key,
                                f.fit->correlation[i][j]);
    for (const Compensation& c : compensations(f))
        text += fmt::format("    {} and {} compensate: only their combination is known\n", f.parameters[c.first].key,
                            f.parameters[c.second].key);
    return text;
}

/// "heap.angle_deg 43.8 +- 0.6 for 48 +- 3"
std::string confirmedText(const CalibrationFinding::Target& t, const Confirmed& c) {
    return fmt::format("{} for {}{}", figureText(t, c.found.value, c.found.error), withError(t.value, t.uncertainty),
                       inUnit(t));
}

}  // namespace

std::string withError(double value, double error, double scale) {
    if (!std::isfinite(value)) return "?";
    const std::string by = std::isfinite(error) ? fmt::format("{:.2g}", error * scale) : "?";
    return fmt::format("{:.4g} +- {}", value * scale, by);
}

std::string targetsText(const CalibrationAim& aim, const CalibrationFinding& f) {
    if (aim.targets.empty()) return fmt::format("target   {} g a dose\n", withError(aim.target, aim.tolerance, 1e3));
    std::string text;
    for (std::size_t g = 0; g < f.targets.size(); ++g)
        text += fmt::format("target   {} {}, weight {:.4g}, by {}\n", printable(f.targets[g].name),
                            withError(f.targets[g].value, f.targets[g].uncertainty), f.targets[g].weight,
                            printable(aim.targets[g].base.string()));
    return text;
}

std::string gridText(const GridCalibration& grid, const CalibrationAim& aim) {
    std::string text;
    for (std::size_t i = 0; i < grid.curves.size(); ++i)
        text += curveText(pointText(grid.keys, grid.curves[i].values), grid.curves[i], aim, grid.choice == i);
    if (grid.leftOut > 0)
        text += fmt::format("left out: {} without a mass per dose\n", counted(std::size_t(grid.leftOut), "member"));
    return text;
}

std::string searchText(const CalibrationFinding& f) {
    std::string believed;
    for (const CalibrationFinding::Target& t : f.targets)
        believed += (believed.empty() ? "" : ", ") + figureText(t, t.believed, t.deviation);
    std::string text =
        pointsText(f) + fmt::format("believed there, after {}: {}\n", counted(f.points.size(), "point"), believed);
    if (f.targets.size() > 1)
        text += fmt::format("misfit {:.3g}, the weighted sum of squares over uncertainties\n", f.misfit);
    return text + sensitivityText(f);
}

std::string fitText(const CalibrationFinding& f, const std::string& cure) {
    std::string text = "each point predicted from the others:\n";
    for (const CalibrationFinding::Target& t : f.targets) text += leaveOneOutText(t, cure);
    text +=
        fmt::format("the parameters that fit, by {} points of their distribution (R-hat {:.3f}, {:.0f} effective):\n",
                    f.fit->sampled, f.fit->rHat, f.fit->effective);
    for (std::size_t k = 0; k < f.parameters.size(); ++k) text += parameterText(f, k);
    if (f.parameters.size() > 1) text += correlationText(f);
    for (std::size_t g = 0; g < f.targets.size(); ++g)
        text += fmt::format(
            "    there {} for {}{}{}\n", figureText(f.targets[g], f.fit->figures[g].mean, f.fit->figures[g].deviation),
            withError(f.targets[g].value, f.targets[g].uncertainty), inUnit(f.targets[g]),
            isReached(f, g) ? "" : ": by the surrogates no values within the bounds give it, or not with the others");
    if (!(f.fit->rHat < kAgreed))
        text += "    warning: the samples do not agree (R-hat is far from 1), so the intervals are rough\n";
    return text;
}

std::string confirmationText(const CalibrationFinding& f) {
    const bool one = f.targets.size() == 1;
    const char* targets = one ? "the target" : "the targets";
    std::string text;
    if (f.confirmations.empty())
        text += fmt::format("no point is believed to meet {}, so none was confirmed\n", targets);
    else
        text += fmt::format("confirming {} with new seeds ({}):\n", counted(f.confirmingSeeds.size(), "run"),
                            fmt::join(f.confirmingSeeds, ", "));
    for (const CalibrationFinding::Confirmation& c : f.confirmations) {
        text += fmt::format("    {}\n", printable(c.at));
        for (std::size_t g = 0; g < f.targets.size(); ++g) {
            text += fmt::format("        {}: {}", confirmedText(f.targets[g], c.figures[g]),
                                verdictText(c.figures[g].verdict));
            if (c.figures[g].verdict == Confirmed::Verdict::Incomplete)
                text += fmt::format(", {} of {} have the figure", c.figures[g].runs,
                                    counted(f.confirmingSeeds.size(), "run"));
            text += "\n";
        }
    }
    return text + fmt::format("{} {} {}\n", targets, one ? "is" : "are", f.met ? "met" : "NOT met");
}

std::string reasonText(const CalibrationFinding& f) {
    std::string figures;
    for (std::size_t g = 0; g < f.targets.size(); ++g)
        figures += (g == 0 ? "" : ", ") + confirmedText(f.targets[g], f.confirmations.back().figures[g]);
    return fmt::format("{} with new seeds give {}", counted(f.confirmingSeeds.size(), "run"), figures);
}

}  // namespace vkdose
