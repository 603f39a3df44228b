#pragma once
// Finds where a sphere touches two things in one and the same place: a body and a wall, or two bodies. Only what
// rests, or moves in the same way, is looked at. Such a sphere would have two contacts with one surface, and so twice
// the stiffness, damping, friction and adhesion.

#include <cstddef>
#include <vector>

#include "host/model/case.h"

namespace vkdose {

/// Places for spheres of `radius` [m], some for each pair that shares any. Both are touched from the same side: their
/// normals are within 2.5 degrees of each other, and the distances from the centre are within a fiftieth of the radius.
/// The bodies stand as at the start. A sphere there is in the domain, in no region that deletes, and in no other
/// thing's way. The inside of a closed mesh counts as free only if all particles start there.
std::vector<SharedPlace> sharedPlaces(const Case& c, const Particles& particles, double radius);

}  // namespace vkdose
