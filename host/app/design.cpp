#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/app/calibration_text.h"
#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/app/search_runs.h"
#include "host/app/sweep_display.h"
#include "host/app/sweep_setup.h"
#include "host/app/tell.h"
#include "host/app/text.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/printable.h"
#include "host/study/calibration_finding.h"
#include "host/study/design_finding.h"
#include "host/study/finding_file.h"

namespace vkdose {

namespace {

/// "rate.steady_kg_s 0.006 +- 0.0001, rate.steady_rsd 0.05 +- 0.01"
std::string figuresText(const CalibrationAim& aim, const std::vector<Measured>& figures) {
    std::string text;
    for (std::size_t g = 0; g < figures.size(); ++g)
        text += fmt::format("{}{} {}", g == 0 ? "" : ", ", printable(aim.nameOf(aim.targets[g])),
                            withError(figures[g].value, figures[g].error));
    return text;
}

std::string pointsText(const Study& study, const FrontResult& result) {
    std::string text;
    for (std::size_t i = 0; i < result.points.size(); ++i) {
        std::vector<Measured> figures;
        for (const std::vector<Measured>& of : result.values) figures.push_back(of[i]);
        text += fmt::format("    {}: {}\n", printable(placeText(settingsAt(study, result.points[i]))),
                            figuresText(*study.calibration, figures));
    }
    return text;
}

/// The points that were confirmed; those on the front with their cases.
std::string frontText(const Study& study, const FrontResult& result, const std::vector<std::uint64_t>& seeds,
                      const std::filesystem::path& folder) {
    std::string text =
        fmt::format("front, by {} with new seeds ({}):\n", counted(seeds.size(), "run"), fmt::join(seeds, ", "));
    std::size_t number = 0;
    for (const FrontPoint& p : result.front) {
        text += fmt::format("    {}\n        {}: {}\n", printable(placeText(settingsAt(study, result.points[p.point]))),
                            figuresText(*study.calibration, p.figures), verdictText(p.verdict));
        if (p.verdict == FrontPoint::Verdict::OnFront)
            text += fmt::format("        {}\n", printable(designCase(folder, ++number).string()));
    }
    return text;
}

/// Writes design.json, and a case for each point of the front.
int report(const CalibrationRuns& parts, const FrontResult& result, const std::vector<std::uint64_t>& seeds) {
    const Study& study = parts.study;
    const std::filesystem::path& folder = parts.folder.path();
    forgetDesign(folder);
    writeFindingFile(folder / kDesignName, designJson(study, result, seeds));
    std::string text;
    for (const CalibrationTarget& g : study.calibration->targets)
        text +=
            fmt::format("goal     {}, by {}\n", printable(goalText(*study.calibration, g)), printable(g.base.string()));
    text += pointsText(study, result);
    std::size_t number = 0;
    for (const FrontPoint& p : result.front) {
        if (p.verdict != FrontPoint::Verdict::OnFront) continue;
        ++number;
        const std::string reason =
            fmt::format("Designed by {}: {} with new seeds give {}", study.name, counted(seeds.size(), "run"),
                        figuresText(*study.calibration, p.figures));
        replaceFile(designCase(folder, number),
                    caseAt(study, settingsAt(study, result.points[p.point]),
                           fmt::format("{}-design-{}", study.file.stem().string(), number), reason));
    }
    if (!result.front.empty()) text += frontText(study, result, seeds, folder);
    tell("{}", text);
    if (number > 0) return kOk;
    tell(stderr, "vkdose: {}; give other bounds, a larger max_runs or more parameters\n",
         result.front.empty() ? "no point keeps the bounds of its goals"
                              : "no point keeps the bounds of its goals with new seeds");
    return kDisagree;
}

/// Those that a design may need beyond its first points. Each takes no longer than the longest of `known`.
LaterMembers laterMembers(const Study& study, const std::vector<Member>& known) {
    const CalibrationAim& aim = *study.calibration;
    const std::size_t bases = basesOf(study).size(), seeds = std::max<std::size_t>(1, study.seeds.size());
    const std::size_t points = std::size_t(aim.maxRuns) - firstPoints(aim).size();
    LaterMembers later;
    for (const Member& m : known) later.longest = std::max(later.longest, m.expectedWork);
    later.most = bases * (points * seeds + kMostOnFront * std::size_t(aim.confirmingSeeds));
    later.atOnce = int(bases * std::min(seeds, std::size_t(aim.confirmingSeeds)));
    later.what = fmt::format("at {} and in confirming runs of {}", counted(points, "more point"),
                             counted(kMostOnFront, "point"));
    later.work = double(later.most) * later.longest;
    return later;
}

}  // namespace

int designCommand(const SweepOptions& options) {
    const Study study = readStudy(options.study, options.overrides);
    if (!study.calibration || study.calibration->method != CalibrationAim::Method::Design)
        throw CaseError({{options.study.string(), 0, "design", "", "the table is missing",
                          "add [design] with [[design.goal]] and [[design.parameter]]"}});
    std::vector<Member> known = cornersOf(study);
    const std::vector<Member> members = SearchRuns::first(study);
    if (options.dryRun) {
        known.insert(known.end(), members.begin(), members.end());
        tell("{}", planText(options, study, members, laterMembers(study, known)));
        return kOk;
    }
    return withRuns(options, study, members, [&](CalibrationRuns& parts) {
        return playSearch(
            parts, members,
            [&](const TryPoints& tryPoints, const ConfirmPoint& confirmPoint) {
                return searchFront(*study.calibration, tryPoints, confirmPoint);
            },
            report);
    });
}

}  // namespace vkdose
