// Closest points on the coil against brute force: the wire is sampled densely and every local minimum of the sampled
// distance is refined by golden section. Nothing of geometry/coil.cpp is used for that but the definition of the curve.

#include "geometry/coil.h"

#include <cmath>
#include <random>

#include "tests/support/catch.h"
#include "tests/support/near.h"
#include "tests/support/table.h"

using namespace vkdose;
using namespace vkdose::geometry;
using test::near;
using test::oracleTable;
using test::TableRow;

namespace {

Vec3 centreLine(const Coil& coil, double angle, double s) {
    const double psi = angle + coil.startAngle + coil.hand * 2 * kPi * s / coil.pitch;
    return {coil.radius * std::cos(psi), coil.radius * std::sin(psi), coil.zStart + s};
}

double refine(const Coil& coil, double angle, const Vec3& q, double low, double high) {
    const auto distance = [&](double s) { return glm::length(q - centreLine(coil, angle, s)); };
    const double golden = (std::sqrt(5.0) - 1) / 2;
    for (int i = 0; i < 60; ++i) {
        const double left = high - golden * (high - low), right = low + golden * (high - low);
        if (distance(left) < distance(right))
            high = right;
        else
            low = left;
    }
    return (low + high) / 2;
}

struct Minimum {
    double s, distance;
};

/// Every local minimum of the distance to the wire's surface, in order of s.
std::vector<Minimum> bruteForce(const Coil& coil, double angle, const Vec3& q) {
    constexpr int kSamples = 20000;
    std::vector<double> d(kSamples + 1);
    const auto at = [&](int n) { return coil.length * n / kSamples; };
    for (int n = 0; n <= kSamples; ++n) d[n] = glm::length(q - centreLine(coil, angle, at(n)));
    std::vector<Minimum> list;
    for (int n = 0; n <= kSamples; ++n) {
        const bool falls = n == 0 || d[n] < d[n - 1], rises = n == kSamples || d[n] <= d[n + 1];
        if (!falls || !rises) continue;
        const double s = refine(coil, angle, q, at(std::max(n - 1, 0)), at(std::min(n + 1, kSamples)));
        list.push_back({s, glm::length(q - centreLine(coil, angle, s)) - coil.wireRadius});
    }
    return list;
}

/// Distances are compared in units of the wire radius. The refined brute force is good to the square of the golden
/// section's resolution, sqrt(epsilon) of a sample, so a part in 1e9 leaves room for both.
constexpr double kDistanceTolerance = 1e-9;
/// The place of a flat minimum is only known to the square root of that, in units of the pitch.
constexpr double kPlaceTolerance = 1e-5;

void checkTouch(const Coil& coil, double angle, const Vec3& q, const CoilTouch& touch, const Minimum& expected) {
    CHECK(near(touch.distance, expected.distance, coil.wireRadius, kDistanceTolerance));
    CHECK(near(touch.wireAngle * coil.pitch / (coil.hand * 2 * kPi), expected.s, coil.pitch, kPlaceTolerance));
    CHECK(near(glm::length(touch.normal), 1, 1, 1e-12));
    CHECK(near(q, touch.point + touch.distance * touch.normal, coil.radius, 1e-12));
    const Vec3 centre = centreLine(coil, angle, touch.wireAngle * coil.pitch / (coil.hand * 2 * kPi));
    CHECK(near(touch.point, centre + coil.wireRadius * touch.normal, coil.radius, 1e-12));
}

void checkAgainstBruteForce(const Coil& coil, double angle, const Vec3& q, double reach) {
    CAPTURE(coil.hand, coil.pitch, angle, q.x, q.y, q.z, reach);
    std::vector<Minimum> expected;
    Minimum nearest{0, 1e300};
    for (const Minimum& minimum : bruteForce(coil, angle, q)) {
        if (minimum.distance < reach) expected.push_back(minimum);
        if (minimum.distance < nearest.distance) nearest = minimum;
    }
    const std::vector<CoilTouch> found = touches(coil, angle, q, reach);
    REQUIRE(found.size() == expected.size());
    for (std::size_t n = 0; n < found.size(); ++n) checkTouch(coil, angle, q, found[n], expected[n]);
    const CoilTouch closest = closestPoint(coil, angle, q);
    CHECK(near(closest.distance, nearest.distance, coil.wireRadius, kDistanceTolerance));
}

Coil narrowCoil() {
    return {10.4e-3, 8.75e-3, 1e-3, 70e-3, 0, 0, 1};
}
Coil wideCoil() {
    return {10.4e-3, 17.5e-3, 1e-3, 70e-3, 2e-3, 0.7, -1};
}
Coil tightCoil() {
    return {10.4e-3, 2.5e-3, 0.5e-3, 20e-3, -1e-3, -2.0, 1};
}

Vec3 cylindrical(double rho, double theta, double z) {
    return {rho * std::cos(theta), rho * std::sin(theta), z};
}

}  // namespace

