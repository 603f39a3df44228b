#include "geometry/mending.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "geometry/point_tree.h"
#include "host/core/printable.h"

namespace vkdose::geometry {

namespace {

constexpr std::size_t kPlacesShown = 4;  // of the faults of one kind
/// A triangle is cut at one of its edges in a round. More rounds than these are none of a mesh that somebody drew.
constexpr int kMostRounds = 40;
/// Vertices on the edges of others, for each vertex at an open edge: on a seam between two parts each is on one or two.
constexpr std::size_t kCutsForVertex = 4;

using Pair = std::array<std::uint32_t, 2>;

Pair pairOf(std::uint32_t a, std::uint32_t b) {
    return {std::min(a, b), std::max(a, b)};
}

class Mender {
  public:
    Mender(Draft& draft, const TriangleSoup& soup, double tolerance)
        : draft_(draft), soup_(soup), tolerance_(tolerance) {}

    Mends mend() {
        for (int round = 0;; ++round) {
            leaveOutFlat(round == 0);
            leaveOutDoubles();
            if (draft_.triangles.empty()) refuse("nothing of the mesh is left");
            findSides();
            if (!cut()) break;
            if (round == kMostRounds) refuse("the cuts there come to no end");
        }
        if (changed_) dropUnused();
        return mends_;
    }

  private:
    using Corners = std::array<std::uint32_t, 3>;
    /// A side of a triangle; sorted, those of one edge stand beside each other.
    struct Side {
        Pair ends;
        std::uint32_t triangle;
        bool operator<(const Side& other) const {
            return std::tie(ends, triangle) < std::tie(other.ends, other.triangle);
        }
    };

    const Vec3& at(std::uint32_t v) const { return draft_.vertices[v]; }
    std::string placed(std::size_t t, const Vec3& where) const { return placeOf(soup_, draft_.origins[t], where); }
    Vec3 middle(const Corners& t) const { return (at(t[0]) + at(t[1]) + at(t[2])) / 3.0; }

    [[noreturn]] void refuse(const char* why) const {
        std::string faults;
        mends_.flat.tell("triangle without area", "triangles without area", faults);
        mends_.doubled.tell("triangle that stands there twice", "triangles that stand there twice", faults);
        mends_.onEdges.tell("vertex on the middle of another triangle's edge",
                            "vertices on the middle of another triangle's edge", faults);
        throw MeshError(
            fmt::format("{}: {}; {}. Corners within {:.3g} m count as one. Repair the mesh, or export it with shared "
                        "corners",
                        printable(soup_.name), faults, why, tolerance_));
    }

    bool hasArea(const Corners& t) const {
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return false;
        const Vec3 a = at(t[0]), b = at(t[1]), c = at(t[2]);
        const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
        return glm::length(glm::cross(b - a, c - a)) > tolerance_ * longest;
    }

    /// Those of the file are told, those that a cut leaves are not.
    void leaveOutFlat(bool told) {
        keepIf([&](std::size_t t) {
            const Corners& c = draft_.triangles[t];
            if (hasArea(c)) return true;
            if (told) mends_.flat.add(placed(t, middle(c)));
            bend(c);
            return false;
        });
    }

    /// Behind a flat triangle of three vertices two edges face a long one, which has to have the third vertex too.
    void bend(const Corners& c) {
        if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) return;
        const double side[] = {glm::length(at(c[1]) - at(c[0])), glm::length(at(c[2]) - at(c[1])),
                               glm::length(at(c[0]) - at(c[2]))};
        const auto longest = std::size_t(std::max_element(side, side + 3) - side);
        const std::uint32_t third = c[(longest + 2) % 3];
        behindFlat_[pairOf(c[longest], c[(longest + 1) % 3])].push_back(third);
        ofFlat_.insert(third);
    }

