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

/// Takes two columns of the time series of the same length. `angle` [rad] is that of the coil at every line. The coil's
/// first turn conveys, no matter in which sense; a turn back counts as a turn too. `torque` [N m] is that of the drive,
/// mean since the line before. The first line begins the stretch, so its torque belongs to the time before and is not
/// used.
DriveWork driveWork(std::span<const double> angle, std::span<const double> torque);

}  // namespace vkdose
