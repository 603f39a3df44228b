#pragma once
// Edges where three triangles or more meet.

#include <map>
#include <vector>

#include "geometry/mesh.h"

namespace vkdose::geometry {

/// The triangles of every edge that has three or more.
using Crowds = std::map<std::uint32_t, std::vector<std::uint32_t>>;

/// Whether triangle `t` has the edge from vertex a to b in this direction.
bool runsAlong(const Mesh& mesh, std::uint32_t t, std::uint32_t a, std::uint32_t b);

class Seams {
  public:
    /// Of a mesh whose edges have no more than two triangles but for the `crowds`; `closed`, `inner` are not looked at.
    Seams(Mesh& mesh, const Crowds& crowds);

    /// Gives every edge of a crowd entries of two triangles (MeshEdge).
    void sew();

    /// For a mesh without open edges: finds the triangles within closed surfaces (`inner`), and turns those of a
    /// surface with seams so that each is anticlockwise from outside. False if a part of it has the outside on both its
    /// sides.
    bool turnOutwards();

  private:
    struct Ray {
        std::uint32_t face;
        double angle;  ///< about the edge, from its first vertex to its second by the right hand [rad]
    };
    std::vector<Ray> around(std::uint32_t edge, const std::vector<std::uint32_t>& faces) const;
    void join(const std::vector<std::uint32_t>& ring, const std::array<std::uint32_t, 2>& ends);
    void addEntry(std::uint32_t crowd, bool first, std::array<std::uint32_t, 2> faces, bool hidden);
    std::uint32_t outermost(const std::vector<std::uint32_t>& part) const;

    Mesh& mesh_;
    const Crowds& crowds_;
    std::vector<std::vector<std::uint32_t>> rings_;  ///< of each crowd, by angle
    /// Of each side of a triangle, the sides that the space before it leads to over its edges. Side 2 t is that from
    /// which triangle t is anticlockwise.
    std::vector<std::vector<std::uint32_t>> next_;
};

}  // namespace vkdose::geometry
