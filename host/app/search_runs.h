#pragma once
// The points of a calibration's search, run as the members of a sweep.

#include <atomic>
#include <filesystem>
#include <optional>
#include <vector>

#include "host/study/surrogate.h"
#include "host/study/sweep.h"

namespace vkdose {

/// The values of the free parameters at a point of the search.
std::vector<Setting> settingsAt(const Study& study, const Parameters& point);
/// The cases that every point of a search runs.
std::vector<std::filesystem::path> basesOf(const Study& study);

/// Runs the points that a search asks for as members of a sweep, every one with every case and every seed.
class SearchRuns {
  public:
    SearchRuns(const Study& study, SweepFolder& folder, MemberRunner& runner, SweepObserver& observer,
               const std::atomic<bool>& stop, bool retryFailed);

    /// Throws FolderError if a point has begun in the folder as another one. Returns nothing if it was interrupted.
    std::optional<std::vector<Trials>> operator()(const std::vector<Parameters>& points);

    /// The members of the points that every search of this study begins with.
    static std::vector<Member> first(const Study& study);

  private:
    Trials trialsOf(int first) const;
    Trial figureOf(const std::string& figure, int from, int to) const;
    Trial massPerDoseOf(int from, int to) const;
    void tellFailed(const std::vector<Member>& members) const;

    const Study& study_;
    std::vector<std::filesystem::path> bases_;
    SweepFolder& folder_;
    MemberRunner& runner_;
    SweepObserver& observer_;
    const std::atomic<bool>& stop_;
    bool retry_;
    int next_ = 0;
};

}  // namespace vkdose
