// The table of bodies as the device gets it.

#include "host/core/error.h"
#include "tests/geometry/facets.h"
#include "tests/geometry/shatter.h"
#include "tests/pass/narrow_phase.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::geometry;
using namespace vkdose::test;

TEST_CASE("the table of bodies tells in how many places a sphere touches one at once") {
    const auto places = [](const std::vector<RigidBody>& bodies, double largest) {
        return packBodies(bodies, largest).places;
    };
    const Coil wide{10e-3, 9e-3, 1e-3, 40e-3}, tight{10e-3, 2.6e-3, 0.5e-3, 20e-3};
    const Ball ball{Vec3(0), 2e-3};
    CHECK(places({bodyOf({ball})}, 1e-3) == 1);
    CHECK(places({bodyOf({wide})}, 1e-3) == 1);
    CHECK(places({bodyOf({wide, ball})}, 1e-3) == 2);
    CHECK(places({bodyOf({wide}), bodyOf({ball})}, 1e-3) == 1);  // of one body at a time
    CHECK(places({bodyOf({tight})}, 1e-3) == 3);                 // a sphere fits between two of its turns
    CHECK(places({bodyOf({tight, ball, ball})}, 1e-3) == gpu::kFewPlaces);
    CHECK(places({bodyOf({Block{Vec3(0), Vec3(1e-2), true}})}, 1e-3) == gpu::kFewPlaces);
    CHECK(places({bodyOf({meshOf(sheet(Vec3(0), {0.1, 0, 0}, {0, 0.1, 0}), 1e-3)})}, 1e-3) == gpu::kFewPlaces);
}

TEST_CASE("a body that the device cannot compute with is refused by its name") {
    CHECK_THROWS_WITH(packBodies({bodyOf({Flight{3e-3, 10e-3, 1e-6, 30e-6, 30e-6, 8 * kPi}})}, 1e-3),
                      Catch::Contains("part") && Catch::Contains("turns of the screw"));
    Shattered fine(sheet(Vec3(0), {0.1, 0, 0}, {0, 0.1, 0}));
    for (int n = 0; n < 6; ++n) fine.refine();
    const auto mesh = std::make_shared<MeshSurface>(fine.mesh(), 0.1);
    REQUIRE(mesh->mesh().triangles.size() > gpu::kMostInCell);
    CHECK_THROWS_WITH(packBodies({bodyOf({mesh})}, 0.1), Catch::Contains("part") && Catch::Contains("4096"));
    // A reach that is larger than the mesh was made for makes its grid anew.
    const auto small = meshOf(sheet(Vec3(0), {0.1, 0, 0}, {0, 0.1, 0}), 1e-3);
    Narrow narrow;
    const Vec3 above(0.02, 0.03, 4e-3);
    const Answer answer = narrow.ask(packBodies({bodyOf({small})}, 5e-3), {Pose{}}, {{above, 5e-3, 0}}).front();
    REQUIRE(answer.count == 1);
    CHECK(near(answer.features[0].distance, 4e-3, 1e-3, 1e-6));
}

TEST_CASE("each body of a table has its own answer, and a body without shapes none") {
    const Pose turned{glm::normalize(Rotation(0.3, 0.5, -0.2, 0.7)), Vec3(0.03, -0.01, 0.02)};
    const PackedBodies packed = packBodies(
        {bodyOf({}), bodyOf({Ball{Vec3(0), 2e-3}}), bodyOf({meshOf(block(Vec3(-1e-3), Vec3(1e-3)), 1e-3)})}, 1e-3);
    CHECK(packed.kinds == (1U << gpu::kShapeBall | 1U << gpu::kShapeMesh));
    Narrow narrow;
    const Vec3 ball(0, 0, 2.5e-3), cube = turned.toWorld({0, 0, 1.5e-3});
    const auto answers = narrow.ask(packed, {Pose{}, Pose{}, turned},
                                    {{ball, 1e-3, 0}, {ball, 1e-3, 1}, {cube, 1e-3, 2}, {cube, 1e-3, 1}});
    CHECK(answers[0].count == 0);
    CHECK_FALSE(answers[0].mayTouch);
    REQUIRE(answers[1].count == 1);
    CHECK(near(answers[1].features[0].distance, 0.5e-3, 1e-3, 1e-6));
    REQUIRE(answers[2].count == 1);
    CHECK(near(answers[2].features[0].normal, turned.directionToWorld({0, 0, 1}), 1, 1e-6));
    CHECK(answers[3].count == 0);
}
