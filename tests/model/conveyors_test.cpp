// The closed form of screws and wires, by hand.
#include "host/model/conveyors.h"

#include <cmath>

#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using test::nearRelative;

namespace {

/// A screw of 12 mm diameter on a shaft of 5 mm, with a blade of 1 mm and a pitch of 8 mm, 30 mm long.
constexpr double kRim = 6e-3, kPitch = 8e-3, kScrewLength = 30e-3;
/// In a turn it carries the pitch less the blade, between shaft and rim [m3].
const double kPerTurn = (8e-3 - 1e-3) * kPi * (6e-3 * 6e-3 - 2.5e-3 * 2.5e-3);

/// At x, along z. It follows the drive and conveys towards +z.
RigidBody screwAt(double x, int hand = 1) {
    RigidBody body;
    body.name = x == 0 ? "screw" : "second";
    geometry::Flight flight;
    flight.innerRadius = 2.5e-3;
    flight.outerRadius = kRim;
    flight.thickness = 1e-3;
    flight.pitchStart = flight.pitchEnd = kPitch;
    flight.angle = 2 * kPi * kScrewLength / kPitch;
    flight.hand = hand;
    body.shapes = {flight, geometry::Cone{Vec3(0), Vec3(0, 0, 1), 2.5e-3, 2.5e-3, kScrewLength}};
    body.course.start.origin = Vec3(x, 0, 0);
    body.course.motion = geometry::Turn{Vec3(0, 0, 1), Vec3(x, 0, 0), hand > 0 ? -1.0 : 1.0};
    body.clock = Clock::Drive;
    return body;
}

Case deviceOf(std::vector<RigidBody> bodies) {
    Case c;
    c.canister = Canister{};
    c.schedule.rotateTime = 2;
    c.schedule.restTime = 0.5;
    c.schedule.coilSpeed = 2 * kPi;  // a turn in a second
    c.bulkDensity = 500;
    c.filling.list = Particles{};  // the powder plays no part
    c.world.bodies = std::move(bodies);
    return c;
}

/// It turns about itself at a turn in a second, by time.
RigidBody byTime(RigidBody body, double turnsInSecond = 1) {
    body.clock = Clock::Time;
    std::get<geometry::Turn>(body.course.motion).rate *= 2 * kPi * turnsInSecond;
    return body;
}

bool hasNone(RigidBody body) {
    return !conveyanceOf(deviceOf({std::move(body)}));
}

}  // namespace

TEST_CASE("a screw carries its pitch less its blade, between shaft and rim") {
    const auto sum = conveyanceOf(deviceOf({screwAt(0)}));
    REQUIRE(sum);
    CHECK(nearRelative(sum->volume(), kPerTurn, 1e-12));
    CHECK(nearRelative(sum->volume(), 654.2366e-9, 1e-6));  // 7 pi 29.75 mm3
    CHECK(sum->byDrive);
    CHECK(sum->names() == std::vector<std::string>{"screw"});
    const Derived d = derive(deviceOf({screwAt(0)}), {});
    CHECK(nearRelative(d.massPerTurn, 500 * kPerTurn, 1e-12));
    CHECK(nearRelative(d.massPerDose, 2 * 500 * kPerTurn, 1e-12));
    CHECK(nearRelative(d.rate(4 * kPi), 2 * 500 * kPerTurn, 1e-12));
    CHECK(nearRelative(d.pushVelocity, kPitch, 1e-12));
    CHECK(nearRelative(d.tipVelocity, 2 * kPi * kRim, 1e-12));
    CHECK(conveyanceOf(deviceOf({screwAt(0, -1)})));  // left-handed, and turns the other way
}

TEST_CASE("a wire carries its pitch within its centre line, as the coil does") {
    RigidBody body = screwAt(0);
    geometry::Coil wire;
    wire.radius = 4e-3;
    wire.wireRadius = 0.5e-3;
    wire.pitch = 6e-3;
    wire.length = kScrewLength;
    body.shapes = {wire};
    const auto sum = conveyanceOf(deviceOf({body}));
    REQUIRE(sum);
    CHECK(nearRelative(sum->volume(), 6 * kPi * 16 * 1e-9, 1e-12));  // 6 mm times the circle of 4 mm
}

TEST_CASE("of two screws that reach into one another the common area counts once") {
    // Circles of 6 mm, 9 mm apart, share 72 acos(3/4) - 4.5 sqrt(63) = 16.319223 mm2.
    CHECK(nearRelative(sharedArea(6e-3, 6e-3, 9e-3), 16.319223e-6, 1e-6));
    const double twin = 2 * kPerTurn - kPitch * 16.319223e-6;
    for (const int hand : {1, -1}) {  // the two turn the same way, or against one another
        const auto sum = conveyanceOf(deviceOf({screwAt(0), screwAt(9e-3, hand)}));
        REQUIRE(sum);
        CHECK(sum->names() == std::vector<std::string>{"screw", "second"});
        CHECK(nearRelative(sum->volume(), twin, 1e-6));
    }
    // Side by side they share nothing.
    CHECK(nearRelative(conveyanceOf(deviceOf({screwAt(0), screwAt(12.5e-3)}))->volume(), 2 * kPerTurn, 1e-12));
    // One that carries backwards, or ends far from the first, counts not.
    RigidBody back = screwAt(9e-3);
    std::get<geometry::Turn>(back.course.motion).rate = 1;
    CHECK(nearRelative(conveyanceOf(deviceOf({screwAt(0), back}))->volume(), kPerTurn, 1e-12));
    RigidBody behind = screwAt(9e-3);
    behind.course.start.origin.z = -2 * kPitch;
    CHECK(nearRelative(conveyanceOf(deviceOf({screwAt(0), behind}))->volume(), kPerTurn, 1e-12));
}

