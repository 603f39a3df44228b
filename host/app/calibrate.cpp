#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/app/interrupt.h"
#include "host/app/search_runs.h"
#include "host/app/sweep_display.h"
#include "host/app/sweep_setup.h"
#include "host/app/tell.h"
#include "host/app/text.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/printable.h"
#include "host/model/closest_word.h"
#include "host/output/measured.h"
#include "host/output/run_folder.h"
#include "host/study/calibration_finding.h"
#include "host/study/grid_calibration.h"

namespace vkdose {

namespace {

/// "0.872 +- 0.031"; a "?" where the error is not known, or the value itself.
std::string withError(double value, double error, double scale = 1) {
    if (!std::isfinite(value)) return "?";
    const std::string by = std::isfinite(error) ? fmt::format("{:.2g}", error * scale) : "?";
    return fmt::format("{:.4g} +- {}", value * scale, by);
}

std::string targetText(const CalibrationAim& aim) {
    return fmt::format("target   {} g a dose", withError(aim.target, aim.tolerance, 1e3));
}

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
                        c.off == 0 ? "meets the target at"
                                   : fmt::format("is {:.2g} g off the target, within the tolerance, at", c.off * 1e3),
                        aim.along, withError(c.along, c.alongError), withError(c.rsd, c.rsdError, 100),
                        chosen && &c == &curve.crossings.front() ? "   <- chosen" : "");
    if (curve.crossings.empty()) text += "  does not meet the target\n";
    return text;
}

/// The values of a curve's keys as the study has them.
std::vector<Setting> settingsOf(const Study& study, const std::vector<std::string>& keys, const Row& values) {
    std::vector<Setting> settings;
    for (const Axis& axis : study.axes)
        for (std::size_t k = 0; k < axis.keys.size(); ++k)
            for (std::size_t i = 0; i < keys.size(); ++i)
                if (axis.keys[k] == keys[i]) {
                    const auto point = std::find_if(axis.points.begin(), axis.points.end(),
                                                    [&](const auto& p) { return tableText(p[k]) == values[i]; });
                    if (point != axis.points.end()) settings.push_back({keys[i], (*point)[k]});
                }
    return settings;
}

void writeCase(const Study& study, const SweepFolder& folder, const std::vector<Setting>& point,
               const std::string& how) {
    const std::filesystem::path file = folder.path() / "calibrated.toml";
    const std::string reason = fmt::format("Calibrated by {}: {}", study.name, how);
    replaceFile(file, caseAt(study, point, study.file.stem().string() + "-calibrated", reason));
    tell("calibrated {}\nnext       vkdose run {}\n", printable(file.string()), shellWord(file.string()));
}

/// Takes away the case of an earlier target.
void forgetCase(const SweepFolder& folder) {
    std::error_code error;
    std::filesystem::remove(folder.path() / "calibrated.toml", error);
}

/// After the sweep: the table, and the case at the crossing that is chosen.
int reportGrid(const Study& study, const SweepFolder& folder) {
    const CalibrationAim& aim = *study.calibration;
    forgetCase(folder);
    const GridCalibration grid = calibrateGrid(folder.members(), study.keys(), aim);
    tell("{}\n", targetText(aim));
    for (std::size_t i = 0; i < grid.curves.size(); ++i)
        tell("{}", curveText(pointText(grid.keys, grid.curves[i].values), grid.curves[i], aim, grid.choice == i));
    if (grid.leftOut > 0) tell("left out: {} without a mass per dose\n", counted(grid.leftOut, "member"));
    if (!grid.choice) {
        tell(stderr, "vkdose: no curve meets the target or comes within {:.2g} g of it; widen the axes\n",
             aim.tolerance * 1e3);
        return kDisagree;
    }
    const Curve& curve = grid.curves[*grid.choice];
    const Crossing& crossing = curve.crossings.front();
    std::vector<Setting> point = settingsOf(study, grid.keys, curve.values);
    point.push_back(settingOf(study, aim.along, crossing.along));
    writeCase(study, folder, point,
              fmt::format("{} {} meets {:.4g} g a dose", aim.along, withError(crossing.along, crossing.alongError),
                          aim.target * 1e3));
    return kOk;
}

