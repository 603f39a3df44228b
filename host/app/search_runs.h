#pragma once
// The points of a search, run as the members of a sweep, and the confirming runs of any calibration or design.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "host/app/commands.h"
#include "host/app/sweep_display.h"
#include "host/output/run_folder.h"
#include "host/study/calibration_finding.h"
#include "host/study/sweep.h"
#include "host/study/trials.h"

namespace vkdose {

/// The parts that the runs of a calibration or a design share.
struct CalibrationRuns {
    const Study& study;
    SweepFolder& folder;  ///< of the sweep or the search
    MemberRunner& runner;
    SweepDisplay& display;
    const HaltRule& halt;
    const SweepOptions& options;
    SweepOutcome last = {};  ///< of the runs that were begun last
};

/// Checks a search before it begins: its figures must be those of its cases, and each corner of its bounds must be a
/// valid case. Throws CaseError if one is not.
std::vector<Member> cornersOf(const Study& study);

/// Tells how far a calibration or a design came that was halted, and gives the exit code.
int halted(CalibrationRuns& parts);

/// The seeds of the confirming runs, none of which a member of the study has.
std::vector<std::uint64_t> confirmingSeeds(const Study& study, const std::vector<Member>& members);

/// The folder of the confirming runs in that of the study.
std::filesystem::path confirmingFolder(const std::filesystem::path& folder);

/// Runs the points that a search asks for as members of a sweep, every one with every case and every seed.
class SearchRuns {
  public:
    explicit SearchRuns(CalibrationRuns& parts) : p_(parts) {}

    /// Throws FolderError if a point has begun in the folder as another one. Returns nothing if it was halted.
    std::optional<std::vector<Trials>> operator()(const std::vector<Parameters>& points);

    /// Whether a point has begun that follows from those so far. Then a failed member may not run again, because that
    /// would lead to other points.
    bool goesOn() const;

    /// The members of the points that every search of this study begins with.
    static std::vector<Member> first(const Study& study);

  private:
    CalibrationRuns& p_;
    int next_ = 0;
};

/// Runs chosen points again, every one with every case and with new seeds. Its members lie in a sweep folder of their
/// own, so that they are in no table of the study. Those of a point that was confirmed before are found again.
class ConfirmingRuns {
  public:
    ConfirmingRuns(CalibrationRuns& parts, std::vector<std::uint64_t> seeds) : p_(parts), seeds_(std::move(seeds)) {}

    const std::vector<std::uint64_t>& seeds() const { return seeds_; }

    /// `point` has a value for each key of the study, in their order. With `retry` failed members run again. Returns
    /// nothing if it was halted.
    std::optional<Trials> at(const std::vector<Setting>& point, bool retry);

  private:
    CalibrationRuns& p_;
    std::vector<std::uint64_t> seeds_;
    std::optional<SweepFolder> folder_;
};

/// Opens the folder of a calibration or a design that begins with these members, and plays it. Gives the exit code.
int withRuns(const SweepOptions& options, const Study& study, const std::vector<Member>& members,
             const std::function<int(CalibrationRuns&)>& play);

/// Plays a search that begins with the members `first`. `find(tryPoints, confirmPoint)` gives its result, nothing if it
/// was halted; `report(parts, result, confirmingSeeds)` tells it, and gives the exit code.
template <class Find, class Report>
int playSearch(CalibrationRuns& parts, const std::vector<Member>& first, const Find& find, const Report& report) {
    SearchRuns runs(parts);
    ConfirmingRuns confirming(parts, confirmingSeeds(parts.study, first));
    decltype(find(TryPoints(), ConfirmPoint())) result;
    try {
        result = find(std::ref(runs), [&](const Parameters& point) {
            return confirming.at(settingsAt(parts.study, point), parts.options.retryFailed && !runs.goesOn());
        });
    } catch (const FolderError&) {  // a later point was another one
        parts.folder.keepFormerStudy();
        throw;
    }
    if (!result) return halted(parts);
    parts.folder.sort();
    return report(parts, *result, confirming.seeds());
}

}  // namespace vkdose
