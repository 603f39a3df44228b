#pragma once
// The angle of repose: the slope of a heap's flank.

#include <optional>
#include <vector>

#include "geometry/motion.h"
#include "host/model/particles.h"

namespace vkdose {

/// `particles` in a frame whose y axis points along the unit vector `up` and whose origin is `foot` [m].
Particles upright(const Particles& particles, const Vec3& foot, const Vec3& up);
/// Poses of bodies in that frame.
std::vector<geometry::Pose> upright(const std::vector<geometry::Pose>& poses, const Vec3& foot, const Vec3& up);

struct HeapSlope {
    double angle = 0;   ///< of the flank to the horizontal [rad]
    double error = 0;   ///< standard error of it, from the four quarters of the heap [rad]; NaN if one has no flank
    double height = 0;  ///< of the heap's top over its foot [m]
    double from = 0, to = 0;  ///< distances from the axis between which the flank was fitted [m]
};

/// The slope of a heap about the y axis, on a foot at y = 0 (`upright`). The surface over a spot is the highest point
/// of any sphere above it that is neither dosed nor lost; where there is none it is the foot. It is taken on a lattice
/// of a quarter of the mean diameter. Rings a mean diameter wide around the axis have a mean height each. The flank is
/// made of the rings in a row, from the top outwards, whose mean height is from 20 to 80 % of the highest ring's: the
/// top is rounded, and spheres have rolled from the foot. The slope is that of the straight line h = a - b r which
/// least squares fit to the surface over the flank's rings. None if the flank has fewer than three rings.
std::optional<HeapSlope> heapSlope(const Particles& particles);

/// The slope of the same heap as sixteen photographs show it that are taken from all sides, at equal angles
/// (AveragedView). A photograph shows the outline of the heap: in each column the highest powder along the line of
/// sight. Its flanks go from the highest column outwards, to the right and to the left, from 80 down to 20 % of the
/// highest column's height. `angle` is the mean over the thirty-two flanks of the angle of the least-squares line
/// through the heights of its columns; `error` that of the means of the four quarters of the compass; height, `from`
/// and `to` are means. None if a flank has fewer than three mean diameters.
std::optional<HeapSlope> heapSlopeFromSide(const Particles& particles);

}  // namespace vkdose
