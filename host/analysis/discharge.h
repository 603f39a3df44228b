#pragma once
// How fast powder runs out of a hole, and the constant of Beverloo's law that follows from it.

#include <optional>
#include <vector>

namespace vkdose {

/// What has run out by a line of the time series.
struct DischargeSample {
    double time = 0;  ///< [s]
    double mass = 0;  ///< [kg]
};

struct Discharge {
    double rate = 0;   ///< [kg/s]
    double error = 0;  ///< standard error of the rate, from the rates of the four quarters of its time [kg/s]
};

/// The slope of the least-squares line through the samples in [from, to]. None with fewer than eight samples there, or
/// if nothing runs out.
std::optional<Discharge> dischargeOf(const std::vector<DischargeSample>& samples, double from, double to);

/// C in W = C rho sqrt(g) (D - k d)^(5/2) with k = kBeverlooGap: rate W [kg/s], bulk density rho [kg/m3], gravity g
/// [m/s2], diameters of the round hole D and of the grains d [m]. NaN if the hole is no wider than k d. Beverloo,
/// Leniger and van de Velde (1961) found C = 0.58; values from 0.55 to 0.65 are usual.
double beverlooConstant(double rate, double bulkDensity, double gravity, double hole, double grain);

/// Diameters of a grain by which a hole is narrower for the powder than it is: 1.5 for spheres.
constexpr double kBeverlooGap = 1.5;

}  // namespace vkdose
