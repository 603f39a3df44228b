#pragma once
// Where the powder of a refill is put.

#include <cstddef>
#include <vector>

#include "host/model/case.h"
#include "host/model/clearance.h"

namespace vkdose {

/// The box of a refill's grid, were there no powder: that of the filling, open upwards. In a canister and with mixed
/// powders it is that of the first powder.
Box refillRegion(const Case& c, const Refill& refill);

/// Positions of the spheres of refill `index` [m]. Their grid stands as low as the filling's did, but above all active
/// particles of `now` that are in the way of its fall. In a vessel they take the first sites of its grid that are
/// clear. Throws RunError if a sphere would be outside of the domain, in a place where powder is dosed, or in what
/// `around` knows, or if the vessel has too few clear sites.
std::vector<Vec3> placeRefill(const Case& c, const Insertion& filled, std::size_t index, const Particles& now,
                              const Clearance& around);

}  // namespace vkdose