TEST_CASE("coil: closest points of random probes are those of brute force") {
    std::mt19937_64 random(20240611);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const Coil& coil : {narrowCoil(), wideCoil(), tightCoil()})
        for (int n = 0; n < 60; ++n) {
            const double rho = coil.radius * 1.4 * std::sqrt(unit(random));
            const double z = coil.zStart + coil.length * (1.2 * unit(random) - 0.1);
            const double angle = 200 * (unit(random) - 0.5);
            checkAgainstBruteForce(coil, angle, cylindrical(rho, 2 * kPi * unit(random), z), 4e-3);
        }
}

TEST_CASE("coil: every local minimum is found even with a reach beyond the coil's own size") {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const Coil& coil : {narrowCoil(), wideCoil()})
        for (int n = 0; n < 20; ++n) {
            const Vec3 q = cylindrical(2 * coil.radius * unit(random), 2 * kPi * unit(random), 70e-3 * unit(random));
            checkAgainstBruteForce(coil, unit(random), q, 1.0);
        }
}

TEST_CASE("coil: probes at the wire's ends meet the round caps") {
    for (const Coil& coil : {narrowCoil(), wideCoil(), tightCoil()})
        for (const double s : {0.0, coil.length}) {
            const double angle = 0.4;
            const Vec3 end = centreLine(coil, angle, s);
            const double psi = std::atan2(end.y, end.x);
            const Vec3 radial(std::cos(psi), std::sin(psi), 0), along(-std::sin(psi), std::cos(psi), 0);
            const Vec3 beyond = (s == 0 ? -1.0 : 1.0) * (double(coil.hand) * along + Vec3(0, 0, 0.1));
            for (const double side : {-1e-3, 0.0, 1e-3})
                for (const double ahead : {-3e-3, -1e-6, 1e-6, 1.5e-3})
                    checkAgainstBruteForce(coil, angle, end + side * radial + ahead * beyond, 3e-3);
            const CoilTouch cap = closestPoint(coil, angle, end + 1.5e-3 * beyond);
            CHECK(near(cap.wireAngle, coil.hand * 2 * kPi * s / coil.pitch, 1, 1e-9));
        }
}

TEST_CASE("coil: a minimum exactly at an end is one contact, neither none nor two") {
    const Coil coil = narrowCoil();
    const Vec3 end = centreLine(coil, 0, 0);
    const Vec3 tangent =
        glm::normalize(Vec3(0, coil.radius * 2 * kPi / coil.pitch, 1));  // of the centre line, at angle 0
    const Vec3 across = glm::normalize(glm::cross(tangent, Vec3(1, 0, 0)));
    for (int n = 0; n < 100; ++n) {
        const Vec3 q = end + 1.2e-3 * (std::cos(0.1 * n) * Vec3(1, 0, 0) + std::sin(0.1 * n) * across);
        const std::vector<CoilTouch> found = touches(coil, 0, q, 0.5e-3);
        REQUIRE(found.size() == 1);
        CHECK(near(found[0].distance, 0.2e-3, coil.wireRadius, 1e-9));
    }
}

