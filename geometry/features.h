#pragma once
// The one question that every shape answers: which distinct features does this sphere touch? Each feature makes one
// contact. An answer does not depend on how a surface is cut into triangles.

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "geometry/surface.h"

namespace vkdose::geometry {

/// A place where a surface touches a sphere. `normal` points to the sphere's centre unless the centre lies behind a
/// surface that has a free side. `shape` is the number of the shape in its body, `key` names the place within the
/// shape; both order places of equal depth.
struct Feature : Closest {
    std::uint32_t key = 0;
    std::uint32_t shape = 0;
};

/// A sphere touches one body in at most so many places; a backend keeps as many histories.
inline constexpr std::size_t kMaxFeatures = 8;

/// A sphere touches a body in more than kMaxFeatures places. The message says where.
class TooManyFeatures : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The distinct ones of all places where a body touches a sphere of `radius` [m] about `centre`, deepest first, ties by
/// key. Places are one feature if their directions are within 20 degrees, or lead to each other in such steps without
/// a rise between them: the sphere then lies in one hollow, however it is cut into facets. A place on or under the
/// flat of a deeper contact (oneContact) is none either: so a convex body touches a sphere once. Throws
/// TooManyFeatures.
std::vector<Feature> distinct(std::vector<Feature> places, const Vec3& centre, double radius);

}  // namespace vkdose::geometry
