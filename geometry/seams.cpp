#include "geometry/seams.h"

#include <algorithm>
#include <cmath>

namespace vkdose::geometry {

namespace {

/// Two triangles that leave this much to a flat angle are one flat surface [rad]: the kSquare of the device.
constexpr double kFlat = 1e-6;

std::uint32_t otherSide(std::uint32_t side) {
    return side ^ 1U;
}

}  // namespace

bool runsAlong(const Mesh& mesh, std::uint32_t t, std::uint32_t a, std::uint32_t b) {
    const auto& c = mesh.triangles[t];
    for (int i = 0; i < 3; ++i)
        if (c[i] == a && c[(i + 1) % 3] == b) return true;
    return false;
}

Seams::Seams(Mesh& mesh, const Crowds& crowds) : mesh_(mesh), crowds_(crowds) {}

std::vector<Seams::Ray> Seams::around(std::uint32_t edge, const std::vector<std::uint32_t>& faces) const {
    const auto& ends = mesh_.edges[edge].vertices;
    const Vec3 a = mesh_.vertices[ends[0]], along = glm::normalize(mesh_.vertices[ends[1]] - a);
    Vec3 x(0), y(0);
    std::vector<Ray> rays;
    for (const std::uint32_t f : faces) {
        Vec3 into(0);
        for (const std::uint32_t v : mesh_.triangles[f])
            if (v != ends[0] && v != ends[1]) into = mesh_.vertices[v] - a;
        into -= glm::dot(into, along) * along;
        if (rays.empty()) {
            x = glm::normalize(into);
            y = glm::cross(along, x);
        }
        rays.push_back({f, rays.empty() ? 0 : std::atan2(glm::dot(into, y), glm::dot(into, x))});
    }
    std::sort(rays.begin(), rays.end(),
              [](const Ray& p, const Ray& q) { return std::pair(p.angle, p.face) < std::pair(q.angle, q.face); });
    return rays;
}

void Seams::sew() {
    for (const auto& [edge, faces] : crowds_) {
        std::vector<Ray> rays = around(edge, faces);
        // A sphere has its nearest place on the edge only where no face is within a right angle of the way to it: where
        // the widest gap between two faces is a half turn at least.
        std::size_t widest = 0;
        double gap = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const double to = i + 1 < rays.size() ? rays[i + 1].angle : rays[0].angle + 2 * kPi;
            if (to - rays[i].angle <= gap) continue;
            gap = to - rays[i].angle;
            widest = i;
        }
        // The two faces at the gap come first.
        std::rotate(rays.begin(), rays.begin() + std::ptrdiff_t((widest + 1) % rays.size()), rays.end());
        std::vector<std::uint32_t> ring;
        for (const Ray& r : rays) ring.push_back(r.face);
        addEntry(edge, true, {ring.back(), ring.front()}, gap < kPi - kFlat);
        for (std::size_t i = 1; i + 1 < ring.size(); i += 2)
            addEntry(edge, false, {ring[i], i + 2 < ring.size() ? ring[i + 1] : kNoFace}, true);
        rings_.push_back(std::move(ring));
    }
}

void Seams::addEntry(std::uint32_t crowd, bool first, std::array<std::uint32_t, 2> faces, bool hidden) {
    const auto entry = first ? crowd : std::uint32_t(mesh_.edges.size());
    if (!first) mesh_.edges.push_back({mesh_.edges[crowd].vertices, {}});
    mesh_.edges[entry].faces = faces;
    mesh_.edges[entry].hidden = hidden;
    for (const std::uint32_t f : faces) {
        if (f == kNoFace) continue;
        for (std::uint32_t& e : mesh_.edgesOf[f])
            if (mesh_.edges[e].vertices == mesh_.edges[crowd].vertices) e = entry;
    }
}

/// The space between neighbours of a ring leads from one to the next. About the edge by the right hand a triangle that
/// runs from its first vertex to its second turns the side 2 t towards the next one.
void Seams::join(const std::vector<std::uint32_t>& ring, const std::array<std::uint32_t, 2>& ends) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::uint32_t f = ring[i], g = ring[(i + 1) % ring.size()];
        const std::uint32_t from = 2 * f + (runsAlong(mesh_, f, ends[0], ends[1]) ? 0 : 1);
        const std::uint32_t to = 2 * g + (runsAlong(mesh_, g, ends[0], ends[1]) ? 1 : 0);
        next_[from].push_back(to);
        next_[to].push_back(from);
    }
}