TEST_CASE("coil: probes on and near the axis, where the polar angle means nothing") {
    for (const Coil& coil : {narrowCoil(), wideCoil()}) {
        for (const double z : {5e-3, 31.3e-3, 66e-3}) {
            const CoilTouch touch = closestPoint(coil, 1.1, Vec3(0, 0, z));
            CHECK(near(touch.distance, coil.radius - coil.wireRadius, coil.wireRadius, 1e-12));
            CHECK(near(touch.point.z, z, coil.wireRadius, 1e-12));
            for (const double rho : {1e-12, 1e-7, 1e-5, 1e-4})
                checkAgainstBruteForce(coil, 1.1, cylindrical(rho, 2.0, z), 12e-3);
        }
        // Where eps = rho r_c kappa^2 passes 1 the single minimum splits into one per turn.
        const double kappa = 2 * kPi / coil.pitch, split = 1 / (coil.radius * kappa * kappa);
        for (const double factor : {0.5, 0.99, 1.01, 1.5, 3.0})
            for (const double theta : {0.3, 2.9, -1.0})
                checkAgainstBruteForce(coil, 0, cylindrical(factor * split, theta, 33e-3), 12e-3);
    }
}

TEST_CASE("coil: between two turns both are touched, between three all three") {
    const Coil coil = tightCoil();
    const double s = 8e-3;
    const Vec3 wire = centreLine(coil, 0, s);
    const Vec3 outward = glm::normalize(Vec3(wire.x, wire.y, 0));
    // Half a pitch along z: the middle between two turns; straight out of a turn: that one and its two neighbours.
    const Vec3 between = wire + Vec3(0, 0, coil.pitch / 2);
    CHECK(touches(coil, 0, between, 1.2e-3).size() == 2);
    checkAgainstBruteForce(coil, 0, between, 1.2e-3);
    const Vec3 above = wire + 2.0e-3 * outward;
    CHECK(touches(coil, 0, above, 3.0e-3).size() == 3);
    checkAgainstBruteForce(coil, 0, above, 3.0e-3);

    const std::vector<CoilTouch> found = touches(coil, 0, above, 3.0e-3);
    CHECK(near(found[1].wireAngle - found[0].wireAngle, 2 * kPi, 2 * kPi, 0.01));
    CHECK(near(found[2].wireAngle - found[1].wireAngle, 2 * kPi, 2 * kPi, 0.01));
}

TEST_CASE("coil: the mirror image of a coil has the mirror image of its contacts") {
    Coil right = narrowCoil(), left = narrowCoil();
    right.startAngle = 0.8;
    left.hand = -1;
    left.startAngle = -0.8;
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int n = 0; n < 50; ++n) {
        const Vec3 q = cylindrical(14e-3 * unit(random), 2 * kPi * unit(random), 70e-3 * unit(random));
        const CoilTouch a = closestPoint(right, 0.3, q), b = closestPoint(left, -0.3, Vec3(q.x, -q.y, q.z));
        CHECK(near(Vec3(a.point.x, -a.point.y, a.point.z), b.point, right.radius, 1e-12));
        CHECK(near(a.wireAngle, -b.wireAngle, 2 * kPi, 1e-9));
    }
}

TEST_CASE("coil: the wire angle of a contact moves steadily while the coil turns past a still probe") {
    const Coil coil = narrowCoil();
    const Vec3 q = cylindrical(9.0e-3, -1.2, 30e-3);
    const double step = 0.01;
    std::vector<CoilTouch> before = touches(coil, 0, q, 3e-3);
    for (int n = 1; n < 1500; ++n) {
        const std::vector<CoilTouch> now = touches(coil, n * step, q, 3e-3);
        for (const CoilTouch& a : before)
            for (const CoilTouch& b : now) {
                const double moved = std::abs(a.wireAngle - b.wireAngle);
                CHECK((moved < 0.1 || moved > kPi));  // the same turn hardly moves, another is far away
            }
        before = now;
    }
}

