#include "host/app/search_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "host/app/exit_code.h"
#include "host/app/interrupt.h"
#include "host/app/sweep_setup.h"
#include "host/app/tell.h"
#include "host/core/closest_word.h"
#include "host/core/error.h"
#include "host/study/calibration_file.h"
#include "host/study/calibration_finding.h"
#include "host/study/design_finding.h"

namespace vkdose {

namespace {

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

/// Runs members whose failures are left as they are unless `again`. Returns false if halted.
bool play(CalibrationRuns& p, SweepFolder& folder, const std::vector<Member>& members, bool again) {
    bool ended = true;
    for (const Member& m : members) {
        const auto status = folder.status(m.number);
        ended = ended && status.has_value();
        if (p.options.retryFailed && !again && status == MemberStatus::Failed)
            tell(stderr,
                 "vkdose: member {:04} failed and is left so, because later points of the search follow from it\n",
                 m.number);
    }
    if (!ended || again) {
        forgetFinding(p.folder.path());
        forgetDesign(p.folder.path());
    }
    p.last = runMembers(folder, members, p.runner, p.display, p.halt, again);
    return p.last.whole;
}

/// Refuses a target whose figure the run of its case will not have.
void checkFigures(const Study& study) {
    const CalibrationAim& aim = *study.calibration;
    const std::string figureKey =
        aim.method == CalibrationAim::Method::Design ? "design.goal.figure" : "calibrate.target.figure";
    std::vector<Diagnostic> faults;
    for (const CalibrationTarget& t : aim.targets) {
        const std::vector<std::string> known = figureNames(loadCase(t.base));
        if (std::find(known.begin(), known.end(), t.figure) != known.end()) continue;
        const std::string meant = closestWord(t.figure, known);
        faults.push_back({study.file.string(), t.line, figureKey, t.figure,
                          fmt::format("{} has no such figure", t.base.string()),
                          meant.empty() ? "give a figure of its doses, mass rate, cycles, [[measure]] or bodies"
                                        : fmt::format("did you mean \"{}\"?", meant)});
    }
    if (!faults.empty()) throw CaseError(faults);
}

/// Of a search that was halted: the members that have ended, and those that wait of the runs begun last.
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

}  // namespace

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

int halted(CalibrationRuns& parts) {
    parts.display.finish(parts.folder, outcomeOf(parts), parts.options);
    return haltCode(parts.last.halt);
}

int withRuns(const SweepOptions& options, const Study& study, const std::vector<Member>& members,
             const std::function<int(CalibrationRuns&)>& play) {
    const CalibrationAim& aim = *study.calibration;
    const std::unique_ptr<MemberRunner> runner = makeRunner(options);
    const HaltRule halt = haltRule(watchInterrupts(), options.limit);
    SweepDisplay display(aim.table(), study, options.quiet);
    const std::filesystem::path out = sweepFolder(options);
    SweepFolder::requireUsable(confirmingFolder(out), study);
    SweepFolder folder(out, study, members, aim.searches() ? SweepFolder::Manner::Open : SweepFolder::Manner::Whole);
    CalibrationRuns parts{study, folder, *runner, display, halt, options};
    return play(parts);
}

std::vector<std::uint64_t> confirmingSeeds(const Study& study, const std::vector<Member>& members) {
    std::vector<std::uint64_t> used;
    for (const Member& m : members) used.push_back(m.seed);
    return newSeeds(used, std::size_t(study.calibration->confirmingSeeds));
}

std::filesystem::path confirmingFolder(const std::filesystem::path& folder) {
    return folder / "confirm";
}

std::optional<std::vector<Trials>> SearchRuns::operator()(const std::vector<Parameters>& points) {
    const std::vector<Member> members = membersAt(p_.study, points, next_);
    for (const Member& m : members) p_.folder.requireSame(m);
    if (!play(p_, p_.folder, members, p_.options.retryFailed && !goesOn())) return std::nullopt;
    const int seeds = int(seedsOf(p_.study).size()), each = seeds * int(basesOf(p_.study).size());
    std::vector<Trials> trials;
    for (std::size_t i = 0; i < points.size(); ++i)
        trials.push_back(trialsOf(p_.study, p_.folder, members[i * std::size_t(each)].number, seeds));
    return trials;
}

bool SearchRuns::goesOn() const {
    return std::filesystem::exists(p_.folder.memberFolder(next_));
}

std::vector<Member> SearchRuns::first(const Study& study) {
    int next = 0;
    return membersAt(study, firstPoints(*study.calibration), next);
}

std::optional<Trials> ConfirmingRuns::at(const std::vector<Setting>& point, bool retry) {
    std::vector<Member> members;
    for (const std::filesystem::path& base : basesOf(p_.study))
        for (const std::uint64_t seed : seeds_) members.push_back(memberAt(p_.study, 0, seed, point, base));
    if (!folder_)
        folder_.emplace(confirmingFolder(p_.folder.path()), p_.study, std::vector<Member>(), SweepFolder::Manner::Open);
    const auto begunAsThese = [&](int first) {
        for (std::size_t i = 0; i < members.size(); ++i) members[i].number = first + int(i);
        return std::all_of(members.begin(), members.end(), [&](const Member& m) { return folder_->isSame(m); });
    };
    for (int first = 0; !begunAsThese(first);) ++first;
    p_.display.confirm(placeText(point), members.size());
    if (!play(p_, *folder_, members, retry)) return std::nullopt;
    folder_->sort();
    return trialsOf(p_.study, *folder_, members.front().number, int(seeds_.size()));
}

}  // namespace vkdose
