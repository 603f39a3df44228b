#include "host/backend/vulkan/pack_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/backend/vulkan/split.h"
#include "host/core/error.h"

namespace vkdose {

namespace {

using geometry::Mesh;
using geometry::MeshSurface;
using gpu::uvec4;

/// The smallest circle around a triangle.
Around aroundTriangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const std::array<Vec3, 3> corners{a, b, c};
    for (int i = 0; i < 3; ++i) {
        const Vec3 &p = corners[i], &q = corners[(i + 1) % 3], &third = corners[(i + 2) % 3];
        if (glm::dot(p - third, q - third) <= 0) return {0.5 * (p + q), 0.5 * glm::length(q - p)};
    }
    const Vec3 u = b - a, v = c - a, n = glm::cross(u, v);
    const Vec3 off = (glm::dot(u, u) * glm::cross(v, n) + glm::dot(v, v) * glm::cross(n, u)) / (2 * glm::dot(n, n));
    return {a + off, glm::length(off)};
}

class MeshPacker {
  public:
    MeshPacker(const MeshSurface& surface, const std::string& body, std::vector<uvec4>& table)
        : surface_(surface), name_(body), table_(table) {}

    PackedMesh pack() {
        const Mesh& mesh = surface_.mesh();
        const MeshSurface::Grid& grid = surface_.grid();
        const std::size_t triangles = table_.size();
        if (mesh.triangles.size() > gpu::kMostTriangles)
            throw RunError(
                fmt::format("body \"{}\": its mesh has {} triangles; the device holds {}. Use a coarser mesh", name_,
                            mesh.triangles.size(), uint32_t(gpu::kMostTriangles)));
        const std::vector<uint32_t> owners = ownersOf(mesh);
        for (uint32_t t = 0; t < mesh.triangles.size(); ++t) packTriangle(t, owners);
        const std::size_t edges = table_.size();
        for (uint32_t e = 0; e < mesh.edges.size(); ++e) packEdge(e);
        const std::size_t vertices = table_.size();
        packVertices();
        const std::size_t heads = table_.size(), cells = grid.first.size() - 1;
        table_.resize(heads + (cells + 1) / 2);
        const std::size_t lists = table_.size();
        for (std::size_t c = 0; c < cells; ++c) {
            const uint32_t count = grid.first[c + 1] - grid.first[c];
            if (count > gpu::kMostInCell)
                throw RunError(
                    fmt::format("body \"{}\": {} triangles of its mesh are within reach of one place; the "
                                "device holds {}. Use a coarser mesh, or --backend reference",
                                name_, count, uint32_t(gpu::kMostInCell)));
            const auto half = glm::length_t(2 * (c % 2));
            table_[heads + c / 2][half] = tableIndex(table_.size() - lists);
            table_[heads + c / 2][half + 1] = count;
            for (uint32_t n = 0; n < count; ++n) {
                if (n % 4 == 0) table_.emplace_back(0);
                table_.back()[glm::length_t(n % 4)] = grid.triangles[grid.first[c] + n];
            }
        }
        const auto faces = uint32_t(mesh.triangles.size()), sides = uint32_t(mesh.edges.size());
        PackedMesh packed;
        packed.tags = faces + sides + uint32_t(mesh.vertices.size());
        packed.heads = tableIndex(heads);
        packed.lists = tableIndex(lists);
        packed.rest = {
            bits(glm::vec3(grid.low), float(1 / grid.cell)), uvec4(glm::uvec3(grid.cells), bits(float(margin()))),
            uvec4(tableIndex(triangles), tableIndex(edges), tableIndex(vertices), 0), uvec4(faces, sides, 0, 0)};
        const Vec3 size = Vec3(grid.cells) * grid.cell;
        packed.around = {grid.low + 0.5 * size, 0.5 * glm::length(size)};
        return packed;
    }

  private:
    /// More than the error of a distance that the device computes in plain floats [m].
    double margin() const {
        double longest = 0, farthest = 0;
        for (const geometry::MeshEdge& edge : surface_.mesh().edges)
            longest = std::max(longest, glm::length(surface_.mesh().vertices[edge.vertices[1]] -
                                                    surface_.mesh().vertices[edge.vertices[0]]));
        for (const Vec3& v : surface_.mesh().vertices) farthest = std::max(farthest, glm::length(v));
        const double apart = longest + surface_.reach() + 2 * surface_.grid().cell;
        return 1e-6 * apart + 2.5e-7 * (farthest + surface_.reach());
    }

