#pragma once
// Bulk density of the powder as it lies: in the bed above the coil, and between the coil's turns.

#include <optional>

#include "geometry/coil.h"
#include "host/model/case.h"

namespace vkdose {

/// Mean radius of the particles that are neither dosed nor lost [m]; 0 if there are none.
double meanActiveRadius(const Particles& particles);

struct BulkDensity {
    double density = 0;  ///< mass / volume [kg/m3]
    double mass = 0;     ///< of the parts of spheres within the region [kg]
    double volume = 0;   ///< of the region [m3]
};

/// In the bed. The region: over the whole floor plan of the canister but a mean diameter from every wall, from a mean
/// diameter above the coil (above the axis without a coil) up to a mean diameter below the surface. The surface is that
/// of columns two mean diameters square: the top of the highest sphere with its centre in the column. Spheres that the
/// region cuts count in part. None if the region is smaller than a hundred mean spheres: then walls and surface decide.
std::optional<BulkDensity> bedDensity(const Particles& particles, double particleDensity, const Canister& canister,
                                      const geometry::Coil* coil);

/// Between the coil's turns: the cylinder of the coil's outer radius within the canister, less the wire, over those
/// slices along the axis (two mean diameters thick) whose surface lies a mean diameter above it, so that they are full
/// or could be; voids under arches count as volume. Only the part of the coil beyond z = `from` [m]. None if no slice
/// is covered.
std::optional<BulkDensity> coilDensity(const Particles& particles, double particleDensity, const Canister& canister,
                                       const geometry::Coil& coil, double from = 0);

/// The paper's closed form rho_b p pi r_c^2 n_t [kg] of a coil that turns `turns` times, for any bulk density [kg/m3].
double closedFormMass(double bulkDensity, const geometry::Coil& coil, double turns);

}  // namespace vkdose
