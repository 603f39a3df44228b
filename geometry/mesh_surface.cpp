// A sphere touches a surface where the distance to its centre has a local minimum below the radius. Each triangle gives
// its closest point. In the middle of a face that is a minimum. On an edge it is one only if the direction to the
// centre leads into neither face, u . t <= 0 for both directions t; on a vertex, if it leads along none of its edges.
// So the faces that meet in an edge never count it beside themselves. The closest point of all is always a minimum, and
// is kept even if rounding says otherwise. What remains goes through `distinct`.

#include "geometry/mesh_surface.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/tessellator.h"

namespace vkdose::geometry {

namespace {

/// Directions count as square to each other to this. A place that two parts share is then found by one of them at
/// least; found by both, it is one feature, because both have one direction.
constexpr double kSquare = 1e-9;

constexpr double kMostCells = 2e6;
constexpr double kMostVisits = 2e8;  // of cells by triangles, while the grid is made

/// Unit normal, from the two shortest edges: so a needle's is as good as that of any other triangle.
Vec3 normalOf(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, bc = c - b, ca = a - c;
    const double lab = glm::dot(ab, ab), lbc = glm::dot(bc, bc), lca = glm::dot(ca, ca);
    const Vec3 n = lab >= lbc && lab >= lca ? glm::cross(bc, ca) : lbc >= lca ? glm::cross(ca, ab) : glm::cross(ab, bc);
    return glm::normalize(n);
}

}  // namespace

MeshSurface::MeshSurface(Mesh mesh, double reach) : mesh_(std::move(mesh)), reach_(reach) {
    if (!(std::isfinite(reach) && reach > 0)) throw MeshError("the reach of a mesh must be positive");
    findDirections();
    makeGrid();
}

void MeshSurface::findDirections() {
    for (const auto& t : mesh_.triangles)
        normals_.push_back(normalOf(mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]));
    for (const MeshEdge& edge : mesh_.edges) {
        const Vec3 a = mesh_.vertices[edge.vertices[0]], b = mesh_.vertices[edge.vertices[1]];
        std::array<Vec3, 2> in{Vec3(0), Vec3(0)};
        for (int side = 0; side < 2; ++side) {
            if (edge.faces[side] == kNoFace) continue;
            const Vec3 across = glm::normalize(glm::cross(normals_[edge.faces[side]], b - a));
            // The third corner tells on which side of the edge the face is.
            Vec3 third(0);
            for (const std::uint32_t v : mesh_.triangles[edge.faces[side]])
                if (v != edge.vertices[0] && v != edge.vertices[1]) third = mesh_.vertices[v];
            in[side] = glm::dot(third - a, across) < 0 ? -across : across;
        }
        inFaces_.push_back(in);
    }
}

MeshSurface::Place MeshSurface::closestOn(std::uint32_t triangle, const Vec3& q) const {
    const auto& corners = mesh_.triangles[triangle];
    const Vec3& normal = normals_[triangle];
    const auto feature = [&](const Vec3& point, std::size_t key) {
        const Vec3 away = q - point;
        const double distance = glm::length(away);
        return Feature{{point, distance > 0 ? away / distance : normal, distance}, static_cast<std::uint32_t>(key)};
    };

    bool inside = true;
    Place best{};
    double least = kEndless;
    for (int i = 0; i < 3; ++i) {
        const Vec3 &a = mesh_.vertices[corners[i]], &b = mesh_.vertices[corners[(i + 1) % 3]];
        const Vec3 along = b - a;
        if (glm::dot(glm::cross(normal, along), q - a) < 0) inside = false;
        const double share = glm::clamp(glm::dot(q - a, along) / glm::dot(along, along), 0.0, 1.0);
        const Vec3 point = share == 1 ? b : a + share * along;
        const double distance = glm::dot(q - point, q - point);
        if (distance >= least) continue;
        least = distance;
        if (share > 0 && share < 1) {
            const std::uint32_t edge = mesh_.edgesOf[triangle][i];
            best = {feature(point, mesh_.triangles.size() + edge), Part::Edge, edge};
            best.feature.bend = Bend::Line;
            best.feature.along = along;
        } else {
            const std::uint32_t vertex = share == 0 ? corners[i] : corners[(i + 1) % 3];
            best = {feature(point, mesh_.triangles.size() + mesh_.edges.size() + vertex), Part::Vertex, vertex};
            best.feature.bend = Bend::Point;
        }
    }
    if (!inside) {
        if (best.part == Part::Edge) best.feature.along = glm::normalize(best.feature.along);
        return best;
    }
    // The normal of the face itself, not the difference of two near points, gives the direction.
    const double height = glm::dot(q - mesh_.vertices[corners[0]], normal);
    return {{{q - height * normal, height < 0 ? -normal : normal, std::abs(height)}, triangle}, Part::Face, triangle};
}

bool MeshSurface::isLocalMinimum(const Place& place) const {
    if (place.part == Part::Face) return true;
    const Vec3& u = place.feature.normal;
    if (place.part == Part::Edge) {
        if (mesh_.edges[place.index].hidden) return false;
        const auto& in = inFaces_[place.index];
        return glm::dot(u, in[0]) <= kSquare && glm::dot(u, in[1]) <= kSquare;
    }
    const Vec3& here = mesh_.vertices[place.index];
    for (std::uint32_t i = mesh_.firstNeighbour[place.index]; i < mesh_.firstNeighbour[place.index + 1]; ++i) {
        const Vec3 along = mesh_.vertices[mesh_.neighbours[i]] - here;
        if (glm::dot(u, along) > kSquare * glm::length(along)) return false;
    }
    return true;
}

