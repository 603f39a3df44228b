// Closest points on the fixed surfaces against brute force: the surface is sampled from its definition, the nearest
// sample is compared. No code of geometry/surface.cpp is used for that.

#include "geometry/surface.h"

#include <cmath>
#include <random>

#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::geometry;
using test::near;

namespace {

constexpr double kSize = 10e-3;  // of everything in this file [m]

/// Nearest of the points that `surface(u, v)` makes from any u and 0 <= v <= 1, refined by zooming in around the best.
/// u is for angles, which have no ends.
template <class Parametrisation>
double sampledDistance(const Parametrisation& surface, const Vec3& q) {
    double u = 0.5, v = 0.5, width = 0.5, best = 1e300;
    constexpr int kSide = 60;
    for (int level = 0; level < 12; ++level) {
        const double u0 = u, v0 = v;
        for (int a = -kSide; a <= kSide; ++a)
            for (int b = -kSide; b <= kSide; ++b) {
                const double tryU = u0 + width * a / kSide;
                const double tryV = glm::clamp(v0 + width * b / kSide, 0.0, 1.0);
                const double d = glm::length(q - surface(tryU, tryV));
                if (d < best) {
                    best = d;
                    u = tryU;
                    v = tryV;
                }
            }
        width *= 0.15;  // well above one cell of the level, so that the nearest point cannot be zoomed past
    }
    return best;
}

/// Every answer has a unit normal, and the query is reached from the point along it.
void checkConsistent(const Closest& closest, const Vec3& q) {
    CHECK(near(glm::length(closest.normal), 1, 1, 1e-12));
    CHECK(near(closest.point + closest.distance * closest.normal, q, kSize, 1e-12));
}

/// The zoom ends at a sample of 1e-10 of the square, so distances agree to far less than this part of the size.
constexpr double kTolerance = 1e-7;

Vec3 somewhere(std::mt19937_64& random, double reach) {
    std::uniform_real_distribution<double> unit(-reach, reach);
    const double x = unit(random), y = unit(random), z = unit(random);
    return {x, y, z};
}

}  // namespace

TEST_CASE("plane: distance along the normal, negative behind") {
    const Plane plane{Vec3(1e-3, 2e-3, 3e-3), glm::normalize(Vec3(1, -2, 0.5))};
    const Vec3 q = plane.point + 4e-3 * plane.normal + 7e-3 * glm::normalize(glm::cross(plane.normal, Vec3(0, 0, 1)));
    const Closest front = closestPoint(plane, q), behind = closestPoint(plane, q - 5e-3 * plane.normal);
    CHECK(near(front.distance, 4e-3, kSize, 1e-12));
    CHECK(near(behind.distance, -1e-3, kSize, 1e-12));
    CHECK(near(front.normal, plane.normal, 1, 1e-12));
    checkConsistent(front, q);
    checkConsistent(behind, q - 5e-3 * plane.normal);
}

TEST_CASE("trough: the nearest point of the U-shaped profile, inside and behind") {
    const Trough trough{kSize};
    const auto bottom = [&](const Vec3& q) {
        return sampledDistance(
            [&](double, double v) {
                return trough.halfWidth * Vec3(std::cos(kPi * (1 + v)), std::sin(kPi * (1 + v)), 0) + Vec3(0, 0, q.z);
            },
            q);
    };
    const auto sides = [&](const Vec3& q) {
        const auto side = [&](double x) {
            return sampledDistance([&](double, double v) { return Vec3(x, 3 * kSize * v, q.z); }, q);
        };
        return std::min(side(-trough.halfWidth), side(trough.halfWidth));
    };
    std::mt19937_64 random(1);
    for (int n = 0; n < 60; ++n) {
        const Vec3 q = somewhere(random, 1.3 * kSize);
        CAPTURE(q.x, q.y);
        const Closest closest = closestPoint(trough, q);
        CHECK(near(std::abs(closest.distance), std::min(bottom(q), sides(q)), kSize, kTolerance));
        const bool isInside = q.y >= 0 ? std::abs(q.x) < kSize : std::hypot(q.x, q.y) < kSize;
        CHECK((closest.distance > 0) == isInside);
        checkConsistent(closest, q);
    }
}

TEST_CASE("trough: continuous where the half cylinder meets the walls") {
    const Trough trough{kSize};
    const Closest above = closestPoint(trough, Vec3(9e-3, 1e-12, 0)),
                  below = closestPoint(trough, Vec3(9e-3, -1e-12, 0));
    CHECK(near(above.distance, below.distance, kSize, 1e-9));
    CHECK(near(above.normal, below.normal, 1, 1e-9));
    CHECK(near(above.normal, Vec3(-1, 0, 0), 1, 1e-9));
}