TEST_CASE("coil: no sphere touches more turns than maxTouches says") {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const double pitch : {1.2e-3, 2.5e-3, 8.75e-3})
        for (const double a : {0.5e-3, 1.9e-3, 12e-3}) {
            const Coil coil{10.4e-3, pitch, 0.3e-3, 30e-3, 0, 0, 1};
            const int bound = maxTouches(coil, a);
            std::size_t most = 0;
            for (int n = 0; n < 400; ++n) {
                const double rho = coil.radius + 2.2 * a * (unit(random) - 0.5);
                const Vec3 q = cylindrical(std::abs(rho), 2 * kPi * unit(random), 30e-3 * unit(random));
                most = std::max(most, touches(coil, 0, q, a).size());
            }
            CAPTURE(pitch, a, bound, most);
            CHECK(most <= static_cast<std::size_t>(bound));
            CHECK(most >= 1);
        }
    CHECK(maxTouches(narrowCoil(), 1.875e-3) == 1);  // the paper's coil: 5.75 mm of reach, turns 8 mm apart
}

TEST_CASE("coil: turning at the conveying rate carries the wire towards the outlet at V_z = p Omega / 2 pi") {
    for (const Coil& coil : {narrowCoil(), wideCoil()}) {
        const double speed = 2.0, dt = 0.1;
        const double rate = conveyingRate(coil, speed);
        CHECK(std::abs(rate) == speed);
        // At a fixed place beside the axis the wire is found further on by V_z dt.
        const Vec3 start = centreLine(coil, 0, 30e-3);
        const Vec3 later = start + Vec3(0, 0, coil.pitch * speed * dt / (2 * kPi));
        CHECK(near(closestPoint(coil, 0, start).distance, -coil.wireRadius, coil.wireRadius, 1e-9));
        CHECK(near(closestPoint(coil, rate * dt, later).distance, -coil.wireRadius, coil.wireRadius, 1e-9));
        CHECK(closestPoint(coil, rate * dt, start).distance > -coil.wireRadius * 0.99);
    }
}

TEST_CASE("coil: a query that is not finite is refused, not looped over") {
    const double nan = std::nan("");
    CHECK_THROWS_AS(touches(narrowCoil(), 0, Vec3(nan, 0, 0), 1e-3), std::logic_error);
    CHECK_THROWS_AS(closestPoint(narrowCoil(), 0, Vec3(0, 0, INFINITY)), std::logic_error);
    CHECK_THROWS_AS(closestPoint(narrowCoil(), nan, Vec3(0, 0, 0)), std::logic_error);
}

TEST_CASE("coil: the oracle's closest points and second turns") {
    for (const char* file : {"helix_points.csv", "helix_points_far.csv"})
        for (const TableRow& row : oracleTable(file)) {
            CAPTURE(file, row.at("id"));
            const Coil coil{9.4e-3, 70e-3 / row.at("turns"), 1e-3, 70e-3, 0, 2 * kPi * row.at("offset_rev"), 1};
            const Vec3 q(row.at("x_m"), row.at("y_m"), row.at("z_m"));
            const CoilTouch touch = closestPoint(coil, 0, q);
            // The table has 10 digits, and bisection settled its place on the wire to about 1e-8 of the pitch.
            CHECK(near(touch.distance, row.at("true_distance_m"), coil.wireRadius, 1e-8));
            CHECK(near(touch.wireAngle / (2 * kPi), row.at("true_q") * row.at("turns"), 1, 1e-6));
            const Vec3 towardsWire(row.at("true_nx"), row.at("true_ny"), row.at("true_nz"));
            CHECK(near(-touch.normal, towardsWire, 1, 1e-6));

            std::vector<double> distances;
            for (const CoilTouch& other : touches(coil, 0, q, 1.0)) distances.push_back(other.distance);
            std::sort(distances.begin(), distances.end());
            // The table's second minimum is a sample, not refined: with 200001 samples of the wire it lies above the
            // true one, by up to (1.2 um)^2 / (2 x 8 mm), 1e-7 of the wire radius. 31622.8 says that there is none.
            const double second = row.at("second_local_min_distance_m");
            REQUIRE(distances.size() >= (second < 1 ? 2u : 1u));
            if (second < 1) {
                CHECK(near(distances[1], second, coil.wireRadius, 2e-7));
            } else {
                CHECK(distances.size() == 1);
            }
        }
}
