#include "geometry/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>

#include "host/core/printable.h"

namespace vkdose::geometry {

namespace {

constexpr std::size_t kPlacesShown = 4;          // of the faults of one kind
constexpr std::size_t kTJunctionsSought = 1000;  // more are not counted: each one takes a search

/// Faults of one kind.
class Faults {
  public:
    void add(const std::string& place) {
        if (count_++ < kPlacesShown) places_ += (places_.empty() ? "" : ", ") + place;
    }
    void tell(const char* kind, std::string& text) const {
        if (count_ == 0) return;
        text += fmt::format("{}{} {} (first at {})", text.empty() ? "" : "; ", count_, kind, places_);
    }

  private:
    std::size_t count_ = 0;
    std::string places_;
};

/// Makes points that are closer to each other than the tolerance one: the first that was met.
class Welder {
  public:
    explicit Welder(double tolerance) : tolerance_(tolerance) {}

    std::uint32_t add(const Vec3& p) {
        const Cell c{std::floor(p.x / tolerance_), std::floor(p.y / tolerance_), std::floor(p.z / tolerance_)};
        std::uint32_t best = kNoFace;
        for (int n = 0; n < 27; ++n) {
            const auto found = cells_.find({c[0] + n % 3 - 1, c[1] + n / 3 % 3 - 1, c[2] + n / 9 - 1});
            if (found == cells_.end()) continue;
            for (const std::uint32_t v : found->second)
                if (glm::length(vertices_[v] - p) <= tolerance_) best = std::min(best, v);
        }
        if (best != kNoFace) return best;
        vertices_.push_back(p);
        cells_[c].push_back(static_cast<std::uint32_t>(vertices_.size() - 1));
        return static_cast<std::uint32_t>(vertices_.size() - 1);
    }
    std::vector<Vec3> take() { return std::move(vertices_); }

  private:
    using Cell = std::array<double, 3>;
    struct CellHash {
        std::size_t operator()(const Cell& c) const {
            std::size_t hash = 0;
            for (const double x : c) hash = hash * 1000003U ^ std::hash<double>()(x == 0 ? 0 : x);
            return hash;
        }
    };
    double tolerance_;
    std::vector<Vec3> vertices_;
    std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells_;
};

/// Finds points near a segment: a tree of boxes, halved at the median, so that no arrangement of points makes it slow.
class PointTree {
  public:
    PointTree(const std::vector<Vec3>& points, std::vector<std::uint32_t> chosen)
        : points_(points), order_(std::move(chosen)) {
        if (!order_.empty()) build(0, order_.size());
    }

    /// Calls `visit` for every point that may lie within `reach` of the segment from a to b.
    template <class Visit>
    void near(const Vec3& a, const Vec3& b, double reach, const Visit& visit) const {
        if (!nodes_.empty()) descend(0, glm::min(a, b) - reach, glm::max(a, b) + reach, a, b, reach, visit);
    }

  private:
    struct Node {
        Vec3 low, high;
        std::size_t begin, end;
        std::size_t right = 0;  ///< 0 at a leaf; the left child follows its parent
    };
    static constexpr std::size_t kLeaf = 8;

    void build(std::size_t begin, std::size_t end) {
        const std::size_t me = nodes_.size();
        nodes_.push_back({points_[order_[begin]], points_[order_[begin]], begin, end});
        for (std::size_t i = begin; i < end; ++i) {
            nodes_[me].low = glm::min(nodes_[me].low, points_[order_[i]]);
            nodes_[me].high = glm::max(nodes_[me].high, points_[order_[i]]);
        }
        if (end - begin <= kLeaf) return;
        const Vec3 size = nodes_[me].high - nodes_[me].low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::size_t middle = begin + (end - begin) / 2;
        std::nth_element(order_.begin() + std::ptrdiff_t(begin), order_.begin() + std::ptrdiff_t(middle),
                         order_.begin() + std::ptrdiff_t(end),
                         [&](std::uint32_t i, std::uint32_t j) { return points_[i][axis] < points_[j][axis]; });
        build(begin, middle);
        nodes_[me].right = nodes_.size();
        build(middle, end);
    }

    /// Whether the segment passes the box, widened by `reach` (by slabs).
    static bool passes(const Node& n, const Vec3& a, const Vec3& b, double reach) {
        double from = 0, to = 1;
        for (int d = 0; d < 3; ++d) {
            const double way = b[d] - a[d], low = n.low[d] - reach - a[d], high = n.high[d] + reach - a[d];
            if (way == 0) {
                if (low > 0 || high < 0) return false;
                continue;
            }
            from = std::max(from, std::min(low / way, high / way));
            to = std::min(to, std::max(low / way, high / way));
        }
        return from <= to + 1e-9;
    }