/// Refuses a target whose figure the run of its case will not have.
void checkFigures(const Study& study) {
    std::vector<Diagnostic> faults;
    for (const CalibrationTarget& t : study.calibration->targets) {
        const Case c = loadCase(t.base);
        std::vector<std::string> known{kMassPerDose};
        for (const ElementTest& m : c.measures)
            for (const std::string& figure : figureNames(m)) known.push_back(m.name + "." + figure);
        if (std::find(known.begin(), known.end(), t.figure) != known.end()) continue;
        const std::string meant = closestWord(t.figure, known);
        faults.push_back(
            {study.file.string(), t.line, "calibrate.target.figure", t.figure,
             fmt::format("{} has no such figure", t.base.string()),
             meant.empty() ? "give a figure of one of its [[measure]]" : fmt::format("did you mean \"{}\"?", meant)});
    }
    if (!faults.empty()) throw CaseError(faults);
}

/// Checks a search before it begins: each corner of its bounds must be a valid case. Throws CaseError if one is not.
void checkCorners(const Study& study) {
    checkFigures(study);
    const std::vector<FreeParameter>& free = study.calibration->parameters;
    for (const std::filesystem::path& base : basesOf(study))
        for (unsigned corner = 0; corner < 1U << free.size(); ++corner) {
            Parameters p;
            for (std::size_t i = 0; i < free.size(); ++i)
                p.push_back((corner >> i & 1U) != 0 ? free[i].high : free[i].low);
            (void)memberAt(study, 0, std::nullopt, settingsAt(study, p), base);
        }
}

std::string targetsText(const CalibrationAim& aim, const CalibrationFinding& f) {
    if (aim.targets.empty()) return targetText(aim) + "\n";
    std::string text;
    for (std::size_t g = 0; g < f.targets.size(); ++g)
        text += fmt::format("target   {} {}, weight {:.4g}, by {}\n", printable(f.targets[g].name),
                            withError(f.targets[g].value, f.targets[g].uncertainty), f.targets[g].weight,
                            printable(aim.targets[g].base.string()));
    return text;
}