    void packTriangle(uint32_t t, const std::vector<uint32_t>& owners) {
        const Mesh& mesh = surface_.mesh();
        const auto& triangle = mesh.triangles[t];
        const auto side = [&](int i) {
            return glm::length(mesh.vertices[triangle[(i + 1) % 3]] - mesh.vertices[triangle[i]]);
        };
        // The device forms edge 1 from the two others. The difference of a long one and a short one is accurate only if
        // edge 1 is the longest.
        const int longest = side(0) >= side(1) && side(0) >= side(2) ? 0 : side(1) >= side(2) ? 1 : 2;
        std::array<uint32_t, 3> corners{}, edges{};
        for (int i = 0; i < 3; ++i) {
            corners[i] = triangle[(i + longest + 2) % 3];
            edges[i] = mesh.edgesOf[t][(i + longest + 2) % 3];
        }
        const auto edgeWord = [&](int i) {
            const geometry::MeshEdge& edge = mesh.edges[edges[i]];
            const bool first = edge.faces[0] == t;
            return edges[i] << 2 | (first && !edge.hidden ? 2u : 0u) | (first ? 0u : 1u);
        };
        const auto cornerWord = [&](int i) { return corners[i] << 1 | (owners[corners[i]] == t ? 1u : 0u); };
        const Vec3 &a = mesh.vertices[corners[0]], &b = mesh.vertices[corners[1]], &c = mesh.vertices[corners[2]];
        const Split3 start(a), normal(surface_.normals()[t]);
        const Around around = aroundTriangle(a, b, c);
        table_.push_back(bits(glm::vec3(around.centre), float(around.radius * (1 + 1e-6))));
        table_.push_back(bits(normal.high, cornerWord(2)));
        table_.push_back(bits(start.high, edgeWord(0)));
        table_.push_back(bits(start.low, edgeWord(1)));
        table_.push_back(bits(normal.low, edgeWord(2)));
        table_.push_back(bits(glm::vec3(b - a), cornerWord(0)));
        table_.push_back(bits(glm::vec3(c - a), cornerWord(1)));
    }

    void packEdge(uint32_t e) {
        const Mesh& mesh = surface_.mesh();
        const Vec3 begin = mesh.vertices[mesh.edges[e].vertices[0]];
        const Vec3 way = mesh.vertices[mesh.edges[e].vertices[1]] - begin;
        const Split3 start(begin), along(glm::normalize(way));
        const Split length(glm::length(way));
        const glm::vec3 first(surface_.inFaces()[e][0]), second(surface_.inFaces()[e][1]);
        table_.push_back(bits(start.high, second.x));
        table_.push_back(bits(start.low, second.y));
        table_.push_back(bits(along.high, second.z));
        table_.push_back(bits(along.low, length.high));
        table_.push_back(bits(first, length.low));
    }

    void packVertices() {
        const Mesh& mesh = surface_.mesh();
        const std::size_t directions = table_.size() + gpu::kVertexVectors * mesh.vertices.size();
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
            const uint32_t first = mesh.firstNeighbour[v], count = mesh.firstNeighbour[v + 1] - first;
            if (count > gpu::kMostAtVertex)
                throw RunError(
                    fmt::format("body \"{}\": {} edges of its mesh meet at one vertex; the device follows "
                                "{}. Cut the mesh otherwise, or use --backend reference",
                                name_, count, uint32_t(gpu::kMostAtVertex)));
            const Split3 place(mesh.vertices[v]);
            table_.push_back(bits(place.high, tableIndex(directions + first)));
            table_.push_back(bits(place.low, count));
        }
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
            for (uint32_t n = mesh.firstNeighbour[v]; n < mesh.firstNeighbour[v + 1]; ++n)
                table_.push_back(bits(glm::vec3(glm::normalize(mesh.vertices[mesh.neighbours[n]] - mesh.vertices[v]))));
    }

    /// Of each vertex, the first of its triangles.
    static std::vector<uint32_t> ownersOf(const Mesh& mesh) {
        std::vector<uint32_t> owners(mesh.vertices.size());
        for (auto t = uint32_t(mesh.triangles.size()); t-- > 0;)
            for (const uint32_t v : mesh.triangles[t]) owners[v] = t;
        return owners;
    }

    const MeshSurface& surface_;
    const std::string& name_;
    std::vector<uvec4>& table_;
};

}  // namespace

PackedMesh appendMesh(const MeshSurface& surface, const std::string& body, std::vector<uvec4>& table) {
    return MeshPacker(surface, body, table).pack();
}

}  // namespace vkdose