    void leaveOutDoubles() {
        std::vector<std::pair<Corners, std::size_t>> sorted;
        for (std::size_t t = 0; t < draft_.triangles.size(); ++t) {
            Corners c = draft_.triangles[t];
            std::sort(c.begin(), c.end());
            sorted.emplace_back(c, t);
        }
        std::sort(sorted.begin(), sorted.end());
        std::vector<bool> again(draft_.triangles.size(), false);
        for (std::size_t i = 1; i < sorted.size(); ++i)
            if (sorted[i].first == sorted[i - 1].first) again[sorted[i].second] = true;
        keepIf([&](std::size_t t) {
            if (again[t]) mends_.doubled.add(placed(t, middle(draft_.triangles[t])));
            return !again[t];
        });
    }

    template <class Condition>
    void keepIf(const Condition& keep) {
        std::size_t kept = 0;
        for (std::size_t t = 0; t < draft_.triangles.size(); ++t) {
            if (!keep(t)) continue;
            draft_.triangles[kept] = draft_.triangles[t];
            draft_.origins[kept++] = draft_.origins[t];
        }
        changed_ = changed_ || kept < draft_.triangles.size();
        draft_.triangles.resize(kept);
        draft_.origins.resize(kept);
    }

    void findSides() {
        sides_.clear();
        for (std::uint32_t t = 0; t < draft_.triangles.size(); ++t)
            for (int i = 0; i < 3; ++i)
                sides_.push_back({pairOf(draft_.triangles[t][i], draft_.triangles[t][(i + 1) % 3]), t});
        std::sort(sides_.begin(), sides_.end());
    }

    /// Calls visit(first, last) for the sides of each edge.
    template <class Visit>
    void forEachEdge(const Visit& visit) const {
        for (std::size_t first = 0, last = 0; first < sides_.size(); first = last) {
            while (last < sides_.size() && sides_[last].ends == sides_[first].ends) ++last;
            visit(first, last);
        }
    }

    std::vector<std::uint32_t> openVertices() const {
        std::vector<std::uint32_t> open;
        forEachEdge([&](std::size_t first, std::size_t last) {
            if (last == first + 1) open.insert(open.end(), sides_[first].ends.begin(), sides_[first].ends.end());
        });
        std::sort(open.begin(), open.end());
        open.erase(std::unique(open.begin(), open.end()), open.end());
        return open;
    }

    double share(const Pair& ends, std::uint32_t v) const {
        const Vec3 a = at(ends[0]), along = at(ends[1]) - a;
        return glm::dot(at(v) - a, along) / glm::dot(along, along);
    }

    /// Cuts triangles at vertices on their edges, each at one edge; false if nothing was to be cut.
    bool cut() {
        const std::vector<std::uint32_t> open = openVertices();
        if (mostCuts_ == 0) mostCuts_ = kCutsForVertex * open.size() + draft_.triangles.size();
        const PointTree tree(draft_.vertices, open);
        std::vector<bool> used(draft_.vertices.size(), false), done(draft_.triangles.size(), false);
        for (const Corners& t : draft_.triangles)
            for (const std::uint32_t v : t) used[v] = true;
        bool any = false;
        forEachEdge([&](std::size_t first, std::size_t last) {
            const Pair ends = sides_[first].ends;
            std::vector<std::uint32_t> found;
            if (const auto known = behindFlat_.find(ends); known != behindFlat_.end())
                for (const std::uint32_t v : known->second)
                    if (used[v]) found.push_back(v);
            std::sort(found.begin(), found.end());
            if (last == first + 1 && !done[sides_[first].triangle])
                addOnEdge(tree, ends, sides_[first].triangle, found);
            if (found.empty()) return;
            std::sort(found.begin(), found.end(), [&](std::uint32_t v, std::uint32_t w) {
                return std::pair(share(ends, v), v) < std::pair(share(ends, w), w);
            });
            found.erase(std::unique(found.begin(), found.end()), found.end());
            for (std::size_t i = first; i < last; ++i) {
                any = true;
                const std::uint32_t t = sides_[i].triangle;
                if (!done[t]) cutTriangle(t, ends, found);
                done[t] = true;
            }
        });
        changed_ = changed_ || any;
        return any;
    }