/// "beta 0.0764 +- 0.0041 g"
std::string figureText(const CalibrationFinding::Target& t, double value, double error) {
    return fmt::format("{} {}{}{}", printable(t.name), withError(value, error), t.unit.empty() ? "" : " ", t.unit);
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

/// The figures that are believed at the chosen point.
std::string believedText(const CalibrationFinding& f) {
    std::string text;
    for (const CalibrationFinding::Target& t : f.targets)
        text += (text.empty() ? "" : ", ") + figureText(t, t.believed, t.deviation);
    return text;
}

/// Which target constrains which parameter, and how well all targets together know it.
std::string sensitivityText(const CalibrationFinding& f) {
    std::string text = "change from bound to bound by the slope there, in uncertainties of the target:\n";
    for (const CalibrationFinding::Parameter& p : f.parameters) {
        std::string line;
        for (std::size_t g = 0; g < f.targets.size(); ++g)
            line += fmt::format("{}{} {:+.3g}", g > 0 ? ", " : "", printable(f.targets[g].name), p.change[g]);
        text += fmt::format("    {}: {}; {}\n", p.key, line,
                            p.constrained ? fmt::format("known to +- {:.2g}, mostly by {}", p.error,
                                                        printable(f.targets[p.mostlyBy].name))
                                          : "the targets do not constrain it within its bounds");
    }
    return text;
}

/// The members that have ended so far, of a search that was interrupted.
SweepOutcome countedIn(const SweepFolder& folder) {
    SweepOutcome outcome;
    const Table& members = folder.members();
    for (std::size_t row = 0; row < members.rows(); ++row) {
        outcome.ok += members.text(row, "status") == statusText(MemberStatus::Ok) ? 1 : 0;
        outcome.failed += members.text(row, "status") == statusText(MemberStatus::Failed) ? 1 : 0;
    }
    return outcome;
}

int reportSearch(const Study& study, const SweepFolder& folder, const SearchResult& result) {
    const CalibrationAim& aim = *study.calibration;
    const CalibrationFinding f = findingOf(study, result);
    forgetCase(folder);
    writeFinding(folder.path(), f);
    tell("{}{}", targetsText(aim, f), pointsText(f));
    const std::string believed = believedText(f);
    const bool one = f.targets.size() == 1;
    tell("believed there: {}; {} {} after {} points\n", believed, one ? "the target is" : "the targets are",
         f.met ? "met"
         : one ? "NOT met to its tolerance"
               : "NOT met to their uncertainties",
         f.points.size());
    if (!one) tell("misfit {:.3g}, the weighted sum of squares over uncertainties\n", f.misfit);
    for (const CalibrationFinding::Parameter& p : f.parameters) {
        if (p.mayMeet)
            tell("{} from {:.4g} to {:.4g} may meet {}\n", p.key, p.mayMeet->first, p.mayMeet->second,
                 one ? "it" : "them");
        else
            tell("no {} within its bounds is believed to meet {}\n", p.key, one ? "it" : "them");
    }
    tell("{}", sensitivityText(f));
    if (!f.met) {
        tell(stderr,
             "vkdose: no case is written; give a larger max_runs, or in another folder other bounds or a wider {}\n",
             aim.targets.empty() ? "tolerance_g" : "uncertainty");
        return kDisagree;
    }
    std::string aims;
    for (const CalibrationFinding::Target& t : f.targets)
        aims += fmt::format("{}{:.4g}{}{}", aims.empty() ? "" : ", ", t.value, t.unit.empty() ? "" : " ", t.unit);
    writeCase(
        study, folder, settingsAt(study, result.points[result.best]),
        fmt::format("{}{} is believed there, the target is {}", believed, aim.targets.empty() ? " a dose" : "", aims));
    return kOk;
}

}  // namespace

int calibrateCommand(const SweepOptions& options) {
    const Study study = readStudy(options.study, options.overrides);
    if (!study.calibration)
        throw CaseError(
            {{options.study.string(), 0, "calibrate", "", "the table is missing",
              "add [calibrate] with target_g_per_dose and tolerance_g, with measured, or with [[calibrate.target]]"}});
    const bool isSearch = study.calibration->method == CalibrationAim::Method::Surrogate;
    if (isSearch) checkCorners(study);
    const std::vector<Member> members = !isSearch        ? membersOf(study)
                                        : options.dryRun ? std::vector<Member>{}
                                                         : SearchRuns::first(study);
    if (options.dryRun) {
        tell("{}", planText(options, study, members));
        return kOk;
    }
    const std::unique_ptr<MemberRunner> runner = makeRunner(options);
    const std::atomic<bool>& stop = watchInterrupts();
    SweepDisplay display("calibrate", study, options.quiet);
    SweepFolder folder(sweepFolder(options), study, members);
    if (isSearch) {
        SearchRuns runs(study, folder, *runner, display, stop, options.retryFailed);
        std::optional<SearchResult> result;
        try {
            result = search(*study.calibration, std::ref(runs));
        } catch (const FolderError&) {  // a later point was another one
            folder.keepFormerStudy();
            throw;
        }
        if (!result) {
            display.finish(folder, countedIn(folder));
            return kInterrupted;
        }
        folder.sort();
        return reportSearch(study, folder, *result);
    }
    display.begin(members, runner->manner());
    const SweepOutcome outcome = runMembers(folder, members, *runner, display, stop, options.retryFailed);
    if (outcome.whole) folder.sort();
    display.finish(folder, outcome);
    return outcome.whole ? reportGrid(study, folder) : kInterrupted;
}

}  // namespace vkdose
