#pragma once
// The turns and the work of the coil for the mass it doses.

#include <span>

namespace vkdose {

/// Turns and work of the drive over a stretch of the time series.
struct DriveWork {
    double turns = 0;
    double work = 0;  ///< torque times angle, positive when the powder resists [J]

    /// Mass [kg] per turn [kg], and per work of the drive [kg/J]; NaN if there was none.
    double massPerTurn(double mass) const;
    double massPerJoule(double mass) const;
};

/// From the time series: `angle` [rad] of the coil at every line, which turns in one sense only, whichever; `torque` [N
/// m] of the drive, mean since the line before. The first line begins the stretch: its torque belongs to what was
/// before. Both have the same length.
DriveWork driveWork(std::span<const double> angle, std::span<const double> torque);

}  // namespace vkdose
