#pragma once
// Particles in a canister or at its coil, and equality to the last bit.

#include <random>
#include <vector>

#include "tests/scene/agreement.h"

namespace vkdose::test {

/// `n` spheres of mixed sizes flying about: a bundle inside the coil, the rest on a grid above it.
inline Particles thrownIn(std::size_t n) {
    Particles p;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> radius(0.625e-3, 1.875e-3), jitter(-5e-5, 5e-5), speed(-1, 1);
    const auto add = [&](double x, double y, double z) {
        if (p.size() < n)
            p.add({x + jitter(random), y + jitter(random), z + jitter(random)}, single(radius(random)),
                  {speed(random), speed(random) - 0.5, speed(random)});
    };
    for (int z = 0; z < 14; ++z)
        for (const double x : {-0.002, 0.002})
            for (const double y : {-0.002, 0.002}) add(x, y, 0.004 + 0.0039 * z);
    for (int layer = 0; p.size() < n; ++layer)
        for (int z = 0; z < 13; ++z)
            for (int x = 0; x < 5; ++x) add(-0.0078 + 0.0039 * x, 0.0135 + 0.0039 * layer, 0.004 + 0.0041 * z);
    return p;
}

/// Spheres pressed 2 um into the wire from all sides, some at its ends, none touching another or a second turn; and,
/// where the pitch is narrow enough, some wedged between two turns from inside.
inline Particles aroundTheWire(const geometry::Coil& coil, double a) {
    const double reach = a + coil.wireRadius, pressed = 2e-6;
    Particles p;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    const auto apart = [&](const Vec3& at) {
        for (const Vec3& q : p.position)
            if (glm::length(q - at) < 2 * a) return false;
        return true;
    };
    const auto onePressed = [&](const Vec3& at) {
        for (const geometry::CoilTouch& t : geometry::touches(coil, 0, at, a))
            if (t.distance < a - 1.5 * pressed) return false;
        return true;
    };
    const double half = coil.pitch / 2 * std::cos(std::atan(coil.pitch / (2 * kPi * coil.radius)));
    for (int trial = 0; trial < 2000 && p.size() < 37; ++trial) {
        const double s = coil.length * std::clamp(1.25 * unit(random) - 0.125, 0.0, 1.0);
        const double psi = coil.hand * 2 * kPi * s / coil.pitch, around = 2 * kPi * unit(random);
        const Vec3 radial(std::cos(psi), std::sin(psi), 0), up(0, 0, 1);
        const bool wedged = half < reach && trial % 4 == 0;
        const Vec3 offset = wedged ? -std::sqrt(reach * reach - half * half) * radial + coil.pitch / 2 * up
                                   : (reach - pressed) * (std::cos(around) * radial + std::sin(around) * up);
        const Vec3 at = coil.radius * radial + s * up + offset;
        if (apart(at) && (onePressed(at) || wedged)) p.add(at, a);
    }
    return p;
}

inline bool sameBits(const Particles& a, const Particles& b) {
    return a.position == b.position && a.velocity == b.velocity && a.spin == b.spin && a.status == b.status;
}

inline bool sameBits(const std::vector<Contact>& a, const std::vector<Contact>& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i].kind != b[i].kind || a[i].particle != b[i].particle || a[i].other != b[i].other ||
            a[i].maxOverlap != b[i].maxOverlap || a[i].sliding != b[i].sliding || a[i].rolling != b[i].rolling ||
            a[i].torsion != b[i].torsion || a[i].force != b[i].force)
            return false;
    return true;
}

}  // namespace vkdose::test
