#pragma once
// The dynamic angle of the powder in a turning drum.

#include <optional>

#include "host/model/particles.h"

namespace vkdose {

/// Particles in the frame of a drum: z along its axis, y upwards and x to the side to which the drum's lowest point
/// moves, so that powder that the drum lifts rises towards +x. `through` is a point of the axis [m]; `axis` and `up`
/// are unit vectors, and the drum turns about `axis` by the right-hand rule. Throws std::invalid_argument if the axis
/// is upright.
Particles inDrum(const Particles& particles, const Vec3& through, const Vec3& axis, const Vec3& up);

/// Angle of the free surface to the horizontal [rad], positive where the powder rises towards +x (`inDrum`). The line
/// is fitted by least squares to the surface as it looks along the line's own normal, over the middle half of the bed's
/// width, so that steep surfaces count like flat ones. Surface: the highest point of any sphere over a spot, on a
/// lattice of a quarter of the mean diameter. Powder in flight counts. None if there are fewer than ten diameters of
/// width, or if the line does not come to rest within five degrees.
std::optional<double> drumAngle(const Particles& particles);

}  // namespace vkdose
