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

/// Takes columns of the time series of the same length. `angle` [rad] is the coil's at every line; it turns in one
/// sense only, either one. `torque` [N m] is the drive's, mean since the line before. The first line begins the
/// stretch, so its torque is not used.
DriveWork driveWork(std::span<const double> angle, std::span<const double> torque);

}  // namespace vkdose
