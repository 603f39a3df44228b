#pragma once
// Bodies with spheres on them, for scenes on both backends.

#include "geometry/shape.h"
#include "tests/scene/beds.h"

namespace vkdose::test {

inline constexpr double kDrumRate = 12;  // [rad/s]

inline RigidBody bodyOf(const char* name, std::vector<geometry::Shape> shapes,
                        geometry::Motion motion = geometry::Rest{}, Clock clock = Clock::Time) {
    return {name, std::move(shapes), {geometry::Pose{}, std::move(motion), {}}, clock, kWallMaterial};
}

inline std::shared_ptr<const geometry::MeshSurface> meshOf(const geometry::Shape& shape, double facet) {
    const auto triangles = geometry::tessellated(shape, facet, Vec3(-1), Vec3(1));
    return std::make_shared<const geometry::MeshSurface>(geometry::makeMesh(geometry::soupOf(triangles, "test")).mesh,
                                                         2e-3);
}

/// A drum about z that turns, with a block of triangles in it that shakes, and a coil that follows the drive.
inline RuledWorld deviceWorld() {
    RuledWorld w = emptyWorld();
    w.domain = {Vec3(-0.03, -0.03, -0.01), Vec3(0.03, 0.03, 0.02)};
    const Vec3 z(0, 0, 1);
    w.bodies.push_back(bodyOf("drum",
                              {geometry::Cone{Vec3(0), z, 20e-3, 20e-3, 10e-3}, geometry::Cone{Vec3(0), z, 0, 20e-3, 0},
                               geometry::Cone{Vec3(0, 0, 10e-3), z, 0, 20e-3, 0}},
                              geometry::Turn{z, Vec3(0), kDrumRate}));
    RigidBody block = bodyOf("block", {meshOf(geometry::Block{Vec3(-3e-3), Vec3(3e-3)}, 2e-3)},
                             geometry::Shake{Vec3(0, 1, 0), 0.2e-3, 80, 0.3});
    block.course.start = {glm::angleAxis(0.6, glm::normalize(Vec3(1, 2, 3))), Vec3(6e-3, -14e-3, 5e-3)};
    block.material = kCoilMaterial;
    w.bodies.push_back(std::move(block));
    w.bodies.push_back(bodyOf("stirrer", {geometry::Ball{Vec3(-14e-3, 0, 5e-3), 3e-3}}, geometry::Turn{z, Vec3(0), 0.7},
                              Clock::Drive));
    return w;
}

/// Spheres in layers, clear of the bodies.
inline Particles layers(int count) {
    Particles p;
    for (int i = 0; i < count; ++i) {
        const Vec3 at((i % 5 - 2) * 2.9e-3 + 0.1e-3 * (i % 3), -6.5e-3 + (i / 15) * 2.8e-3,
                      2.1e-3 + (i / 5 % 3) * 2.8e-3);
        p.add(at, single(1.25e-3 - 0.01e-3 * (i % 7)), Vec3(0.1, -0.3, 0.02 * (i % 3 - 1)), Vec3(i % 5, 2, -3));
    }
    return p;
}

/// A loose bed in an upright tube with a radius of 9 mm.
inline Particles tubeBed() {
    Particles p;
    for (int layer = 0; layer < 4; ++layer)
        for (int i = 0; i < 24; ++i) {
            const double angle = 2 * kPi * i / (i < 16 ? 16 : 8) + 0.1 * layer, out = i < 16 ? 7.4e-3 : 3.8e-3;
            p.add({out * std::cos(angle), 1.3e-3 + layer * 2.65e-3, out * std::sin(angle)},
                  single(1.25e-3 - 0.01e-3 * (i % 5)), Vec3(0.01 * (i % 3), -0.02, 0));
        }
    return p;
}

/// Of the drive [rad/s].
inline constexpr double kDrive = -9.0000001;

}  // namespace vkdose::test
