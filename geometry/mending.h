#pragma once
// Mends what can be mended in a mesh without a change of its surface (geometry/README.md#mending).

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/mesh_file.h"

namespace vkdose::geometry {

/// Places of one kind, counted; the first few are told.
class Tally {
  public:
    void add(const std::string& place);
    std::size_t count() const { return count_; }
    /// "3 triangles without area left out (first at part.stl:12 (1, 0, 5))", behind "; " if `text` has something.
    void tell(const char* one, const char* several, std::string& text) const;

  private:
    std::size_t count_ = 0;
    std::string places_;
};

/// Triangles between vertices, on the way from a file to a mesh.
struct Draft {
    std::vector<Vec3> vertices;  ///< [m]
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::size_t> origins;  ///< of each triangle, its number in the file
};

/// What was mended.
struct Mends {
    Tally flat, doubled, onEdges;
};

/// The place of a triangle in its file, and a point of it in the units of the file: "part.stl:12 (1, 0, 5)".
std::string placeOf(const TriangleSoup& soup, std::size_t triangle, const Vec3& at);

/// Leaves out triangles that are not higher than `tolerance` [m] and all but one of those with the same corners; cuts
/// triangles in two where a vertex of another one is on the middle of an open edge of theirs. Throws MeshError if
/// nothing is left, or the cuts would come to no end.
Mends mend(Draft& draft, const TriangleSoup& soup, double tolerance);

}  // namespace vkdose::geometry
