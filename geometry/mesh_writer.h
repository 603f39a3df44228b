#pragma once
// Triangles as the bytes of a binary STL file.

#include <string>
#include <vector>

#include "geometry/mesh_file.h"

namespace vkdose::geometry {

/// One record of 50 bytes for each triangle, behind a head that holds `title`. A coordinate is that in metres over
/// `metresPerUnit`, in single precision; the normal follows from the corners, zero where they stand in line. Throws
/// MeshError if a coordinate is no finite single-precision number in that unit.
std::string stlBytes(const std::vector<Triangle>& mesh, const std::string& title, double metresPerUnit);

}  // namespace vkdose::geometry
