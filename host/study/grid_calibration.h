#pragma once
// The paper's calibration (section "calibration and sensitivity studies"): mass per dose against one parameter, with a
// curve for each value of the other parameters. The crossings of the curves with the measured mass per dose are the
// matches.

#include <optional>
#include <string>
#include <vector>

#include "host/core/csv_table.h"
#include "host/study/calibration_aim.h"

namespace vkdose {

/// A point of a curve: all seeds together. Its errors are the scatter from seed to seed, pooled over all points of the
/// sweep, over the root of the number of seeds. With a single seed they are the errors of its slope and of its standard
/// deviation (NaN if there are too few doses).
struct CurvePoint {
    double along = 0;      ///< value of the interpolated key
    double beta = 0;       ///< mass per dose, mean over the seeds [kg]
    double betaError = 0;  ///< standard error, see above [kg]
    double rsd = 0;        ///< from dose to dose, mean over the seeds [-]; NaN if a seed dosed nothing
    double rsdError = 0;   ///< likewise [-]
    int seeds = 0;
};

/// Where a curve meets the target: between two points by linear interpolation, or, if it crosses the target nowhere, at
/// its nearest point if that is within the tolerance.
struct Crossing {
    double along = 0;
    double alongError = 0;  ///< standard error, from those of the two points and the target; NaN if one is unknown
    double rsd = 0;
    double rsdError = 0;
    double off = 0;  ///< mass per dose there less the target; 0 where it is interpolated [kg]
};

struct Curve {
    Row values;  ///< of the other keys
    std::vector<CurvePoint> points;
    std::vector<Crossing> crossings;  ///< by rising `along`
};

struct GridCalibration {
    std::vector<std::string> keys;  ///< of Curve::values
    std::vector<Curve> curves;
    std::vector<std::vector<double>> betas;  ///< masses per dose of each point, one for each seed [kg]
    int leftOut = 0;                         ///< members that failed or have no mass per dose
    /// The curve whose lowest crossing is chosen. The paper chooses the parameters that match "and lead to the least
    /// variability between successive doses", and of those the lowest k_c. Here the candidates are the crossings whose
    /// RSD exceeds the least one by no more than the standard error of their difference. The lowest of them is chosen.
    std::optional<std::size_t> choice;
};

/// From the members of a sweep over `keys`, of which `aim.along` is one with numbers for values.
GridCalibration calibrateGrid(const Table& members, const std::vector<std::string>& keys, const CalibrationAim& aim);

}  // namespace vkdose