TEST_CASE("tube: from inside and outside, beyond its ends the edge") {
    std::mt19937_64 random(2);
    for (const bool isInside : {true, false}) {
        const Tube tube{Vec3(1e-3, -2e-3, 0.5e-3), glm::normalize(Vec3(0.3, 0.2, -1)), 6e-3, 8e-3, isInside};
        const Vec3 e1 = glm::normalize(glm::cross(tube.axis, Vec3(1, 0, 0))), e2 = glm::cross(tube.axis, e1);
        const auto wall = [&](double u, double v) {
            return tube.base + tube.axis * (tube.length * v) +
                   tube.radius * (std::cos(2 * kPi * u) * e1 + std::sin(2 * kPi * u) * e2);
        };
        for (int n = 0; n < 60; ++n) {
            const Vec3 q = tube.base + somewhere(random, 12e-3);
            CAPTURE(isInside, q.x, q.y, q.z);
            const Closest closest = closestPoint(tube, q);
            CHECK(near(std::abs(closest.distance), sampledDistance(wall, q), kSize, kTolerance));
            const double along = glm::dot(q - tube.base, tube.axis);
            const double rho = glm::length(q - tube.base - along * tube.axis);
            const bool beside = along >= 0 && along <= tube.length;
            const bool behind = beside && (isInside ? rho > tube.radius : rho < tube.radius);
            CHECK((closest.distance < 0) == behind);
            checkConsistent(closest, q);
        }
    }
}

TEST_CASE("tube: an infinite one has no ends, on its axis every direction is as close") {
    const Tube tube{Vec3(0), Vec3(0, 0, 1), 5e-3};
    for (const double z : {-40.0, 0.0, 40.0}) {
        const Closest closest = closestPoint(tube, Vec3(3e-3, 0, z));
        CHECK(near(closest.distance, 2e-3, kSize, 1e-9));
        CHECK(near(closest.normal, Vec3(-1, 0, 0), 1, 1e-9));
        const Closest axis = closestPoint(tube, Vec3(0, 0, z));
        CHECK(near(axis.distance, 5e-3, kSize, 1e-9));
        CHECK(near(glm::length(axis.normal), 1, 1, 1e-12));
        CHECK(near(axis.normal.z, 0, 1, 1e-12));
    }
}

TEST_CASE("front: wall, rim, throat and its open end") {
    const Front front{20e-3, 6e-3, 5e-3};
    const auto throatWall = [&](double u, double v) {
        return Vec3(front.holeRadius * std::cos(2 * kPi * u), front.holeRadius * std::sin(2 * kPi * u),
                    front.z + front.throatLength * v);
    };
    const auto plate = [&](double u, double v) {
        const double rho = front.holeRadius + 30e-3 * v;
        return Vec3(rho * std::cos(2 * kPi * u), rho * std::sin(2 * kPi * u), front.z);
    };
    std::mt19937_64 random(3);
    int rim = 0, throat = 0, wall = 0, end = 0;
    for (int n = 0; n < 200; ++n) {
        const Vec3 q = Vec3(0, 0, front.z) + somewhere(random, 9e-3);
        CAPTURE(q.x, q.y, q.z);
        const Closest closest = closestPoint(front, q);
        checkConsistent(closest, q);
        const double past = q.z - front.z, rho = std::hypot(q.x, q.y);
        const bool behind = rho > front.holeRadius && past > 0 && past < front.throatLength;
        CHECK((closest.distance < 0) == behind);
        const double expected = std::min(sampledDistance(throatWall, q), sampledDistance(plate, q));
        CHECK(near(std::abs(closest.distance), expected, kSize, kTolerance));
        if (past < 0 && rho < front.holeRadius) ++rim;
        if (past < 0 && rho > front.holeRadius) ++wall;
        if (past > 0 && past < front.throatLength) ++throat;
        if (past > front.throatLength) ++end;
    }
    CHECK(std::min({rim, throat, wall, end}) > 10);  // every region was met
}

TEST_CASE("front: no step in distance or normal from the wall over the rim into the throat") {
    const Front front{0, 6e-3, 5e-3};
    const double a = 1e-3, tiny = 1e-12;
    // A sphere of radius a rolling round the rim: first over the wall, then over the edge, then inside the throat.
    for (const double rho : {front.holeRadius - tiny, front.holeRadius + tiny}) {
        const Closest closest = closestPoint(front, Vec3(0, rho, -a));
        CHECK(near(closest.distance, a, kSize, 1e-9));
        CHECK(near(closest.normal, Vec3(0, 0, -1), 1, 1e-8));
    }
    for (const double z : {-tiny, tiny}) {
        const Closest closest = closestPoint(front, Vec3(0, front.holeRadius - a, z));
        CHECK(near(closest.distance, a, kSize, 1e-9));
        CHECK(near(closest.normal, Vec3(0, -1, 0), 1, 1e-8));
    }
}
