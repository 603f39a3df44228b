#pragma once
// The part of a grid that lies in a vessel.

#include <cstdint>
#include <vector>

#include "host/model/clearance.h"
#include "host/model/grid.h"
#include "host/model/particles.h"
#include "host/model/world.h"

namespace vkdose {

/// The box around these of the bodies as they stand at the start. Shapes without an end do not count; without
/// any other its `high` is below its `low`.
Box boxAround(const std::vector<RigidBody>& bodies, const std::vector<std::size_t>& which);

/// The sites, ascending, of the largest room in the vessel. A room is made of sites that are clear of walls, coil and
/// bodies as they stand at the start, by `reach` [m], and that are joined by steps to neighbours which
/// lead through no wall. What lies outside of the vessel, in the corners of the box around it (`vessel`), is open to
/// the sides of that box; such a room is taken only if there is no other. Empty if no site is clear. The grid must have
/// an end.
std::vector<std::uint64_t> sitesInside(const World& world, const InsertionGrid& grid, const Box& vessel, double reach);

/// Volume of the largest room, as above, in this part of a vessel [m3]: of all places that a sphere of this radius [m]
/// covers as its centre goes wherever it can. It is told from cells of 0.37 of the radius, or larger if there would be
/// too many.
double roomInside(const World& world, const Box& vessel, double radius);

/// The grid's sites, ascending, that are clear by half its pitch of what `around` knows and of the active particles of
/// `now`, and in no region that deletes.
std::vector<std::uint64_t> clearSites(const World& world, const InsertionGrid& grid, const Clearance& around,
                                      const Particles& now);

}  // namespace vkdose