    template <class Visit>
    void descend(std::size_t me, const Vec3& low, const Vec3& high, const Vec3& a, const Vec3& b, double reach,
                 const Visit& visit) const {
        const Node& n = nodes_[me];
        if (!passes(n, a, b, reach)) return;
        if (n.right == 0) {
            for (std::size_t i = n.begin; i < n.end; ++i) visit(order_[i]);
            return;
        }
        descend(me + 1, low, high, a, b, reach, visit);
        descend(n.right, low, high, a, b, reach, visit);
    }

    const std::vector<Vec3>& points_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

class MeshMaker {
  public:
    MeshMaker(const TriangleSoup& soup, double tolerance) : soup_(soup), tolerance_(tolerance) {}

    CheckedMesh make() {
        weld();
        findDoubles();
        findEdges();
        refuseFaults();
        findTJunctions();
        refuseFaults();
        findNeighbours();
        measure();
        return {std::move(mesh_), facts_};
    }

  private:
    Vec3 at(std::uint32_t v) const { return mesh_.vertices[v]; }

    void weld() {
        double extent = 0;
        for (const Vec3& p : soup_.points) extent = std::max({extent, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        // The welder counts in tolerances, and whole numbers must be exact.
        tolerance_ = std::max(tolerance_, extent * 0x1p-40);
        Welder welder(tolerance_);
        for (const auto& t : soup_.triangles) {
            std::array<std::uint32_t, 3> corners{};
            for (int i = 0; i < 3; ++i) corners[i] = welder.add(soup_.points[t[i]]);
            mesh_.triangles.push_back(corners);
        }
        mesh_.vertices = welder.take();
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
            if (!hasArea(mesh_.triangles[t])) flat_.add(soup_.place(t));
    }

    bool hasArea(const std::array<std::uint32_t, 3>& t) const {
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return false;
        const Vec3 a = at(t[0]), b = at(t[1]), c = at(t[2]);
        const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
        return glm::length(glm::cross(b - a, c - a)) > tolerance_ * longest;
    }

    void findDoubles() {
        std::map<std::array<std::uint32_t, 3>, std::size_t> known;
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            auto corners = mesh_.triangles[t];
            std::sort(corners.begin(), corners.end());
            if (!known.emplace(corners, t).second) doubled_.add(soup_.place(t));
        }
    }

    void findEdges() {
        std::map<std::array<std::uint32_t, 2>, std::uint32_t> known;
        facts_.oriented = true;
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            mesh_.edgesOf.push_back({});
            for (int i = 0; i < 3; ++i) {
                const std::uint32_t a = mesh_.triangles[t][i], b = mesh_.triangles[t][(i + 1) % 3];
                const auto [entry, fresh] =
                    known.emplace(std::array{std::min(a, b), std::max(a, b)}, std::uint32_t(mesh_.edges.size()));
                if (fresh) mesh_.edges.push_back({entry->first, {t, kNoFace}});
                mesh_.edgesOf[t][i] = entry->second;
                if (fresh) continue;
                MeshEdge& edge = mesh_.edges[entry->second];
                if (edge.faces[1] != kNoFace) {
                    crowded_.add(soup_.place(t));
                    continue;
                }
                edge.faces[1] = t;
                if (runs(edge.faces[0], a, b)) facts_.oriented = false;
            }
        }
    }

    /// Whether triangle `t` has the edge from a to b in this direction.
    bool runs(std::uint32_t t, std::uint32_t a, std::uint32_t b) const {
        const auto& c = mesh_.triangles[t];
        for (int i = 0; i < 3; ++i)
            if (c[i] == a && c[(i + 1) % 3] == b) return true;
        return false;
    }

    void findTJunctions() {
        std::vector<std::uint32_t> atOpenEdges;
        for (const MeshEdge& e : mesh_.edges)
            if (e.faces[1] == kNoFace) atOpenEdges.insert(atOpenEdges.end(), e.vertices.begin(), e.vertices.end());
        std::sort(atOpenEdges.begin(), atOpenEdges.end());
        atOpenEdges.erase(std::unique(atOpenEdges.begin(), atOpenEdges.end()), atOpenEdges.end());
        const PointTree tree(mesh_.vertices, std::move(atOpenEdges));
        std::size_t found = 0;
        for (const MeshEdge& e : mesh_.edges) {
            if (e.faces[1] != kNoFace) continue;
            const Vec3 a = at(e.vertices[0]), along = at(e.vertices[1]) - a;
            const double length2 = glm::dot(along, along);
            tree.near(a, a + along, tolerance_, [&](std::uint32_t v) {
                if (v == e.vertices[0] || v == e.vertices[1] || found >= kTJunctionsSought) return;
                const double share = glm::dot(at(v) - a, along) / length2;
                if (share <= 0 || share >= 1 || glm::length(at(v) - a - share * along) > tolerance_) return;
                tJunctions_.add(soup_.place(e.faces[0]));
                ++found;
            });
            if (found >= kTJunctionsSought) return;
        }
    }