TEST_CASE("the area that two circles share is that of points in both") {
    for (const auto& [a, b, apart] :
         {std::tuple(1.0, 1.0, 0.5), std::tuple(1.0, 0.4, 0.8), std::tuple(0.7, 1.0, 1.2), std::tuple(1.0, 0.3, 0.2)}) {
        int both = 0;
        constexpr int kSide = 1000;
        for (int i = 0; i < kSide; ++i)
            for (int k = 0; k < kSide; ++k) {
                const double x = 2 * (i + 0.5) / kSide - 1, y = 2 * (k + 0.5) / kSide - 1;
                both += std::hypot(x, y) < a && std::hypot(x - apart, y) < b ? 1 : 0;
            }
        CAPTURE(a, b, apart);
        CHECK(nearRelative(sharedArea(a, b, apart), 4.0 * both / (kSide * kSide), 2e-3));  // some cells are cut
    }
    CHECK(sharedArea(1, 1, 2) == 0);
    CHECK(sharedArea(1, 0.5, 0.5) == Approx(kPi / 4));
}

TEST_CASE("a screw that turns by itself has a rate, and carries on in rests unless it moves in the rotation alone") {
    const Derived always = derive(deviceOf({byTime(screwAt(0), 3)}), {});
    CHECK(always.massPerTurn == 0);
    CHECK(nearRelative(always.massPerSecond, 3 * 500 * kPerTurn, 1e-12));
    CHECK(nearRelative(always.massPerDose, 2.5 * always.massPerSecond, 1e-12));
    CHECK(nearRelative(always.pushVelocity, 3 * kPitch, 1e-12));
    CHECK(always.conveys());
    RigidBody body = byTime(screwAt(0));
    body.clock = Clock::Phases;
    body.phases = {Phase::Rotate};
    const Derived rotating = derive(deviceOf({body}), {});
    CHECK(nearRelative(rotating.massPerDose, 2 * 500 * kPerTurn, 1e-12));
    body.phases = {Phase::Rest};
    CHECK(hasNone(body));
    // Without doses there is a rate all the same.
    Case c = deviceOf({byTime(screwAt(0))});
    c.schedule.rotateTime = 0;
    CHECK(nearRelative(derive(c, {}).rate(0), 500 * kPerTurn, 1e-12));
    CHECK(derive(c, {}).massPerDose == 0);
    c.world.bodies[0].course.schedule.intervals = {{0.5, geometry::kEndless}};
    CHECK(nearRelative(derive(c, {}).rate(0), 500 * kPerTurn, 1e-12));
    c.world.bodies[0].course.schedule.intervals = {{0.5, 2}};
    CHECK_FALSE(derive(c, {}).conveys());
}

TEST_CASE("there is no closed form without a screw, a steady turn about its axis and a way out") {
    RigidBody body = screwAt(0);
    std::get<geometry::Turn>(body.course.motion).rate = 1;  // to the rear wall
    CHECK(hasNone(body));
    body = screwAt(0);
    body.course.motion = geometry::Swing{Vec3(0, 0, 1), Vec3(0), 0.5, 2, 0};
    CHECK(hasNone(body));
    body.course.motion = geometry::Turn{Vec3(0, 0, 1), Vec3(2e-3, 0, 0), -1};  // not about itself
    CHECK(hasNone(body));
    body = byTime(screwAt(0));
    body.course.schedule.intervals = {{0.5, geometry::kEndless}};  // the first dose begins without it
    CHECK(hasNone(body));
    body.course.schedule.intervals = {{0, 10}};
    CHECK(hasNone(body));
    body.course.schedule.intervals = {{0, geometry::kEndless}};
    CHECK_FALSE(hasNone(body));
    body.shapes = {geometry::Block{Vec3(-5e-3), Vec3(5e-3)}};
    CHECK(hasNone(body));
}

TEST_CASE("a screw along any axis carries out if the region where powder is dosed does not lie behind it") {
    RigidBody body = screwAt(0);
    const geometry::Rotation across = glm::angleAxis(kPi / 2, Vec3(0, 1, 0));  // z to x
    body.course.start.rotation = across;
    std::get<geometry::Turn>(body.course.motion).axis = Vec3(1, 0, 0);
    CHECK(hasNone(body));  // a canister doses along z
    Case c = deviceOf({body});
    c.canister.reset();
    CHECK_FALSE(conveyanceOf(c));  // nothing is dosed anywhere
    CountRegion pan;
    pan.kind = CountRegion::Kind::Box;
    pan.low = Vec3(0.03, -0.1, -0.05);
    pan.high = Vec3(0.08, -0.05, 0.05);
    c.world.regions = {pan};
    REQUIRE(conveyanceOf(c));
    CHECK(nearRelative(conveyanceOf(c)->volume(), kPerTurn, 1e-12));
    c.world.regions[0].low.x = -0.08;
    c.world.regions[0].high.x = -0.03;
    CHECK_FALSE(conveyanceOf(c));
    c.world.regions[0] = CountRegion{"below", CountRegion::Kind::Beyond, Vec3(0, -0.05, 0), Vec3(0, -1, 0)};
    CHECK(conveyanceOf(c));
}
