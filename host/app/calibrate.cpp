#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

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
#include "host/output/run_folder.h"
#include "host/study/calibration_file.h"
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
    const Posterior posterior = posteriorOf(aim, goalsOf(aim), result.processes);
    const CalibrationFinding f = findingOf(parts.study, result, posterior, seeds);
    forgetCase(parts.folder);
    writeFinding(parts.folder.path(), f);
    const std::string draws = printable((parts.folder.path() / kDrawsName).string());
    tell("{}{}{}{}draws      {}, {} of the points that fit\n", targetsText(aim, f), searchText(f),
         fitText(f, "; give more first_points"), confirmationText(f), draws, f.fit->draws.size());
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
    return playSearch(
        parts, first,
        [&](const TryPoints& tryPoints, const ConfirmPoint& confirmPoint) {
            return search(*parts.study.calibration, tryPoints, confirmPoint);
        },
        reportSearch);
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
    if (!study.calibration || study.calibration->method == CalibrationAim::Method::Design)
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
    return withRuns(options, study, members, [&](CalibrationRuns& parts) {
        return isSearch ? runSearch(parts, members) : runGrid(parts, members);
    });
}

}  // namespace vkdose
