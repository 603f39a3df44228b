#pragma once
// A shear cell, round or a ring: shear stress over normal stress, and the yield locus through it.

#include <optional>
#include <vector>

namespace vkdose {

/// The lid of the cell at a line of the time series.
struct LidSample {
    double time = 0;    ///< [s]
    double force = 0;   ///< of the powder on it, away from the powder, mean since the line before [N]
    double torque = 0;  ///< of the powder on it about the axis, likewise [N m]
};

/// The axis of a lid may point away from the powder or to it. Turns all forces round if they pull on the whole, so that
/// what presses on the lid is above 0.
void makePressurePositive(std::vector<LidSample>& samples);

/// Stresses in a window of time.
struct ShearPoint {
    double normal = 0;           ///< [Pa]
    double shear = 0;            ///< [Pa], its size
    double normalDeviation = 0;  ///< from line to line [Pa]
    double shearDeviation = 0;   ///< [Pa]
    int lines = 0;
    double peak = 0;  ///< largest shear stress of a line [Pa]
};

/// Means over the lines with from < time <= to [s]. Normal stress: force over the ring's area pi (R^2 - r^2). Shear
/// stress: torque over 2/3 pi (R^3 - r^3), as if it were the same at all radii (D. Schulze, Powders and Bulk Solids,
/// 2nd ed. (2021), chapter 4). `outer` R and `inner` r in m, 0 in a full cell. None without a line in the window.
std::optional<ShearPoint> shearPoint(const std::vector<LidSample>& samples, double from, double to, double inner,
                                     double outer);

/// The straight line tau = c + tan(phi) sigma by least squares. With one point it goes through the origin, and the
/// cohesion is not known.
struct YieldLocus {
    double friction = 0;   ///< phi [rad]
    double cohesion = 0;   ///< c [Pa]; NaN with one point
    double effective = 0;  ///< of the line through the origin by least squares [rad]
};
/// None without points, or if all have one normal stress.
std::optional<YieldLocus> yieldLocus(const std::vector<ShearPoint>& points);

/// A stage of a shear test with pre-shear: the powder flows steadily under one load, then fails under a smaller one.
struct ShearStage {
    ShearPoint preShear, failure;
};

/// The points of incipient flow: the load at failure and the peak of the shear stress. The peak is prorated by the mean
/// shear stress of all pre-shears over that of its own (Schulze, chapter 4), because the bed is a little different each
/// time.
std::vector<ShearPoint> prorated(const std::vector<ShearStage>& stages);
/// The mean of the pre-shears.
ShearPoint meanPreShear(const std::vector<ShearStage>& stages);

/// How well a powder flows at its consolidation (A. W. Jenike, Storage and Flow of Solids (1964); Schulze, chapter 3).
struct Flowability {
    double consolidation = 0;  ///< sigma_1, major principal stress of the steady flow [Pa]
    double strength = 0;       ///< sigma_c, unconfined yield strength [Pa]
    double ffc = 0;            ///< sigma_1 over sigma_c
};
/// The strength is that of the Mohr circle through the origin that touches the locus. The consolidation is that of the
/// circle that touches the locus and has the point of steady flow behind the place of touch. None if the locus has no
/// cohesion, or the point of steady flow lies above it.
std::optional<Flowability> flowability(const YieldLocus& locus, const ShearPoint& steady);

}  // namespace vkdose
