#pragma once
// The same surface cut into other triangles: edges are split anywhere along them, both triangles at an edge with it, so
// that the surface stays the same and no corner lies on the middle of an edge.

#include <algorithm>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "geometry/mesh.h"
#include "geometry/mesh_surface.h"

namespace vkdose::test {

class Shattered {
  public:
    explicit Shattered(const std::vector<geometry::Triangle>& surface) {
        const auto made = geometry::makeMesh(geometry::soupOf(surface, "surface"), 1e-9);
        points_ = made.mesh.vertices;
        triangles_ = made.mesh.triangles;
    }

    /// Cuts every triangle into four.
    void refine() {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [at, fresh] = middles.emplace(std::minmax(a, b), std::uint32_t(points_.size()));
            if (fresh) points_.push_back(0.5 * (points_[a] + points_[b]));
            return at->second;
        };
        auto old = std::move(triangles_);
        triangles_.clear();
        for (const auto& [a, b, c] : old) {
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            for (const auto& t : {std::array{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}})
                triangles_.push_back(t);
        }
    }

    /// Splits edges at random, each at a share between `least` and 1 - least of it; a small one makes needles.
    void split(std::mt19937_64& random, int times, double least) {
        using Edge = std::pair<std::uint32_t, std::uint32_t>;
        std::map<Edge, std::vector<std::size_t>> at;
        const auto edge = [](std::uint32_t a, std::uint32_t b) { return Edge(std::min(a, b), std::max(a, b)); };
        for (std::size_t t = 0; t < triangles_.size(); ++t)
            for (int i = 0; i < 3; ++i) at[edge(triangles_[t][i], triangles_[t][(i + 1) % 3])].push_back(t);
        for (int n = 0; n < times; ++n) {
            const auto& t = triangles_[random() % triangles_.size()];
            const auto i = random() % 3;
            const Edge cut = edge(t[i], t[(i + 1) % 3]);
            const double farthest = random() % 2 != 0 ? 1 - least : 2 * least;
            const double share = std::uniform_real_distribution<double>(least, farthest)(random);
            const Vec3 here = points_[cut.first] + share * (points_[cut.second] - points_[cut.first]);
            // Needles, but none of them so thin that its normal has lost its digits.
            const bool tooThin = std::any_of(at[cut].begin(), at[cut].end(), [&](std::size_t f) {
                Vec3 third(0);
                for (const std::uint32_t v : triangles_[f])
                    if (v != cut.first && v != cut.second) third = points_[v];
                return thinness(points_[cut.first], here, third) < 1e-5 ||
                       thinness(points_[cut.second], here, third) < 1e-5;
            });
            if (tooThin) continue;
            const auto p = std::uint32_t(points_.size());
            points_.push_back(here);
            for (const std::size_t f : std::vector<std::size_t>(at[cut])) {
                auto near = triangles_[f], far = near;
                std::uint32_t third = 0;
                for (const std::uint32_t v : near)
                    if (v != cut.first && v != cut.second) third = v;
                std::replace(near.begin(), near.end(), cut.second, p);
                std::replace(far.begin(), far.end(), cut.first, p);
                triangles_[f] = near;
                triangles_.push_back(far);
                auto& moved = at[edge(cut.second, third)];
                std::replace(moved.begin(), moved.end(), f, triangles_.size() - 1);
                at[edge(p, third)] = {f, triangles_.size() - 1};
                at[edge(cut.first, p)].push_back(f);
                at[edge(p, cut.second)].push_back(triangles_.size() - 1);
            }
            at.erase(cut);
        }
    }

    geometry::Mesh mesh() const {
        geometry::TriangleSoup soup;
        soup.name = "shattered";
        soup.points = points_;
        soup.triangles = triangles_;
        soup.places.resize(triangles_.size());
        return geometry::makeMesh(soup, 1e-12).mesh;
    }
    std::size_t size() const { return triangles_.size(); }

  private:
    /// Height over the longest side, over that side.
    static double thinness(const Vec3& a, const Vec3& b, const Vec3& c) {
        const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
        return glm::length(glm::cross(b - a, c - a)) / (longest * longest);
    }

    std::vector<Vec3> points_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
};

/// Ten triangulations of one surface: as it is, coarse, fine, with needles, all of these.
inline std::vector<geometry::Mesh> tenTriangulations(const std::vector<geometry::Triangle>& surface) {
    struct Way {
        int refinements, splits;
        double least;
    };
    constexpr Way kWays[] = {{0, 0, 0},     {0, 3, 0.3}, {0, 20, 0.1},   {0, 100, 1e-3}, {0, 200, 0.4},
                             {1, 50, 1e-4}, {2, 0, 0},   {2, 100, 0.01}, {3, 0, 0},      {3, 300, 1e-3}};
    std::vector<geometry::Mesh> meshes;
    std::mt19937_64 random(5);
    for (const Way& way : kWays) {
        Shattered s(surface);
        for (int i = 0; i < way.refinements && s.size() < 3000; ++i) s.refine();
        s.split(random, way.splits, way.least);
        meshes.push_back(s.mesh());
    }
    return meshes;
}

}  // namespace vkdose::test
