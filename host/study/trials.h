#pragma once
// The figures that the members of a calibration gave for its targets.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host/model/case.h"
#include "host/study/surrogate.h"
#include "host/study/sweep_folder.h"

namespace vkdose {

/// The cases that every point of a calibration runs: those of its targets, or the study's base.
std::vector<std::filesystem::path> basesOf(const Study& study);

/// The names of the figures that a run of the case has, for targets and goals: the mass per dose, those of the doses,
/// of the mass rate and of the cycles, of each measure and of each body.
std::vector<std::string> figureNames(const Case& c);

/// The figures of a run that is over.
class RunFigures {
  public:
    /// Reads the summary in the run's folder. Without one, no figure has a value.
    explicit RunFigures(const std::filesystem::path& folder);

    /// A figure by its name, with its standard error; NaN where there is none.
    Measured at(const std::string& figure) const;

  private:
    nlohmann::ordered_json summary_;
};

/// The trials of one point: a figure for each target. Its members have the numbers from `first` on, all `seeds` of them
/// with the first of `basesOf`, then with the next. A member that failed has no figure.
Trials trialsOf(const Study& study, const SweepFolder& folder, int first, int seeds);

}  // namespace vkdose