template <class Triangles>
std::vector<Feature> MeshSurface::placesAmong(const Triangles& triangles, const Vec3& centre, double radius) const {
    std::vector<Feature> places;
    Feature closest{};
    closest.distance = radius;
    for (const std::uint32_t t : triangles) {
        const Place place = closestOn(t, centre);
        if (!(place.feature.distance < radius)) continue;
        const bool closer = place.feature.distance < closest.distance ||
                            (place.feature.distance == closest.distance && place.feature.key < closest.key);
        if (closer) closest = place.feature;
        if (isLocalMinimum(place)) places.push_back(place.feature);
    }
    if (closest.distance < radius) places.push_back(closest);
    return places;
}

ShapeForm MeshSurface::form() const {
    return {.solid = mesh_.closed, .facet = 1};
}

void MeshSurface::cut(Tessellator& into) const {
    for (const auto& t : mesh_.triangles) into.put(mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]);
}

std::vector<Feature> MeshSurface::places(const Vec3& centre, double radius) const {
    if (!(radius <= reach_)) throw std::logic_error("a sphere larger than the reach of the mesh");
    const glm::dvec3 cell = glm::floor((centre - grid_.low) / grid_.cell);
    for (int d = 0; d < 3; ++d)
        if (!(cell[d] >= 0 && cell[d] < grid_.cells[d])) return {};
    const std::size_t c =
        std::size_t(cell.x) +
        std::size_t(grid_.cells.x) * (std::size_t(cell.y) + std::size_t(grid_.cells.y) * std::size_t(cell.z));
    struct Range {
        const std::uint32_t *first, *last;
        const std::uint32_t* begin() const { return first; }
        const std::uint32_t* end() const { return last; }
    };
    return placesAmong(Range{grid_.triangles.data() + grid_.first[c], grid_.triangles.data() + grid_.first[c + 1]},
                       centre, radius);
}

std::vector<Feature> MeshSurface::touched(const Vec3& centre, double radius) const {
    return distinct(places(centre, radius), centre, radius);
}

std::vector<Feature> MeshSurface::touchedAmongAll(const Vec3& centre, double radius) const {
    std::vector<std::uint32_t> all(mesh_.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    return distinct(placesAmong(all, centre, radius), centre, radius);
}

/// As small as the reach, unless that makes too many cells or takes too long.
double MeshSurface::cellSize(const Vec3& size) const {
    for (double cell = reach_;; cell *= 1.25) {
        const auto across = [&](const Vec3& s) {
            return (std::floor(s.x / cell) + 2) * (std::floor(s.y / cell) + 2) * (std::floor(s.z / cell) + 2);
        };
        if (across(size) > kMostCells) continue;
        double visits = 0;
        for (const auto& t : mesh_.triangles) {
            const Vec3 &a = mesh_.vertices[t[0]], &b = mesh_.vertices[t[1]], &c = mesh_.vertices[t[2]];
            visits += across(glm::max(glm::max(a, b), c) - glm::min(glm::min(a, b), c) + 2 * reach_);
        }
        // With one cell for the whole mesh there is nothing left to save.
        if (visits <= std::max(kMostVisits, 64.0 * double(mesh_.triangles.size()))) return cell;
    }
}

template <class Visit>
void MeshSurface::forEachEntry(const Visit& visit) const {
    const double within = reach_ + std::sqrt(0.75) * grid_.cell * (1 + 1e-9);  // of the middle of a cell
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
        const auto& corners = mesh_.triangles[t];
        const Vec3 &a = mesh_.vertices[corners[0]], &b = mesh_.vertices[corners[1]], &c = mesh_.vertices[corners[2]];
        const glm::ivec3 from(glm::floor((glm::min(glm::min(a, b), c) - reach_ - grid_.low) / grid_.cell));
        const glm::ivec3 to(glm::floor((glm::max(glm::max(a, b), c) + reach_ - grid_.low) / grid_.cell));
        const glm::ivec3 first = glm::max(from, glm::ivec3(0)), last = glm::min(to, grid_.cells - 1);
        for (int z = first.z; z <= last.z; ++z)
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x) {
                    const Vec3 middle = grid_.low + grid_.cell * (Vec3(x, y, z) + 0.5);
                    if (closestOn(t, middle).feature.distance <= within)
                        visit(std::size_t(x) + std::size_t(grid_.cells.x) *
                                                   (std::size_t(y) + std::size_t(grid_.cells.y) * std::size_t(z)),
                              t);
                }
    }
}

void MeshSurface::makeGrid() {
    Vec3 low = mesh_.vertices.front(), high = low;
    for (const Vec3& v : mesh_.vertices) {
        low = glm::min(low, v);
        high = glm::max(high, v);
    }
    grid_.low = low - reach_;
    const Vec3 size = high - low + 2 * reach_;
    grid_.cell = cellSize(size);
    grid_.cells = glm::ivec3(glm::floor(size / grid_.cell)) + 1;
    grid_.first.assign(std::size_t(grid_.cells.x) * std::size_t(grid_.cells.y) * std::size_t(grid_.cells.z) + 1, 0);
    forEachEntry([&](std::size_t cell, std::uint32_t) { ++grid_.first[cell + 1]; });
    std::partial_sum(grid_.first.begin(), grid_.first.end(), grid_.first.begin());
    grid_.triangles.resize(grid_.first.back());
    std::vector<std::uint32_t> next(grid_.first.begin(), grid_.first.end() - 1);
    forEachEntry([&](std::size_t cell, std::uint32_t t) { grid_.triangles[next[cell]++] = t; });
}

}  // namespace vkdose::geometry
