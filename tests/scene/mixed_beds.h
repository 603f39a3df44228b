#pragma once
// Beds of several powders, with walls and bodies of their own materials.

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "tests/scene/beds.h"

namespace vkdose::test {

inline constexpr int kSecond = 3, kThird = 4, kTrough = 5, kBlock = 6;
inline constexpr int kHere = 7;  // materials
inline constexpr double kRate = -2 * kPi * 1.5;

/// Every pair has parameters of its own.
inline void vary(ContactLaw& law) {
    law.pairs.resize(kHere);
    for (int a = 0; a < kHere; ++a)
        for (int b = 0; b <= a; ++b) {
            ContactParameters p = law.between(0, std::min(b, 2));
            const double share = double(PairTable::index({a, b})) / 28;
            p.k1 *= 1 - 0.3 * share;
            p.kc *= 0.5 + share;
            p.mu = 0.1 + 0.5 * share;
            p.muR = 0.5 - 0.4 * share;
            p.gamma *= 0.7 + 0.3 * share;
            p.modulus *= 0.5 + share;
            p.dampingShare *= 0.5 + 0.5 * share;
            p.surfaceEnergy *= 0.5 + share;
            p.coulombLimit = (a + b) % 2 == 0 ? CoulombLimit::Absolute : CoulombLimit::Luding;
            law.between(a, b) = p;
        }
}

/// The canister with three powders, a trough and a block of their own materials.
inline RuledWorld mixedWorld() {
    RuledWorld w = canisterWorld();
    w.maxOverlapRatio = 1;
    w.materials.push_back({"second", true, 2600});
    w.materials.push_back({"third", true, 1100});
    w.materials.push_back({"trough", false, 0});
    w.materials.push_back({"block", false, 0});
    w.walls.front().material = kTrough;
    RigidBody block;
    block.name = "block";
    block.shapes = {geometry::Block{{-0.004, -0.001, -0.02}, {0.004, 0.001, 0.02}}};
    block.course.start.origin = {0, 0.012, 0.03};
    block.material = kBlock;
    w.bodies.push_back(block);
    vary(w.law);
    return w;
}

inline Particles mixedParticles(std::size_t n) {
    constexpr std::array<std::uint8_t, 3> kPowders{0, kSecond, kThird};
    Particles p = thrownIn(n);
    for (Vec3& x : p.position)
        if (x.y > 0.005) x.y += 0.004;  // above the block
    for (std::size_t i = 0; i < p.size(); ++i) p.material[i] = kPowders[i * i % 7 % 3];
    return p;
}

/// Spheres of all powders that touch each other, the block, the trough and the coil, and move.
inline Particles packed(const RuledWorld& w) {
    constexpr std::array<std::uint8_t, 3> kPowders{0, kSecond, kThird};
    const double a = single(1.2e-3);
    Particles p;
    const Particles pressed = aroundTheWire(*w.coil, a);
    for (const Vec3& x : pressed.position)
        if (x.z > 2 * a && x.z < 0.05 && std::hypot(x.x, x.y) + a < 0.0115) p.add(x, a);
    const auto add = [&](const Vec3& x) {
        const auto i = int(p.size());
        p.add(x, single(1.22e-3 + 0.015e-3 * (i % 4)));
    };
    for (int z = 0; z < 8; ++z)
        for (int x = -1; x < 2; ++x)
            for (int y = 0; y < 3; ++y) add({2.5e-3 * x, 0.013 + 1.23e-3 + 2.47e-3 * y, 0.021 + 2.48e-3 * z});
    for (int z = 0; z < 6; ++z) add({0.0115 - 1.21e-3, 0.03, 0.01 + 2.47e-3 * z});
    const std::size_t inBlock = 72, after = p.size() - 6, before = after - inBlock;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> speed(-0.1, 0.1);
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Vec3 velocity(single(speed(random)), single(speed(random)), single(speed(random)));
        if (i >= before) p.velocity[i] = velocity;  // those at the wire stay there for a while
        p.material[i] = kPowders[(i >= before && i < after ? i + i / 9 : i) % 3];
    }
    return p;
}

}  // namespace vkdose::test
