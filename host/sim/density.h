#pragma once
// Bulk density of the powder as it lies: in the bed above the coil, and between the coil's turns. Every region keeps
// away from bodies as BodyRoom says, by a mean diameter. `bodies` are their poses, at the start of those that it lacks.

#include <optional>

#include "geometry/coil.h"
#include "host/model/case.h"
#include "host/sim/body_room.h"
#include "host/sim/rest_watch.h"

namespace vkdose {

/// Mean radius of the particles that are neither dosed nor lost [m]; 0 if there are none.
double meanActiveRadius(const Particles& particles);

struct BulkDensity {
    double density = 0;  ///< mass / volume [kg/m3]
    double mass = 0;     ///< of the parts of spheres within the region [kg]
    double volume = 0;   ///< of the region [m3]
    double solid = 0;    ///< volume of the parts of spheres [m3]
};

/// Bulk density in the bed. The region covers the floor plan of the canister up to a mean diameter from every wall and
/// body. It reaches from a mean diameter above the coil (above the axis without a coil) to a mean diameter below the
/// surface. The surface is found in columns two mean diameters square: it is the top of the highest sphere with its
/// centre in the column. Spheres that the region cuts count in part. None if the region is smaller than a hundred mean
/// spheres, because then walls and surface decide.
std::optional<BulkDensity> bedDensity(const World& world, const Particles& particles, const Canister& canister,
                                      const geometry::Coil* coil, const BodyPoses& bodies = {});

/// Bulk density between the coil's turns. The region is the cylinder of the coil's outer radius within the canister,
/// less the wire and the room of bodies, for the part of the coil beyond z = `from` [m]. It is cut into slices along
/// the axis, two mean diameters thick. Only slices whose surface lies a mean diameter above the cylinder count, because
/// they are full or could be. Voids under arches count as volume. None if no slice is covered.
std::optional<BulkDensity> coilDensity(const World& world, const Particles& particles, const Canister& canister,
                                       const geometry::Coil& coil, double from = 0, const BodyPoses& bodies = {});

/// The bulk density of a settled canister: in the bed, or between the turns of the coil where the bed above them is too
/// small. None if both regions are too small, if the spheres still move by more than a tenth of the speed after a fall
/// from the fill's top, or without a canister.
std::optional<BulkDensity> settledDensity(const Case& c, const Settling& settling, const Particles& particles,
                                          const BodyPoses& bodies = {});

/// Bulk density in an upright round container of this radius [m] about the y axis, whose floor is at y = 0 (`upright`
/// in heap.h). The region is a cylinder, a mean diameter from wall, floor and surface. It ends below the lowest place
/// of the surface, which is found as in bedDensity, in columns that lie wholly in the cylinder; a column without
/// spheres where a body stands does not count. The poses of the bodies are in the frame of the container. None if the
/// region is smaller than a hundred mean spheres.
std::optional<BulkDensity> containerDensity(const World& world, const Particles& particles, double radius,
                                            const BodyPoses& bodies = {});

/// The paper's closed form rho_b p pi r_c^2 n_t [kg] of a coil that turns `turns` times, for any bulk density [kg/m3].
double closedFormMass(double bulkDensity, const geometry::Coil& coil, double turns);

/// The bulk density [kg/m3] from which `derived` has its mass per turn of this coil.
double closedFormDensity(const Derived& derived, const geometry::Coil& coil);
/// Whether that density is one that a run has measured, and not the estimate of its case.
bool wasMeasured(const Case& c, double density);

}  // namespace vkdose
