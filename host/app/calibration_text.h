#pragma once
// The finding of a calibration as text on a terminal.

#include <string>

#include "host/study/calibration_finding.h"
#include "host/study/grid_calibration.h"

namespace vkdose {

/// "0.872 +- 0.031"; a "?" where the error is not known, or the value itself.
std::string withError(double value, double error, double scale = 1);

/// "target   0.075 +- 0.005 g a dose", or a line for each of several targets.
std::string targetsText(const CalibrationAim& aim, const CalibrationFinding& finding);

/// The curves of a grid with their points, and where they cross the target.
std::string gridText(const GridCalibration& grid, const CalibrationAim& aim);

/// The points of a search, what is believed at the chosen one, and how each parameter changes each target.
std::string searchText(const CalibrationFinding& finding);

/// Of a search: the errors of its surrogates, the values of each parameter that fit, and which of them compensate.
/// `cure` follows where too few points make a surrogate poor: "; give more first_points".
std::string fitText(const CalibrationFinding& finding, const std::string& cure);

/// The confirming runs, a line for each point, and the verdict.
std::string confirmationText(const CalibrationFinding& finding);

/// "3 runs with new seeds give beta 0.0764 +- 0.0041 g for 0.075 +- 0.005 g": of a finding that was met.
std::string reasonText(const CalibrationFinding& finding);

}  // namespace vkdose
