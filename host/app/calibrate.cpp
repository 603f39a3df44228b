#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "host/analysis/cycles.h"
#include "host/analysis/mass_rate.h"
#include "host/app/calibration_text.h"
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
#include "host/study/seed_scatter.h"

namespace vkdose {

namespace {

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
               const CalibrationFinding& finding) {
    const std::filesystem::path file = folder.path() / "calibrated.toml";
    const std::string reason = fmt::format("Calibrated by {}: {}", study.name, reasonText(finding));
    replaceFile(file, caseAt(study, point, study.file.stem().string() + "-calibrated", reason));
    tell("calibrated {}\nnext       vkdose run {}\n", printable(file.string()), shellWord(file.string()));
}

/// Takes away the case of an earlier target.
void forgetCase(const SweepFolder& folder) {
    std::error_code error;
    std::filesystem::remove(folder.path() / "calibrated.toml", error);
}

/// Of a calibration that was halted: the members that have ended, and those that wait of the runs begun last.
SweepOutcome outcomeOf(const CalibrationRuns& parts) {
    SweepOutcome outcome = parts.last;
    const int left = outcome.members - outcome.ok - outcome.failed;
    outcome.ok = outcome.failed = 0;
    const Table& members = parts.folder.members();
    for (std::size_t row = 0; row < members.rows(); ++row) {
        outcome.ok += members.text(row, "status") == statusText(MemberStatus::Ok) ? 1 : 0;
        outcome.failed += members.text(row, "status") == statusText(MemberStatus::Failed) ? 1 : 0;
    }
    outcome.members = outcome.ok + outcome.failed + left;
    return outcome;
}

/// How a calibration ends that was halted.
int halted(CalibrationRuns& parts) {
    parts.display.finish(parts.folder, outcomeOf(parts), parts.options);
    return haltCode(parts.last.halt);
}

/// The point at which the chosen curve crosses the target: a value for each key of the study, in their order.
std::vector<Setting> crossingPoint(const Study& study, const GridCalibration& grid) {
    const Curve& curve = grid.curves[*grid.choice];
    std::vector<Setting> known = settingsOf(study, grid.keys, curve.values), point;
    known.push_back(settingOf(study, study.calibration->along, curve.crossings.front().along));
    for (const std::string& key : study.keys())
        for (const Setting& s : known)
            if (s.key == key) point.push_back(s);
    return point;
}

/// After the sweep: the table, the confirming runs of the crossing that is chosen, and the case there.
int finishGrid(CalibrationRuns& parts, const std::vector<Member>& members) {
    const Study& study = parts.study;
    const CalibrationAim& aim = *study.calibration;
    forgetCase(parts.folder);
    forgetFinding(parts.folder.path());
    const GridCalibration grid = calibrateGrid(parts.folder.members(), study.keys(), aim);
    tell("{}{}", targetsText(aim, {}), gridText(grid, aim));
    if (!grid.choice) {
        tell(stderr, "vkdose: no curve comes to the target or within {:.2g} g of it; widen the axes\n",
             aim.tolerance * 1e3);
        return kDisagree;
    }
    const std::vector<Setting> point = crossingPoint(study, grid);
    ConfirmingRuns confirming(parts, confirmingSeeds(study, members));
    const auto trials = confirming.at(point, parts.options.retryFailed);
    if (!trials) return halted(parts);
    std::vector<std::vector<double>> seeds = grid.betas;
    seeds.push_back(trials->front().values);
    const Confirmed confirmed =
        confirmedBy(seeds.back(), confirming.seeds().size(), scatterOfSeeds(seeds), aim.target, aim.tolerance);
    const double believed = aim.target + grid.curves[*grid.choice].crossings.front().off;
    const CalibrationFinding f = findingOf(study, point, believed, confirmed, confirming.seeds());
    writeFinding(parts.folder.path(), f);
    tell("{}", confirmationText(f));
    if (!f.met) {
        tell(stderr, "vkdose: no case is written; add points beside the chosen one, seeds or confirming_seeds\n");
        return kDisagree;
    }
    writeCase(study, parts.folder, point, f);
    return kOk;
}

/// Refuses a target whose figure the run of its case will not have.
void checkFigures(const Study& study) {
    std::vector<Diagnostic> faults;
    for (const CalibrationTarget& t : study.calibration->targets) {
        const Case c = loadCase(t.base);
        std::vector<std::string> known{kMassPerDose};
        for (const RateFigure& f : kRateFigures) known.push_back(std::string(kRateName) + "." + f.name);
        for (const CycleFigure& f : kCycleFigures) known.push_back(std::string(kCycleName) + "." + f.name);
        for (const ElementTest& m : c.measures)
            for (const std::string& figure : figureNames(m)) known.push_back(m.name + "." + figure);
        if (std::find(known.begin(), known.end(), t.figure) != known.end()) continue;
        const std::string meant = closestWord(t.figure, known);
        faults.push_back({study.file.string(), t.line, "calibrate.target.figure", t.figure,
                          fmt::format("{} has no such figure", t.base.string()),
                          meant.empty() ? "give a figure of one of its [[measure]], or of the mass rate"
                                        : fmt::format("did you mean \"{}\"?", meant)});
    }
    if (!faults.empty()) throw CaseError(faults);
}

/// Checks a search before it begins: each corner of its bounds must be a valid case. Throws CaseError if one is not.
std::vector<Member> cornersOf(const Study& study) {
    checkFigures(study);
    const std::vector<FreeParameter>& free = study.calibration->parameters;
    std::vector<Member> corners;
    for (const std::filesystem::path& base : basesOf(study))
        for (unsigned corner = 0; corner < 1U << free.size(); ++corner) {
            Parameters p;
            for (std::size_t i = 0; i < free.size(); ++i)
                p.push_back((corner >> i & 1U) != 0 ? free[i].high : free[i].low);
            corners.push_back(memberAt(study, 0, std::nullopt, settingsAt(study, p), base));
        }
    return corners;
}

/// The members that a calibration may need beyond those that it begins with. Each takes no longer than the longest of
/// `known`.
LaterMembers laterMembers(const Study& study, const std::vector<Member>& known) {
    const CalibrationAim& aim = *study.calibration;
    const std::size_t bases = basesOf(study).size(), confirming = std::size_t(aim.confirmingSeeds);
    const std::size_t seeds = std::max<std::size_t>(1, study.seeds.size());
    LaterMembers later;
    for (const Member& m : known) later.longest = std::max(later.longest, m.expectedWork);
    if (aim.method == CalibrationAim::Method::Surrogate) {
        // Each further point may be a confirmation that misses, and the last one is confirmed beyond their number.
        const std::size_t points = std::size_t(aim.maxRuns) - firstPoints(aim).size();
        later.most = bases * (points * std::max(seeds, confirming) + confirming);
        later.atOnce = int(bases * std::min(seeds, confirming));
        later.what = fmt::format("at {} and in confirming runs", counted(points, "more point"));
    } else {
        later.most = confirming;
        later.atOnce = int(confirming);
        later.what = "in confirming runs";
    }
    later.work = double(later.most) * later.longest;
    return later;
}

int reportSearch(const CalibrationRuns& parts, const SearchResult& result, const std::vector<std::uint64_t>& seeds) {
    const CalibrationAim& aim = *parts.study.calibration;
    const CalibrationFinding f = findingOf(parts.study, result, seeds);
    forgetCase(parts.folder);
    writeFinding(parts.folder.path(), f);
    tell("{}{}{}", targetsText(aim, f), searchText(f), confirmationText(f));
    if (!f.met) {
        tell(stderr,
             "vkdose: no case is written; give a larger max_runs, or in another folder other bounds, more "
             "confirming_seeds or a wider {}\n",
             aim.targets.empty() ? "tolerance_g" : "uncertainty");
        return kDisagree;
    }
    writeCase(parts.study, parts.folder, settingsAt(parts.study, result.points[result.best]), f);
    return kOk;
}

int runSearch(CalibrationRuns& parts, const std::vector<Member>& first) {
    SearchRuns runs(parts);
    ConfirmingRuns confirming(parts, confirmingSeeds(parts.study, first));
    std::optional<SearchResult> result;
    try {
        result = search(*parts.study.calibration, std::ref(runs), [&](const Parameters& point) {
            return confirming.at(settingsAt(parts.study, point), parts.options.retryFailed && !runs.goesOn());
        });
    } catch (const FolderError&) {  // a later point was another one
        parts.folder.keepFormerStudy();
        throw;
    }
    if (!result) return halted(parts);
    parts.folder.sort();
    return reportSearch(parts, *result, confirming.seeds());
}

int runGrid(CalibrationRuns& parts, const std::vector<Member>& members) {
    parts.display.begin(members, parts.runner.manner());
    const SweepOutcome outcome =
        runMembers(parts.folder, members, parts.runner, parts.display, parts.halt, parts.options.retryFailed);
    if (outcome.whole) parts.folder.sort();
    parts.display.finish(parts.folder, outcome, parts.options);
    return outcome.whole ? finishGrid(parts, members) : haltCode(outcome.halt);
}

}  // namespace