    /// Adds the vertices on the open edge of a triangle to those that are there, which are sorted.
    void addOnEdge(const PointTree& tree, const Pair& ends, std::uint32_t triangle, std::vector<std::uint32_t>& found) {
        const Vec3 a = at(ends[0]), along = at(ends[1]) - a;
        const auto known = std::ptrdiff_t(found.size());
        tree.near(a, a + along, tolerance_, [&](std::uint32_t v) {
            if (v == ends[0] || v == ends[1]) return;
            const double s = share(ends, v);
            if (s <= 0 || s >= 1 || glm::length(at(v) - a - s * along) > tolerance_) return;
            if (std::binary_search(found.begin(), found.begin() + known, v)) return;
            if (!ofFlat_.contains(v)) mends_.onEdges.add(placed(triangle, at(v)));
            found.push_back(v);
        });
    }

    void cutTriangle(std::uint32_t t, const Pair& ends, std::vector<std::uint32_t> chain) {
        if ((cuts_ += chain.size()) > mostCuts_) {
            for (const std::uint32_t v : chain) mends_.onEdges.add(placed(t, at(v)));
            refuse("these are too many to cut the triangles there");
        }
        const Corners c = draft_.triangles[t];
        int i = 0;
        while (pairOf(c[i], c[(i + 1) % 3]) != ends) ++i;
        if (c[i] != ends[0]) std::reverse(chain.begin(), chain.end());
        chain.insert(chain.begin(), c[i]);
        chain.push_back(c[(i + 1) % 3]);
        for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
            const Corners part{chain[k], chain[k + 1], c[(i + 2) % 3]};
            if (k == 0) {
                draft_.triangles[t] = part;
                continue;
            }
            draft_.triangles.push_back(part);
            draft_.origins.push_back(draft_.origins[t]);
        }
    }

    void dropUnused() {
        std::vector<bool> used(draft_.vertices.size(), false);
        for (const Corners& t : draft_.triangles)
            for (const std::uint32_t v : t) used[v] = true;
        std::vector<std::uint32_t> number(draft_.vertices.size());
        std::uint32_t next = 0;
        for (std::size_t v = 0; v < used.size(); ++v) {
            if (!used[v]) continue;
            draft_.vertices[next] = draft_.vertices[v];
            number[v] = next++;
        }
        draft_.vertices.resize(next);
        for (Corners& t : draft_.triangles)
            for (std::uint32_t& v : t) v = number[v];
    }

    Draft& draft_;
    const TriangleSoup& soup_;
    double tolerance_;
    Mends mends_;
    std::vector<Side> sides_;
    std::map<Pair, std::vector<std::uint32_t>> behindFlat_;
    std::set<std::uint32_t> ofFlat_;  ///< that cuts are needed at these follows from what was left out
    std::size_t cuts_ = 0, mostCuts_ = 0;
    bool changed_ = false;
};

}  // namespace

void Tally::add(const std::string& place) {
    if (count_++ < kPlacesShown) places_ += (places_.empty() ? "" : ", ") + place;
}

void Tally::tell(const char* one, const char* several, std::string& text) const {
    if (count_ == 0) return;
    text += fmt::format("{}{} {} ({} {})", text.empty() ? "" : "; ", count_, count_ == 1 ? one : several,
                        count_ > kPlacesShown ? "first at" : "at", places_);
}

std::string placeOf(const TriangleSoup& soup, std::size_t triangle, const Vec3& at) {
    const Vec3 p = at / soup.metresPerUnit;
    return fmt::format("{} ({:.6g}, {:.6g}, {:.6g})", soup.place(triangle), p.x, p.y, p.z);
}

Mends mend(Draft& draft, const TriangleSoup& soup, double tolerance) {
    return Mender(draft, soup, tolerance).mend();
}

}  // namespace vkdose::geometry
