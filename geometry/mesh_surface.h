#pragma once
// A mesh that spheres touch, in its own frame. The tables are those that a device needs: nothing in them changes while
// the body moves.

#include "geometry/features.h"
#include "geometry/mesh.h"

namespace vkdose::geometry {

class MeshSurface {
  public:
    /// For spheres of radius up to `reach` [m]. Throws MeshError if the reach is not positive.
    MeshSurface(Mesh mesh, double reach);

    /// The places where the mesh comes nearer than `radius` <= reach [m], as local minima of the distance; the same
    /// place may stand there several times. Both sides of a triangle touch. Keys count triangles, then edges, then
    /// vertices.
    std::vector<Feature> places(const Vec3& centre, double radius) const;
    ShapeForm form() const;
    /// The mesh as it is.
    void cut(Tessellator& into) const;
    /// The distinct features that a sphere of `radius` <= reach [m] touches (features.h).
    std::vector<Feature> touched(const Vec3& centre, double radius) const;
    /// The same, found without the grid, for any radius: the twin for tests.
    std::vector<Feature> touchedAmongAll(const Vec3& centre, double radius) const;

    const Mesh& mesh() const { return mesh_; }
    double reach() const { return reach_; }

    /// A uniform grid over the mesh, widened by the reach. A sphere looks into the cell of its centre alone: each
    /// triangle is in every cell that has a point within the reach of it.
    struct Grid {
        Vec3 low{0};
        double cell = 0;  ///< [m]
        glm::ivec3 cells{0};
        std::vector<std::uint32_t> first;  ///< of a cell (x fastest), in `triangles`; one more entry than cells
        std::vector<std::uint32_t> triangles;
    };
    const Grid& grid() const { return grid_; }
    const std::vector<Vec3>& normals() const { return normals_; }  ///< of the triangles, unit
    /// Of each edge, unit vectors in its faces, square to it, from it into the face; zero where there is no face.
    const std::vector<std::array<Vec3, 2>>& inFaces() const { return inFaces_; }

  private:
    enum class Part { Face, Edge, Vertex };
    struct Place {
        Feature feature;
        Part part = Part::Face;
        std::uint32_t index = 0;  ///< of the triangle, edge or vertex
    };

    Place closestOn(std::uint32_t triangle, const Vec3& q) const;
    bool isLocalMinimum(const Place& place) const;
    template <class Triangles>
    std::vector<Feature> placesAmong(const Triangles& triangles, const Vec3& centre, double radius) const;
    void findDirections();
    void makeGrid();
    double cellSize(const Vec3& size) const;
    /// Calls visit(cell, triangle) for every entry of the grid, triangle by triangle.
    template <class Visit>
    void forEachEntry(const Visit& visit) const;

    Mesh mesh_;
    double reach_;
    std::vector<Vec3> normals_;
    std::vector<std::array<Vec3, 2>> inFaces_;
    Grid grid_;
};

}  // namespace vkdose::geometry