int calibrateCommand(const SweepOptions& options) {
    const Study study = readStudy(options.study, options.overrides);
    if (!study.calibration)
        throw CaseError(
            {{options.study.string(), 0, "calibrate", "", "the table is missing",
              "add [calibrate] with target_g_per_dose and tolerance_g, with measured, or with [[calibrate.target]]"}});
    const bool isSearch = study.calibration->method == CalibrationAim::Method::Surrogate;
    std::vector<Member> known = isSearch ? cornersOf(study) : std::vector<Member>();
    const std::vector<Member> members = isSearch ? SearchRuns::first(study) : membersOf(study);
    if (options.dryRun) {
        known.insert(known.end(), members.begin(), members.end());
        tell("{}", planText(options, study, members, laterMembers(study, known)));
        return kOk;
    }
    const std::unique_ptr<MemberRunner> runner = makeRunner(options);
    const HaltRule halt = haltRule(watchInterrupts(), options.limit);
    SweepDisplay display("calibrate", study, options.quiet);
    const std::filesystem::path out = sweepFolder(options);
    SweepFolder::requireUsable(confirmingFolder(out), study);
    SweepFolder folder(out, study, members, isSearch ? SweepFolder::Manner::Open : SweepFolder::Manner::Whole);
    CalibrationRuns parts{study, folder, *runner, display, halt, options};
    return isSearch ? runSearch(parts, members) : runGrid(parts, members);
}

}  // namespace vkdose