    void refuseFaults() const {
        std::string faults;
        flat_.tell("triangles without area", faults);
        doubled_.tell("triangles that stand there twice", faults);
        crowded_.tell("times a third triangle at an edge", faults);
        tJunctions_.tell("vertices on the middle of another triangle's edge", faults);
        if (!faults.empty())
            throw MeshError(
                fmt::format("{}: {}; corners within {:.3g} m count as one. Repair the mesh, or export it "
                            "with shared corners",
                            printable(soup_.name), faults, tolerance_));
    }

    void findNeighbours() {
        mesh_.firstNeighbour.assign(mesh_.vertices.size() + 1, 0);
        for (const MeshEdge& e : mesh_.edges)
            for (const std::uint32_t v : e.vertices) ++mesh_.firstNeighbour[v + 1];
        std::partial_sum(mesh_.firstNeighbour.begin(), mesh_.firstNeighbour.end(), mesh_.firstNeighbour.begin());
        mesh_.neighbours.resize(2 * mesh_.edges.size());
        std::vector<std::uint32_t> next(mesh_.firstNeighbour.begin(), mesh_.firstNeighbour.end() - 1);
        for (const MeshEdge& e : mesh_.edges)
            for (int i = 0; i < 2; ++i) mesh_.neighbours[next[e.vertices[i]]++] = e.vertices[1 - i];
    }

    void measure() {
        facts_.weldTolerance = tolerance_;
        facts_.cornersRead = soup_.points.size();
        facts_.vertices = mesh_.vertices.size();
        facts_.triangles = mesh_.triangles.size();
        facts_.edges = mesh_.edges.size();
        facts_.openEdges = std::size_t(std::count_if(mesh_.edges.begin(), mesh_.edges.end(),
                                                     [](const MeshEdge& e) { return e.faces[1] == kNoFace; }));
        facts_.closed = facts_.openEdges == 0;
        facts_.low = facts_.high = mesh_.vertices.front();
        for (const Vec3& v : mesh_.vertices) {
            facts_.low = glm::min(facts_.low, v);
            facts_.high = glm::max(facts_.high, v);
        }
        const Vec3 middle = 0.5 * (facts_.low + facts_.high);  // small numbers keep their digits
        for (const auto& t : mesh_.triangles) {
            const Vec3 a = at(t[0]) - middle, b = at(t[1]) - middle, c = at(t[2]) - middle;
            facts_.area += glm::length(glm::cross(b - a, c - a)) / 2;
            if (facts_.closed && facts_.oriented) facts_.volume += glm::dot(a, glm::cross(b, c)) / 6;
        }
    }

    const TriangleSoup& soup_;
    double tolerance_;
    Mesh mesh_;
    MeshFacts facts_;
    Faults flat_, doubled_, crowded_, tJunctions_;
};

}  // namespace

std::string MeshFacts::text() const {
    const Vec3 size = 1e3 * (high - low);
    std::string said = fmt::format("{} triangles, {:.4g} x {:.4g} x {:.4g} mm, area {:.4g} cm2, ", triangles, size.x,
                                   size.y, size.z, 1e4 * area);
    said += closed ? "closed" : fmt::format("{} open edges", openEdges);
    if (!oriented) said += ", sides not consistent";
    if (closed && oriented)
        said += fmt::format(", volume {:.4g} cm3{}", 1e6 * std::abs(volume), volume < 0 ? ", inside out" : "");
    return said + fmt::format("; corners within {:.2g} m made one", weldTolerance);
}

double defaultWeldTolerance(const TriangleSoup& soup) {
    Vec3 low = soup.points.front(), high = low;
    for (const Vec3& p : soup.points) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const double farthest = glm::length(glm::max(glm::abs(low), glm::abs(high)));
    return std::max(1e-6 * glm::length(high - low), 0x1p-21 * farthest);
}

CheckedMesh makeMesh(const TriangleSoup& soup, double weldTolerance) {
    if (!(std::isfinite(weldTolerance) && weldTolerance > 0))
        throw MeshError(
            fmt::format("{}: a welding tolerance of {} m; it must be positive", printable(soup.name), weldTolerance));
    return MeshMaker(soup, weldTolerance).make();
}

CheckedMesh makeMesh(const TriangleSoup& soup) {
    return makeMesh(soup, defaultWeldTolerance(soup));
}

}  // namespace vkdose::geometry
