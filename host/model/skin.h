#pragma once
// Triangles as they are drawn: with smooth shading, and with the edges that a draughtsman would draw.

#include <array>
#include <vector>

#include "geometry/mesh_file.h"
#include "geometry/motion.h"

namespace vkdose {

/// A triangle with the direction of its surface at each corner.
struct Facet {
    geometry::Triangle corners{};
    std::array<Vec3, 3> normals{};  ///< unit
    bool solid = false;             ///< it bounds matter, so a cut through the body shows a section
};

/// A side of one or two triangles.
struct Edge {
    Vec3 from{0}, to{0};
    std::array<Vec3, 2> into{};  ///< unit, square to the edge, into the triangles
    int faces = 0;               ///< triangles that share it: 1, 2, or more

    /// An edge of the body, not of the triangles that stand for its curved sides.
    bool sharp() const;
    /// Seen along `towards` (to the viewer), one triangle lies behind the other.
    bool onLimb(const Vec3& towards) const;
};

/// Triangles with their edges.
struct Skin {
    std::vector<Facet> facets;
    std::vector<Edge> edges;

    void add(const Skin& more);
};
/// Normals are smooth where triangles meet at less than 30 degrees.
Skin skinOf(const std::vector<geometry::Triangle>& mesh, bool solid);

/// The skin of a body where it stands.
Skin placed(Skin skin, const geometry::Pose& pose);

}  // namespace vkdose
