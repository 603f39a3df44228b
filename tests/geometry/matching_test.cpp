// Contacts find their histories by direction.

#include "geometry/matching.h"

#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::geometry;
using test::near;

namespace {

Vec3 at(double degrees) {
    return {std::cos(degrees * kPi / 180), std::sin(degrees * kPi / 180), 0};
}

}  // namespace

TEST_CASE("a contact continues the nearest one within 45 degrees") {
    using Found = std::vector<std::size_t>;
    CHECK(continued({}, {}) == Found{});
    CHECK(continued({}, {at(0)}) == Found{kNew});
    CHECK(continued({at(0)}, {}) == Found{});
    CHECK(continued({at(0)}, {at(44.9)}) == Found{0});
    CHECK(continued({at(0)}, {at(45.1)}) == Found{kNew});
    CHECK(continued({at(0), at(90)}, {at(80), at(20)}) == Found{1, 0});
    // The second is nearer to what the first would take, and the first goes without.
    CHECK(continued({at(0)}, {at(30), at(-10)}) == Found{kNew, 0});
    // The first gives way to the second, and takes the next best.
    CHECK(continued({at(0), at(40)}, {at(10), at(1)}) == Found{1, 0});
    // Of two as near as each other the lower index comes first.
    CHECK(continued({at(0), at(0)}, {at(0), at(0), at(0)}) == Found{0, 1, kNew});
}

TEST_CASE("a spring is turned with the normal") {
    const Vec3 from = glm::normalize(Vec3(1, 2, 3));
    for (const double degrees : {0.0, 1e-6, 5.0, 44.0, 89.0}) {
        const Vec3 axis = glm::normalize(glm::cross(from, Vec3(0, 0, 1)));
        const double angle = degrees * kPi / 180;
        const Vec3 to = std::cos(angle) * from + std::sin(angle) * glm::cross(axis, from);
        const Vec3 aside = glm::cross(axis, from);
        const Vec3 spring = 3.0 * axis + 4.0 * aside;
        // Along the axis it stays; beside it, it turns.
        const Vec3 expected = 3.0 * axis + 4.0 * (std::cos(angle) * aside - std::sin(angle) * from);
        CHECK(near(turnedAlong(spring, from, to), expected, 5, 1e-14));
        CHECK(near(glm::dot(turnedAlong(spring, from, to), to), 0, 5, 1e-14));
        CHECK(near(turnedAlong(from, from, to), to, 1, 1e-14));
    }
}
