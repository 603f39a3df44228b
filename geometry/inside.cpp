#include "geometry/inside.h"

#include <algorithm>

namespace vkdose::geometry {

Inside::Inside(const Mesh& mesh) : mesh_(mesh), low_(mesh.vertices.front()), high_(low_) {
    for (const Vec3& v : mesh.vertices) {
        low_ = glm::min(low_, v);
        high_ = glm::max(high_, v);
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (std::binary_search(mesh.inner.begin(), mesh.inner.end(), t)) continue;
        Vec3 from = corner(t, 0), to = from;
        for (int i = 1; i < 3; ++i) {
            from = glm::min(from, corner(t, i));
            to = glm::max(to, corner(t, i));
        }
        for (int x = cell(from.x, 0); x <= cell(to.x, 0); ++x)
            for (int y = cell(from.y, 1); y <= cell(to.y, 1); ++y) columns_[{x, y}].push_back(t);
    }
}

bool Inside::operator()(const Vec3& p) const {
    if (glm::any(glm::lessThan(p, low_)) || glm::any(glm::greaterThan(p, high_))) return false;
    const auto column = columns_.find({cell(p.x, 0), cell(p.y, 1)});
    if (column == columns_.end()) return false;
    bool inside = false;
    for (const std::size_t t : column->second)
        if (above(t, p)) inside = !inside;
    return inside;
}

int Inside::cell(double x, int axis) const {
    const double share = (x - low_[axis]) / std::max(high_[axis] - low_[axis], 1e-300);
    return int(std::clamp(share * kCells, 0.0, kCells - 1.0));
}

/// Whether the line from `p` along +z passes the triangle. Each edge belongs to one of its sides alone.
bool Inside::above(std::size_t t, const Vec3& p) const {
    bool within = false;
    for (int i = 0; i < 3; ++i) {
        const Vec3 a = corner(t, i), b = corner(t, (i + 1) % 3);
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) within = !within;
    }
    if (!within) return false;
    const Vec3 a = corner(t, 0), n = glm::cross(corner(t, 1) - a, corner(t, 2) - a);
    return n.z != 0 && a.z - (n.x * (p.x - a.x) + n.y * (p.y - a.y)) / n.z > p.z;
}

bool isClosed(const Mesh& mesh) {
    return mesh.closed;
}

}  // namespace vkdose::geometry
