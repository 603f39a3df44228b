// The mesh of the walls lies on them and is all of them.

#include "geometry/surface_mesh.h"

#include <algorithm>

#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::geometry;
using test::near;
using test::nearRelative;

namespace {

const Vec3 kLow(-0.0115, -0.0115, 0), kHigh(0.0115, 0.04, 0.06);

double areaOf(const std::vector<Surface>& all, const Surface& one) {
    std::vector<Surface> with{one}, only;
    for (const Surface& s : all)
        if (std::holds_alternative<Trough>(s) && !std::holds_alternative<Trough>(one)) with.push_back(s);
    double area = 0;
    const auto sum = [](const std::vector<Triangle>& mesh) {
        double s = 0;
        for (const Triangle& t : mesh) s += 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
        return s;
    };
    area = sum(surfaceMesh(with, kLow, kHigh));
    if (with.size() > 1) area -= sum(surfaceMesh({with[1]}, kLow, kHigh));
    return area;
}

}  // namespace

TEST_CASE("the mesh of a canister has its area, wall by wall") {
    const double h = 0.0115, top = 0.04, length = 0.06, hole = 0.009, throat = 0.01;
    const Trough trough{h};
    const Front front{length, hole, throat};
    const Plane rear{{0, 0, 0}, {0, 0, 1}}, lid{{0, top, 0}, {0, -1, 0}};
    const std::vector<Surface> all{trough, rear, front, lid};
    // 96 chords to a turn are short of the circle by 2e-4, the area between them by 7e-4.
    CHECK(nearRelative(areaOf(all, trough), length * (2 * top + kPi * h), 1e-3));
    CHECK(nearRelative(areaOf(all, lid), 2 * h * length, 1e-6));
    const double wall = 2 * h * top + kPi * h * h / 2;
    CHECK(nearRelative(areaOf(all, rear), wall, 1e-3));
    CHECK(nearRelative(areaOf(all, front), wall - kPi * hole * hole + 2 * kPi * hole * throat, 1e-3));
    // A hole as wide as the trough leaves the wall above it.
    CHECK(nearRelative(areaOf(all, Front{length, h, throat}), 2 * h * top - kPi * h * h / 2 + 2 * kPi * h * throat,
                       1e-3));
}

TEST_CASE("a tube is as long as it is, or as the box") {
    const Tube finite{{0, 0.01, 0.01}, {0, 0, 1}, 0.004, 0.02, true}, endless{{0, 0.01, 0.01}, {0, 0, 1}, 0.004};
    CHECK(nearRelative(areaOf({finite}, finite), 2 * kPi * 0.004 * 0.02, 1e-3));
    CHECK(nearRelative(areaOf({endless}, endless), 2 * kPi * 0.004 * 0.06, 1e-3));
}

TEST_CASE("the corners of the mesh lie on the wall they are of, in the box") {
    const double s = std::sqrt(0.5);
    const std::vector<Surface> shapes{Plane{{0, 0, 0}, {0, 0, 1}}, Plane{{0.001, 0.01, 0.03}, {s, s, 0}},
                                      Trough{0.0115}, Tube{{0, 0.01, 0.02}, {0, 0, 1}, 0.004, 0.02, false},
                                      Front{0.06, 0.009, 0.01}};
    for (const Surface& shape : shapes) {
        const std::vector<Triangle> mesh = surfaceMesh({shape}, kLow, kHigh);
        CHECK_FALSE(mesh.empty());
        for (const Triangle& t : mesh)
            for (const Vec3& corner : t) {
                CHECK(near(closestPoint(shape, corner).distance, 0, 0.01, 1e-6));
                CHECK(glm::all(
                    glm::lessThan(glm::abs(corner - glm::clamp(corner, kLow, kHigh + Vec3(0, 0, 0.01))), Vec3(1e-8))));
            }
    }
    CHECK(surfaceMesh({Plane{{0, 1, 0}, {0, 1, 0}}}, kLow, kHigh).empty());  // it does not pass the box
}
