#include "geometry/tessellate.h"

#include <algorithm>
#include <cmath>

#include "geometry/coil_mesh.h"
#include "geometry/surface_mesh.h"

namespace vkdose::geometry {

namespace {

using Corners = std::vector<Vec3>;

int pieces(double length, double facet, int least) {
    return std::max(least, int(std::ceil(length / facet - 1e-9)));
}

class Tessellator {
  public:
    Tessellator(double facet, const Vec3& low, const Vec3& high, StraightLines straight)
        : facet_(facet), low_(low), high_(high), straight_(straight) {}

    void add(const Plane& s) { addWall(s, facet_); }
    void add(const Trough& s) { addWall(s, s.halfWidth); }
    void add(const Front& s) { addWall(s, s.holeRadius); }
    void add(const Tube& s) {
        if (std::isinf(s.length)) return addWall(s, s.radius);
        add(Cone{s.base, s.axis, s.radius, s.radius, s.length});
        if (s.inside)
            for (Triangle& t : mesh_) std::swap(t[0], t[1]);
    }

    void add(const Cone& c) {
        const Vec3 side = anyNormal(c.axis), other = glm::cross(c.axis, side);
        const int around = pieces(2 * kPi * std::max(c.baseRadius, c.endRadius), facet_, 3);
        // A cone is straight along its wall, but triangles as long as wide stay near it at its thin end.
        const int along = straightPieces(std::hypot(c.endRadius - c.baseRadius, c.length));
        std::vector<Corners> rings;
        for (int k = 0; k <= along; ++k) {
            const double share = double(k) / along;
            const double radius = c.baseRadius + share * (c.endRadius - c.baseRadius);
            Corners ring;
            for (int i = 0; i < around; ++i) {
                const double angle = 2 * kPi * i / around;
                ring.push_back(c.base + share * c.length * c.axis +
                               radius * (std::cos(angle) * side + std::sin(angle) * other));
            }
            rings.push_back(std::move(ring));
        }
        for (std::size_t k = 0; k + 1 < rings.size(); ++k) strip(rings[k], rings[k + 1], true);
    }

    void add(const Ball& b) {
        const int along = pieces(kPi * b.radius, facet_, 2), around = 2 * along;
        std::vector<Corners> rings;
        for (int k = 0; k <= along; ++k) {
            const double polar = kPi * (along - k) / along;
            const double sine = k == 0 || k == along ? 0 : std::sin(polar);
            Corners ring;
            for (int i = 0; i < around; ++i) {
                const double angle = 2 * kPi * i / around;
                ring.push_back(b.centre +
                               b.radius * Vec3(sine * std::cos(angle), sine * std::sin(angle), std::cos(polar)));
            }
            rings.push_back(std::move(ring));
        }
        for (std::size_t k = 0; k + 1 < rings.size(); ++k) strip(rings[k], rings[k + 1], true);
    }

    void add(const Block& b) {
        const auto corner = [&](int i) {
            return Vec3((i & 1) != 0 ? b.high.x : b.low.x, (i & 2) != 0 ? b.high.y : b.low.y,
                        (i & 4) != 0 ? b.high.z : b.low.z);
        };
        constexpr int kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
        for (const auto& f : kFaces) {
            const int second = b.inside ? f[3] : f[1], fourth = b.inside ? f[1] : f[3];
            put(corner(f[0]), corner(second), corner(f[2]));
            put(corner(f[0]), corner(f[2]), corner(fourth));
        }
    }

    void add(const Coil& c) {
        const double perTurn = std::hypot(2 * kPi * c.radius, c.pitch);
        mesh_ = coilMesh(c, pieces(2 * kPi * c.wireRadius, facet_, 3), pieces(perTurn, facet_, 3));
    }

    /// Sections of the blade, each a rectangle whose sides are cut along the radius, joined to a tube with two ends.
    void add(const Flight& f) {
        const double outermost = std::hypot(2 * kPi * f.outerRadius, std::max(f.pitchStart, f.pitchEnd));
        const int along = pieces(outermost * f.angle / (2 * kPi), facet_, 1);
        const int across = straightPieces(f.outerRadius - f.innerRadius);
        std::vector<Corners> sections;
        for (int k = 0; k <= along; ++k) sections.push_back(section(f, f.angle * k / along, across));
        for (std::size_t k = 0; k + 1 < sections.size(); ++k) strip(sections[k], sections[k + 1], f.hand < 0);
        end(sections.front(), across, f.hand < 0);
        end(sections.back(), across, f.hand > 0);
    }

    void add(const std::shared_ptr<const MeshSurface>& m) {
        for (const auto& t : m->mesh().triangles)
            mesh_.push_back({m->mesh().vertices[t[0]], m->mesh().vertices[t[1]], m->mesh().vertices[t[2]]});
    }

    std::vector<Triangle> mesh() { return std::move(mesh_); }

  private:
    int straightPieces(double length) const {
        return straight_ == StraightLines::Whole ? 1 : pieces(length, facet_, 1);
    }

    void put(const Vec3& a, const Vec3& b, const Vec3& c) {
        if (a != b && b != c && c != a) mesh_.push_back({a, b, c});
    }

    void addWall(const Surface& s, double radius) {
        mesh_ = surfaceMesh({s}, low_, high_, pieces(2 * kPi * radius, facet_, 4));
    }

    /// Joins two closed rings; `outwards` tells which way round.
    void strip(const Corners& a, const Corners& b, bool outwards) {
        for (std::size_t i = 0; i < a.size(); ++i) {
            const std::size_t j = (i + 1) % a.size();
            if (outwards) {
                put(a[i], a[j], b[j]);
                put(a[i], b[j], b[i]);
            } else {
                put(a[j], a[i], b[j]);
                put(b[j], a[i], b[i]);
            }
        }
    }

    /// Along the lower face outwards, along the upper one back.
    static Corners section(const Flight& f, double theta, int across) {
        const double azimuth = f.startAngle + f.hand * theta;
        const Vec3 outward(std::cos(azimuth), std::sin(azimuth), 0);
        Corners corners;
        for (const int face : {-1, 1})
            for (int i = 0; i <= across; ++i) {
                const double share = double(face < 0 ? i : across - i) / across;
                const double radius = f.innerRadius + share * (f.outerRadius - f.innerRadius);
                corners.push_back(radius * outward + Vec3(0, 0, f.height(theta) + face * f.thickness / 2));
            }
        return corners;
    }

    void end(const Corners& corners, int across, bool turned) {
        const int last = 2 * across + 1;
        for (int i = 0; i < across; ++i) {
            const Vec3 &a = corners[i], &b = corners[i + 1], &c = corners[last - i - 1], &d = corners[last - i];
            if (turned) {
                put(a, c, b);
                put(a, d, c);
            } else {
                put(a, b, c);
                put(a, c, d);
            }
        }
    }

    double facet_;
    Vec3 low_, high_;
    StraightLines straight_;
    std::vector<Triangle> mesh_;
};

}  // namespace

std::vector<Triangle> tessellated(const Shape& shape, double facet, const Vec3& low, const Vec3& high,
                                  StraightLines straight) {
    Tessellator tessellator(facet, low, high, straight);
    std::visit([&](const auto& s) { tessellator.add(s); }, shape);
    return tessellator.mesh();
}

}  // namespace vkdose::geometry
