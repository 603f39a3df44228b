#pragma once
// A mesh in the device's layout (shaders/shared/geometry.h).

#include <array>
#include <string>
#include <vector>

#include "geometry/mesh_surface.h"
#include "host/backend/vulkan/pack_words.h"

namespace vkdose {

/// What the record of the mesh's shape says, and a sphere around the mesh.
struct PackedMesh {
    std::uint32_t tags = 0;            ///< of its triangles, edges and vertices
    std::uint32_t heads = 0;           ///< where the cells of the grid begin in the table
    std::uint32_t lists = 0;           ///< where their triangles do
    std::array<gpu::uvec4, 4> rest{};  ///< vectors 2 to 5 of the record
    Around around;
};

/// Appends the tables of a mesh to `table`. Throws RunError, naming the body, for a mesh that the device cannot compute
/// with.
PackedMesh appendMesh(const geometry::MeshSurface& surface, const std::string& body, std::vector<gpu::uvec4>& table);

}  // namespace vkdose
