// Surfaces that coincide where a sphere can be are found, and no others.

#include "geometry/coincidence.h"

#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::geometry;

namespace {

constexpr double kA = 0.6e-3;  // radius of the sphere
const Vec3 kLow(-0.03, -0.03, -0.01), kHigh(0.03, 0.05, 0.08);

bool coincide(const std::vector<Surface>& surfaces) {
    const auto found = findCoincidence(surfaces, kA, kLow, kHigh);
    if (!found) return false;
    // The reported coincidence is true.
    const Closest a = closestPoint(surfaces[found->first], found->centre),
                  b = closestPoint(surfaces[found->second], found->centre);
    CHECK(test::near(a.distance, kA, kA, 0.021));
    CHECK(test::near(b.distance, kA, kA, 0.021));
    CHECK(glm::dot(a.normal, b.normal) > 0.999);
    return true;
}

const Plane kFloor{{0, -0.0115, 0}, {0, 1, 0}};
const Trough kTrough{0.0115};
const Front kFront{0.06, 0.0115, 0.01};

}  // namespace

TEST_CASE("coincidence: one wall given twice, and nearly so") {
    CHECK(coincide({kFloor, kFloor}));
    CHECK(coincide({kFloor, Plane{{0.02, -0.0115, 0.01}, {0, 1, 0}}}));
    CHECK(coincide({kFloor, Plane{{0, -0.0115 + 0.01 * kA, 0}, {0, 1, 0}}}));
    CHECK(coincide({Tube{{0, 0, 0}, {0, 1, 0}, 0.01}, Tube{{0, 0.03, 0}, {0, -1, 0}, 0.01, 0.05}}));
    CHECK(coincide({kTrough, Plane{{0, 0, 0}, {0, 0, 1}}, Plane{{0.0115, 0, 0}, {-1, 0, 0}}}));
}

TEST_CASE("coincidence: a trough without an end and a throat of its width") {
    CHECK(coincide({kTrough, Plane{{0, 0, 0}, {0, 0, 1}}, kFront}));
    CHECK(coincide({kTrough, Front{0.06, 0.0115 - 5e-6, 0.01}}));
    CHECK_FALSE(coincide({kTrough, Front{0.06, 0.0105, 0.01}}));  // nothing touches the trough from within the throat
    CHECK_FALSE(coincide({Trough{0.0115, 0.06}, Plane{{0, 0, 0}, {0, 0, 1}}, kFront}));
}

TEST_CASE("coincidence: a cylinder that lies on a plane, along a line") {
    CHECK(coincide({kFloor, Tube{{0, 0, 0}, {0, 0, 1}, 0.0115}}));
    CHECK_FALSE(coincide({kFloor, Tube{{0, 0, 0}, {0, 0, 1}, 0.0135}}));     // the plane cuts it, at an angle
    CHECK_FALSE(coincide({kFloor, Tube{{0, 0.01, 0}, {0, 1, 0}, 0.0115}}));  // it stands on it
}

TEST_CASE("coincidence: corners, wedges, opposite sides and what lies behind another wall are none") {
    const double s = std::sqrt(0.5);
    CHECK_FALSE(coincide({kFloor, Plane{{0, 0, 0}, {1, 0, 0}}}));
    CHECK_FALSE(coincide({Plane{{0, 0, 0}, {s, s, 0}}, Plane{{0, 0, 0}, {-s, s, 0}}}));
    CHECK_FALSE(coincide({kFloor, Plane{{0, -0.0115, 0}, {0.08715574274765817, 0.9961946980917455, 0}}}));  // 5 degrees
    CHECK_FALSE(coincide({kFloor, Plane{{0, -0.0115 + 2 * kA, 0}, {0, -1, 0}}}));
    CHECK_FALSE(coincide({kFloor, Plane{{0, -0.0115 - 0.1 * kA, 0}, {0, 1, 0}}}));
    // Two that coincide behind a third are out of reach.
    CHECK_FALSE(coincide({kFloor, kFloor, Plane{{0, -0.01, 0}, {0, 1, 0}}}));
}
