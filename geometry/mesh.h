#pragma once
// A surface of triangles that is fit to compute contacts with: equal corners made one, every triangle with an area,
// edges and vertices known. Geometry for it is exact in double precision; features.h asks it for contacts.

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/mesh_file.h"

namespace vkdose::geometry {

inline constexpr std::uint32_t kNoFace = std::numeric_limits<std::uint32_t>::max();

/// Two vertices, and the one or two triangles that share them. A seam, where three or more triangles meet, has several
/// such entries: one of the two triangles between which a sphere can have its nearest place on it, if there are such,
/// and hidden ones of the others.
struct MeshEdge {
    std::array<std::uint32_t, 2> vertices{};               ///< ascending
    std::array<std::uint32_t, 2> faces{kNoFace, kNoFace};  ///< the second is kNoFace at an open edge
    bool hidden = false;  ///< of a seam, and the distance to a sphere has no local minimum there
};

struct Mesh {
    std::vector<Vec3> vertices;                           ///< [m]
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< anticlockwise, seen from outside, if oriented
    std::vector<MeshEdge> edges;
    std::vector<std::array<std::uint32_t, 3>> edgesOf;  ///< of a triangle: i runs from corner i to corner i + 1
    std::vector<std::uint32_t> firstNeighbour;          ///< of a vertex, in `neighbours`; one more entry than vertices
    std::vector<std::uint32_t> neighbours;              ///< vertices at the other ends of a vertex's edges
    bool closed = false;               ///< it parts an inside from an outside: no edge is open, no part is a mere sheet
    std::vector<std::uint32_t> inner;  ///< triangles of walls within a closed surface, ascending
};

/// A few facts of a mesh, for the user to compare with the drawing.
struct MeshFacts {
    double weldTolerance = 0;  ///< corners closer than this became one [m]
    std::size_t cornersRead = 0, vertices = 0, triangles = 0, edges = 0, openEdges = 0;
    bool closed = false;
    bool oriented = false;  ///< triangles that share an edge agree on which side is outside
    double area = 0;        ///< [m2]
    double volume = 0;      ///< enclosed [m3]; 0 unless closed and oriented; negative if the mesh is inside out
    Vec3 low{0}, high{0};   ///< [m]
    std::size_t seams = 0;  ///< edges of three triangles or more
    std::string mended;     ///< what was mended, how often and where, places in the units of the file; empty: nothing
    /// "2572 triangles, closed, 12.3 x 4.5 x 6 mm, ...".
    std::string text() const;
};

struct CheckedMesh {
    Mesh mesh;
    MeshFacts facts;
};

/// Tolerance by which corners are welded unless the user gives another: a millionth of the mesh's diagonal, or a few
/// digits of single precision at its coordinates if that is more [m].
double defaultWeldTolerance(const TriangleSoup& soup);

/// Welds the corners and mends the mesh: triangles without area (lower than the tolerance) and all but one of those
/// that stand there twice are left out, triangles are cut at vertices on their open edges, edges of more than two
/// triangles become seams (geometry/README.md#mending). The facts tell it. Open edges are allowed. Throws MeshError
/// with numbers and places if nothing is left, or the cuts come to no end.
CheckedMesh makeMesh(const TriangleSoup& soup, double weldTolerance);
CheckedMesh makeMesh(const TriangleSoup& soup);

}  // namespace vkdose::geometry
