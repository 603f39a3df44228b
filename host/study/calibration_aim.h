#pragma once
// The aim of a calibration: the table [calibrate] of a study.

#include <filesystem>
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

struct CalibrationAim {
    /// Grid: finds where the interpolated mass per dose of a sweep meets the target. Surrogate: searches point after
    /// point.
    enum class Method { Grid, Surrogate };
    Method method = Method::Grid;
    double target = 0;                      ///< mass per dose [kg]
    double tolerance = 0;                   ///< what a match may be off by; as the target's standard error [kg]
    std::filesystem::path measured;         ///< file of a balance's readings, if the target comes from one
    std::string along;                      ///< Grid: the key that is interpolated
    int maxRuns = 0;                        ///< Surrogate: points at most, each with every seed
    std::vector<FreeParameter> parameters;  ///< Surrogate
};

/// Reads the table, noting faults in `reader`. A measured file is read too; its path is relative to `folder`.
CalibrationAim readCalibrationAim(CaseReader& reader, Section& table, const std::filesystem::path& folder);

}  // namespace vkdose
