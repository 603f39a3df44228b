#include "geometry/coil_mesh.h"

#include <algorithm>
#include <cmath>

#include "geometry/tessellator.h"

namespace vkdose::geometry {

namespace {

/// Corners around the centre line at wire coordinate s. They go anticlockwise as seen by a viewer who looks against the
/// line's direction.
std::vector<Vec3> ring(const Coil& coil, double s, int around) {
    const double kappa = coil.hand * 2 * kPi / coil.pitch, psi = coil.startAngle + kappa * s;
    const Vec3 outwards(std::cos(psi), std::sin(psi), 0);
    const Vec3 along = glm::normalize(Vec3(-coil.radius * kappa * outwards.y, coil.radius * kappa * outwards.x, 1));
    const Vec3 aside = glm::cross(along, outwards), centre = coil.radius * outwards + Vec3(0, 0, coil.zStart + s);
    std::vector<Vec3> corners;
    for (int i = 0; i < around; ++i) {
        const double angle = 2 * kPi * i / around;
        corners.push_back(centre + coil.wireRadius * (std::cos(angle) * outwards + std::sin(angle) * aside));
    }
    return corners;
}

}  // namespace

std::vector<Triangle> coilMesh(const Coil& coil, int around, int perTurn) {
    const int rings = std::max(1, int(std::lround(perTurn * coil.length / coil.pitch)));
    std::vector<Triangle> mesh;
    std::vector<Vec3> last = ring(coil, 0, around);
    for (int i = 1; i + 1 < around; ++i) mesh.push_back({last[0], last[i + 1], last[i]});
    for (int r = 1; r <= rings; ++r) {
        const std::vector<Vec3> next = ring(coil, coil.length * r / rings, around);
        for (int i = 0; i < around; ++i) {
            const int j = (i + 1) % around;
            mesh.push_back({last[i], last[j], next[j]});
            mesh.push_back({last[i], next[j], next[i]});
        }
        last = next;
    }
    for (int i = 1; i + 1 < around; ++i) mesh.push_back({last[0], last[i], last[i + 1]});
    return mesh;
}

void Coil::cut(Tessellator& into) const {
    const double perTurn = std::hypot(2 * kPi * radius, pitch);
    into.putAll(coilMesh(*this, into.pieces(2 * kPi * wireRadius, 3), into.pieces(perTurn, 3)));
}

}  // namespace vkdose::geometry
