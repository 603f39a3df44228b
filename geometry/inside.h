#pragma once
// Which points lie inside of a closed mesh.

#include <map>
#include <utility>
#include <vector>

#include "geometry/mesh.h"

namespace vkdose::geometry {

/// Counts how often a line along z from a point leaves the mesh. An odd number means that the point is inside. The mesh
/// must outlive it.
class Inside {
  public:
    explicit Inside(const Mesh& mesh);

    bool operator()(const Vec3& p) const;

  private:
    static constexpr int kCells = 64;

    const Vec3& corner(std::size_t t, int i) const { return mesh_.vertices[mesh_.triangles[t][std::size_t(i)]]; }
    int cell(double x, int axis) const;
    bool above(std::size_t t, const Vec3& p) const;

    const Mesh& mesh_;
    Vec3 low_, high_;
    std::map<std::pair<int, int>, std::vector<std::size_t>> columns_;
};

/// Whether no edge of the mesh is open.
bool isClosed(const Mesh& mesh);

}  // namespace vkdose::geometry
