#include "host/analysis/work.h"

#include <cmath>
#include <vector>

#include "host/core/vec.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using vkdose::test::nearRelative;

TEST_CASE("turns and work of the drive by hand") {
    // A turn at 2 mN m, rest, half a turn at -1 mN m. The first torque belongs to what was before.
    const std::vector<double> angle{1, 1 + 2 * kPi, 1 + 2 * kPi, 1 + 3 * kPi};
    const std::vector<double> torque{99, 2e-3, 5, -1e-3};
    const DriveWork w = driveWork(angle, torque);
    CHECK(nearRelative(w.turns, 1.5, 1e-12));
    CHECK(nearRelative(w.work, 2e-3 * 2 * kPi - 1e-3 * kPi, 1e-12));
    std::vector<double> other;  // a coil that conveys in the other sense
    for (const double a : angle) other.push_back(-a);
    CHECK(driveWork(other, torque).turns == w.turns);
    CHECK(driveWork(other, torque).work == w.work);
    CHECK(nearRelative(w.massPerTurn(3e-3), 2e-3, 1e-12));
    CHECK(nearRelative(w.massPerJoule(3e-3), 3e-3 / (3e-3 * kPi), 1e-12));
}

TEST_CASE("a turn back against the powder is work of the drive as well") {
    // A turn at 2 mN m, a quarter back: the powder resists that with 1 mN m, which is -1 for a conveying drive.
    const std::vector<double> angle{0, 2 * kPi, 1.5 * kPi}, torque{0, 2e-3, -1e-3};
    const DriveWork w = driveWork(angle, torque);
    CHECK(nearRelative(w.turns, 1.25, 1e-12));
    CHECK(nearRelative(w.work, 2e-3 * 2 * kPi + 1e-3 * 0.5 * kPi, 1e-12));
}

TEST_CASE("without turning there is neither mass per turn nor per energy") {
    const DriveWork w = driveWork(std::vector<double>{1}, std::vector<double>{2});
    CHECK(w.turns == 0);
    CHECK(std::isnan(w.massPerTurn(1)));
    CHECK(std::isnan(w.massPerJoule(1)));
}
