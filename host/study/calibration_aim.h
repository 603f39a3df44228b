#pragma once
// The aim of a calibration, the table [calibrate] of a study, or of a design, its table [design].

#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace vkdose {

class CaseReader;
class Section;

/// A free parameter of the surrogate search: a key of the base case with a number for a value.
struct FreeParameter {
    std::string key;
    double low = 0;   ///< in the unit of the key
    double high = 0;  ///< in the unit of the key
};

/// A figure that a search is to meet or to better, in the figure's own unit.
struct CalibrationTarget {
    enum class Wish { None, Largest, Smallest };
    std::string figure;  ///< one of figureNames (trials.h): "heap.angle_deg"
    double value = 0;    ///< measured
    double uncertainty = 0;
    double weight = 1;           ///< of its square in the misfit
    std::filesystem::path base;  ///< the case whose run gives it
    int line = 0;                ///< of the study's file, for messages
    /// Of a design, in place of value, uncertainty and weight: what is wished of it, and the bounds that it must keep.
    Wish wish = Wish::None;
    double atLeast = -std::numeric_limits<double>::infinity(), atMost = std::numeric_limits<double>::infinity();
};
inline constexpr const char* kMassPerDose = "mass_per_dose_g";
inline constexpr std::size_t kMostTargets = 8;

struct CalibrationAim {
    /// Grid: finds where the interpolated mass per dose of a sweep meets the target. Surrogate: searches point after
    /// point. Design: likewise, for the front between what is wished of several figures.
    enum class Method { Grid, Surrogate, Design };
    Method method = Method::Grid;
    double target = 0;                      ///< mass per dose [kg]
    double tolerance = 0;                   ///< what a match may be off by; as the target's standard error [kg]
    std::filesystem::path measured;         ///< file of a balance's readings, if the target comes from one
    int confirmingSeeds = 3;                ///< new seeds with which the chosen point runs before a target is met
    std::string along;                      ///< Grid: the key that is interpolated
    int maxRuns = 0;                        ///< of a search: points at most, each with every seed
    int firstPoints = 0;                    ///< of a search: with which it begins; 0: two for each parameter, and one
    std::vector<FreeParameter> parameters;  ///< of a search
    /// Surrogate: what is to be met together, in place of `target`. Empty: the mass per dose alone. Design: the goals.
    std::vector<CalibrationTarget> targets;

    /// Whether its points follow from the results of those before.
    bool searches() const { return method != Method::Grid; }
    /// The name of its table in the study.
    const char* table() const { return method == Method::Design ? "design" : "calibrate"; }
    /// The figure of a target, with its case where targets of several cases have the same figure: "heap.angle_deg of
    /// wet.toml".
    std::string nameOf(const CalibrationTarget& of) const;
    /// The different cases of the targets, each once, in their order. Empty without targets.
    std::vector<std::filesystem::path> bases() const;
};

/// Reads the table, noting faults in `reader`. A measured file is read too; its path, and those of the targets' cases,
/// are relative to `folder`. `base` is the case of targets that name none.
CalibrationAim readCalibrationAim(CaseReader& reader, Section& table, const std::filesystem::path& folder,
                                  const std::filesystem::path& base);

/// The same for the table [design].
CalibrationAim readDesignAim(CaseReader& reader, Section& table, const std::filesystem::path& folder,
                             const std::filesystem::path& base);

}  // namespace vkdose
