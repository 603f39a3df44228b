#include "geometry/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "geometry/mending.h"
#include "geometry/seams.h"
#include "geometry/welder.h"
#include "host/core/printable.h"

namespace vkdose::geometry {

namespace {

class MeshMaker {
  public:
    MeshMaker(const TriangleSoup& soup, double tolerance) : soup_(soup), tolerance_(tolerance) {}

    CheckedMesh make() {
        weld();
        mends_ = mend(draft_, soup_, tolerance_);
        mesh_.vertices = std::move(draft_.vertices);
        mesh_.triangles = std::move(draft_.triangles);
        findEdges();
        findNeighbours();
        sew();
        measure();
        tell();
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
            draft_.triangles.push_back(corners);
            draft_.origins.push_back(draft_.origins.size());
        }
        draft_.vertices = welder.take();
    }

    void findEdges() {
        std::map<std::array<std::uint32_t, 2>, std::uint32_t> known;
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
                    crowds_[entry->second].push_back(t);
                    continue;
                }
                edge.faces[1] = t;
            }
        }
        for (auto& [e, faces] : crowds_) {
            const auto& first = mesh_.edges[e].faces;
            faces.insert(faces.begin(), first.begin(), first.end());
        }
        facts_.edges = mesh_.edges.size();
        facts_.seams = crowds_.size();
        facts_.openEdges = std::size_t(std::count_if(mesh_.edges.begin(), mesh_.edges.end(),
                                                     [](const MeshEdge& e) { return e.faces[1] == kNoFace; }));
    }

    void sew() {
        mesh_.closed = facts_.openEdges == 0;
        for (const auto& [e, faces] : crowds_) {
            const auto [a, b] = mesh_.edges[e].vertices;
            seams_.add(placeOf(soup_, draft_.origins[faces.front()], 0.5 * (at(a) + at(b))));
        }
        Seams seams(mesh_, crowds_);
        seams.sew();
        if (mesh_.closed && !crowds_.empty()) mesh_.closed = seams.turnOutwards();
    }

    bool isInner(std::uint32_t t) const { return std::binary_search(mesh_.inner.begin(), mesh_.inner.end(), t); }

    /// Whether the two triangles of an edge agree on which side is outside. At a seam there is nothing to agree on.
    bool agrees(std::uint32_t e) const {
        const auto& [ends, faces, hidden] = mesh_.edges[e];
        if (faces[1] == kNoFace || hidden || crowds_.contains(e) || isInner(faces[0]) || isInner(faces[1]))
            return true;
        return runsAlong(mesh_, faces[0], ends[0], ends[1]) != runsAlong(mesh_, faces[1], ends[0], ends[1]);
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
        facts_.closed = mesh_.closed;
        facts_.oriented = true;
        for (std::uint32_t e = 0; e < mesh_.edges.size() && facts_.oriented; ++e) facts_.oriented = agrees(e);
        facts_.low = facts_.high = mesh_.vertices.front();
        for (const Vec3& v : mesh_.vertices) {
            facts_.low = glm::min(facts_.low, v);
            facts_.high = glm::max(facts_.high, v);
        }
        const Vec3 middle = 0.5 * (facts_.low + facts_.high);  // small numbers keep their digits
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            const auto& v = mesh_.triangles[t];
            const Vec3 a = at(v[0]) - middle, b = at(v[1]) - middle, c = at(v[2]) - middle;
            facts_.area += glm::length(glm::cross(b - a, c - a)) / 2;
            if (facts_.closed && facts_.oriented && !isInner(t)) facts_.volume += glm::dot(a, glm::cross(b, c)) / 6;
        }
    }

    void tell() {
        std::string& said = facts_.mended;
        said = soup_.passedOver;
        mends_.flat.tell("triangle without area left out", "triangles without area left out", said);
        mends_.doubled.tell("triangle left out that stands there twice", "triangles left out that stand there twice",
                            said);
        mends_.onEdges.tell("triangle cut at a vertex on its edge", "cuts of triangles at vertices on their edges",
                            said);
        seams_.tell("edge of more than two triangles made a seam", "edges of more than two triangles made seams", said);
    }

    const TriangleSoup& soup_;
    double tolerance_;
    Draft draft_;
    Mends mends_;
    Mesh mesh_;
    MeshFacts facts_;
    Crowds crowds_;
    Tally seams_;
};

}  // namespace

std::string MeshFacts::text() const {
    const Vec3 size = 1e3 * (high - low);
    std::string said = fmt::format("{} triangles, {:.4g} x {:.4g} x {:.4g} mm, area {:.4g} cm2, ", triangles, size.x,
                                   size.y, size.z, 1e4 * area);
    said += closed ? "closed" : openEdges > 0 ? fmt::format("{} open edges", openEdges) : "not closed";
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
