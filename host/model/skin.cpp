#include "host/model/skin.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

namespace vkdose {

using geometry::Triangle;

namespace {

const double kSmooth = std::cos(kPi / 6);  // triangles that meet at less than 30 degrees are one smooth surface

/// Corners of the same place get the same number.
class Corners {
  public:
    std::uint32_t number(const Vec3& x) {
        return known_.emplace(std::tuple(x.x, x.y, x.z), std::uint32_t(known_.size())).first->second;
    }
    std::size_t size() const { return known_.size(); }

  private:
    std::map<std::tuple<double, double, double>, std::uint32_t> known_;
};

Vec3 normalOf(const Triangle& t) {
    const Vec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double length = glm::length(normal);
    return length > 0 ? normal / length : Vec3(0, 0, 1);
}

}  // namespace

bool Edge::sharp() const {
    return faces != 2 || glm::dot(into[0], into[1]) > -kSmooth;
}

bool Edge::onLimb(const Vec3& towards) const {
    const Vec3 side = glm::cross(to - from, towards);
    return faces == 2 && glm::dot(side, into[0]) * glm::dot(side, into[1]) > 0;
}

void Skin::add(const Skin& more) {
    facets.insert(facets.end(), more.facets.begin(), more.facets.end());
    edges.insert(edges.end(), more.edges.begin(), more.edges.end());
}

Skin skinOf(const std::vector<Triangle>& mesh, bool solid) {
    Corners corners;
    std::vector<std::array<std::uint32_t, 3>> numbers;
    std::vector<Vec3> normals;
    for (const Triangle& t : mesh) {
        numbers.push_back({corners.number(t[0]), corners.number(t[1]), corners.number(t[2])});
        normals.push_back(normalOf(t));
    }
    std::vector<std::vector<std::uint32_t>> facesAt(corners.size());
    for (std::uint32_t i = 0; i < numbers.size(); ++i)
        for (const std::uint32_t corner : numbers[i]) facesAt[corner].push_back(i);

    Skin skin;
    std::map<std::pair<std::uint32_t, std::uint32_t>, Edge> edges;
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        Facet facet{mesh[i], {}, solid};
        for (std::size_t k = 0; k < 3; ++k) {
            Vec3 sum(0);
            for (const std::uint32_t face : facesAt[numbers[i][k]])
                if (glm::dot(normals[face], normals[i]) > kSmooth) sum += normals[face];
            facet.normals[k] = glm::normalize(sum);

            const Vec3 &a = mesh[i][k], &b = mesh[i][(k + 1) % 3], &c = mesh[i][(k + 2) % 3];
            const auto ends = std::minmax(numbers[i][k], numbers[i][(k + 1) % 3]);
            Edge& edge = edges.try_emplace(std::pair(ends.first, ends.second), Edge{a, b, {}, 0}).first->second;
            const Vec3 along = glm::normalize(b - a), into = (c - a) - glm::dot(c - a, along) * along;
            if (edge.faces < 2) edge.into[std::size_t(edge.faces)] = glm::normalize(into);
            ++edge.faces;
        }
        skin.facets.push_back(facet);
    }
    for (const auto& [ends, edge] : edges) skin.edges.push_back(edge);
    return skin;
}

Skin placed(Skin skin, const geometry::Pose& pose) {
    for (Facet& f : skin.facets)
        for (std::size_t k = 0; k < 3; ++k) {
            f.corners[k] = pose.toWorld(f.corners[k]);
            f.normals[k] = pose.directionToWorld(f.normals[k]);
        }
    for (Edge& e : skin.edges) {
        e.from = pose.toWorld(e.from);
        e.to = pose.toWorld(e.to);
        for (Vec3& into : e.into) into = pose.directionToWorld(into);
    }
    return skin;
}

}  // namespace vkdose
