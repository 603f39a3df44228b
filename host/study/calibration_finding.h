#pragma once
// The finding of a calibration, as people see it: `vkdose calibrate` prints it, the file calibration.json in the
// study's folder keeps it, and the report of the study shows it.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/study/study.h"
#include "host/study/surrogate.h"

namespace vkdose {

inline constexpr const char* kFindingName = "calibration.json";

struct CalibrationFinding {
    /// A target and what is believed of its figure at the chosen point, all in `unit`.
    struct Target {
        std::string name;  ///< the figure, with its case where targets of several cases have the same figure
        std::string unit;  ///< empty where the name of the figure tells it
        std::string base;  ///< name of the case file whose run gives the figure
        double value = 0, uncertainty = 0;
        double weight = 1;  ///< of its square in the misfit [-]
        double believed = 0, deviation = 0;
    };
    /// A free parameter, in the unit of its key.
    struct Parameter {
        std::string key;
        double low = 0, high = 0, chosen = 0;
        /// For each target its change from bound to bound, by the slope at the chosen point, in uncertainties of the
        /// target.
        std::vector<double> change;
        std::size_t mostlyBy = 0;                          ///< the target whose change is greatest
        double error = 0;                                  ///< to which all targets together know it
        bool constrained = true;                           ///< the error is no greater than the distance of the bounds
        std::optional<std::pair<double, double>> mayMeet;  ///< see SearchResult::compatible
    };
    struct Point {
        Parameters at;
        std::vector<Measured> values;  ///< of each target; NaN where there is none
    };
    /// What the runs with new seeds gave at a point, a figure for each target in its unit.
    struct Confirmation {
        std::string at;  ///< "contact.friction 0.3, contact.kc_over_k 0.25"
        std::vector<Confirmed> figures;
        bool met = false;
    };
    std::vector<Target> targets;
    std::vector<Parameter> parameters;  ///< of a search; none of a grid
    std::vector<Point> points;          ///< of a search all that were tried, in order; none of a grid
    std::size_t best = 0;               ///< index of the chosen point
    double misfit = 0;  ///< there, by the belief: sum over the targets of weight (distance / uncertainty)^2
    std::vector<std::uint64_t> confirmingSeeds;
    std::vector<Confirmation> confirmations;  ///< in order
    bool met = false;                         ///< the last confirmation says so
};

/// The values of the free parameters at a point of the search.
std::vector<Setting> settingsAt(const Study& study, const Parameters& point);

/// "contact.friction 0.3, contact.kc_over_k 0.25"
std::string placeText(const std::vector<Setting>& point);

/// The finding of the search of a study; its mass per dose is in g.
CalibrationFinding findingOf(const Study& study, const SearchResult& result,
                             const std::vector<std::uint64_t>& confirmingSeeds);

/// The finding of a grid whose chosen point is `point`. There the interpolated mass per dose is `believed` [kg], and
/// the confirming runs gave `confirmed` [kg].
CalibrationFinding findingOf(const Study& study, const std::vector<Setting>& point, double believed,
                             const Confirmed& confirmed, const std::vector<std::uint64_t>& confirmingSeeds);

/// The content of calibration.json; what is not known is null.
nlohmann::ordered_json findingJson(const CalibrationFinding& finding);

/// Writes calibration.json into the folder of a sweep. Throws OutputError.
void writeFinding(const std::filesystem::path& folder, const CalibrationFinding& finding);

/// Removes calibration.json: a search goes on in this folder and may find something else. Throws OutputError.
void forgetFinding(const std::filesystem::path& folder);

/// The finding that a folder holds; nothing without the file. Throws CaseError if the file is damaged.
std::optional<CalibrationFinding> readFinding(const std::filesystem::path& folder);

}  // namespace vkdose