/// A side of the triangles of a part that has the outside of it before it: the last that a line from somewhere on it
/// passes. The line is oblique, so that it does not run along a face or into an edge.
std::uint32_t Seams::outermost(const std::vector<std::uint32_t>& part) const {
    const auto corner = [&](std::uint32_t t, int i) { return mesh_.vertices[mesh_.triangles[t][std::size_t(i)]]; };
    const auto square = [&](std::uint32_t t) {
        return glm::cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
    };
    const std::uint32_t first = *std::max_element(part.begin(), part.end(), [&](std::uint32_t s, std::uint32_t t) {
        return glm::length(square(s)) < glm::length(square(t));
    });
    const Vec3 from = 0.31 * corner(first, 0) + 0.337 * corner(first, 1) + 0.353 * corner(first, 2);
    const Vec3 way = glm::normalize(glm::normalize(square(first)) + Vec3(0.0137, 0.0291, 0.0193));
    std::uint32_t last = first;
    double farthest = 0;
    for (const std::uint32_t t : part) {
        if (t == first) continue;
        const Vec3 n = square(t);
        const double across = glm::dot(n, way);
        if (across == 0) continue;
        const double far = glm::dot(n, corner(t, 0) - from) / across;
        if (far <= farthest) continue;
        bool within = true;
        for (int i = 0; i < 3 && within; ++i) {
            const Vec3 a = corner(t, i), b = corner(t, (i + 1) % 3);
            within = glm::dot(glm::cross(b - a, from + far * way - a), n) >= 0;
        }
        if (!within) continue;
        farthest = far;
        last = t;
    }
    return 2 * last + (glm::dot(square(last), way) > 0 ? 0 : 1);
}

bool Seams::turnOutwards() {
    const std::size_t count = mesh_.triangles.size();
    next_.assign(2 * count, {});
    for (std::uint32_t e = 0; e < mesh_.edges.size(); ++e) {
        const MeshEdge& edge = mesh_.edges[e];
        if (edge.faces[1] != kNoFace && !edge.hidden && !crowds_.contains(e))
            join({edge.faces[0], edge.faces[1]}, edge.vertices);
    }
    std::size_t k = 0;
    std::vector<bool> atSeam(count, false);
    for (const auto& [e, faces] : crowds_) {
        join(rings_[k++], mesh_.edges[e].vertices);
        for (const std::uint32_t f : faces) atSeam[f] = true;
    }
    // Parts: what holds together over edges.
    std::vector<std::uint32_t> waiting;
    const auto spread = [&](std::vector<bool>& met, bool bothSides) {
        std::vector<std::uint32_t> found = waiting;
        while (!waiting.empty()) {
            const std::uint32_t side = waiting.back();
            waiting.pop_back();
            const auto visit = [&](std::uint32_t to) {
                if (met[to]) return;
                met[to] = true;
                waiting.push_back(to);
                found.push_back(to);
            };
            for (const std::uint32_t to : next_[side]) visit(to);
            if (bothSides) visit(otherSide(side));
        }
        return found;
    };
    std::vector<bool> met(2 * count, false), outside(2 * count, false);
    bool closed = true;
    for (std::uint32_t t = 0; t < count; ++t) {
        const std::uint32_t front = 2 * t;
        if (met[front]) continue;
        met[front] = true;
        waiting = {front};
        std::vector<std::uint32_t> part;
        for (const std::uint32_t side : spread(met, true))
            if (side % 2 == 0) part.push_back(side / 2);
        if (std::none_of(part.begin(), part.end(), [&](std::uint32_t f) { return bool(atSeam[f]); })) continue;
        waiting = {outermost(part)};
        outside[waiting.front()] = true;
        spread(outside, false);
        for (const std::uint32_t f : part) {
            const std::uint32_t side = 2 * f, other = side + 1;
            if (outside[side] && outside[other]) closed = false;
            if (!outside[side] && !outside[other]) mesh_.inner.push_back(f);
        }
    }
    std::sort(mesh_.inner.begin(), mesh_.inner.end());
    if (!closed) {
        mesh_.inner.clear();
        return false;
    }
    for (std::uint32_t t = 0; t < count; ++t) {
        if (!outside[2 * t + 1]) continue;
        std::swap(mesh_.triangles[t][0], mesh_.triangles[t][1]);
        std::swap(mesh_.edgesOf[t][1], mesh_.edgesOf[t][2]);
    }
    return true;
}

}  // namespace vkdose::geometry
