#pragma once
// Uniaxial compression of a bed by a piston, and its unloading.

#include <optional>
#include <vector>

namespace vkdose {

/// The piston at a line of the time series.
struct PistonSample {
    double gap = 0;    ///< between its face and the floor at that time [m]
    double force = 0;  ///< of the powder on it, away from the floor, mean since the line before [N]
};

struct Compression {
    double maxStress = 0;        ///< of the powder on the piston [Pa]
    double looseDensity = 0;     ///< before the stress first passes 1 % of the largest [kg/m3]
    double loadedDensity = 0;    ///< where the gap is smallest [kg/m3]
    double releasedDensity = 0;  ///< where the stress has fallen to 1 % of the largest again; NaN if it never does
    double recovery = 0;         ///< height gained from the smallest gap to there, over the smallest gap; NaN likewise
    double work = 0;             ///< of the piston on the powder until the gap is smallest [J]
    double returned = 0;         ///< of the powder on the piston from there on [J]
};

/// The bulk density is `mass` [kg] over cross-section `area` [m2] times gap. A force is a mean over a line, and belongs
/// to the middle of the piston's way in it; work is force times way, summed over the lines. Between two lines stress is
/// interpolated over the gap. None without three lines or a force that presses.
std::optional<Compression> compressionOf(const std::vector<PistonSample>& samples, double mass, double area);

}  // namespace vkdose
