#pragma once
// The one question that every shape answers: which distinct features does this sphere touch? Each feature makes one
// contact. An answer does not depend on how a surface is cut into triangles.

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "geometry/surface.h"

namespace vkdose::geometry {

/// How the direction from a place to the sphere's centre turns when the sphere moves.
enum class Bend : std::uint8_t {
    None,  ///< not, as on a plane; curved shapes count as their tangent planes
    Line,  ///< around a straight edge
    Point  ///< around a corner
};

/// A place where a surface touches a sphere. `normal` points to the sphere's centre unless the centre lies behind a
/// surface that has a free side. `shape` is the number of the shape in its body, `key` names the place within the
/// shape; both order places of equal depth.
struct Feature : Closest {
    std::uint32_t key = 0;
    std::uint32_t shape = 0;
    Bend bend = Bend::None;
    Vec3 along{0};  ///< of a Line its direction, unit
    /// How much the overlap falls per way along the normal. Below 1 only where another contact has a part of this one.
    /// It is the part of the law's normal force that acts.
    double share = 1;
};

/// A sphere touches one body in at most so many places; a backend keeps as many histories.
inline constexpr std::size_t kMaxFeatures = 8;

/// A sphere touches a body in more than kMaxFeatures places. The message says where.
class TooManyFeatures : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The distinct ones of all places where a body comes nearer to `centre` than `radius` + `reach` [m], by the depth of
/// their places, ties by key. The deepest is as its shape tells it. Another has only the overlap by which it is deeper
/// than the pass to a deeper one (geometry/README.md, Distinct features), and a normal and a share to match: so the
/// energy of a contact follows the sphere without a jump. Places without a pass between them are one feature: so a
/// convex body touches a sphere once. Throws TooManyFeatures.
std::vector<Feature> distinct(std::vector<Feature> places, const Vec3& centre, double radius, double reach = 0);

}  // namespace vkdose::geometry
