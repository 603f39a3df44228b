// Motions are closed forms of time: velocities are derivatives of places, and bounds hold.

#include "geometry/motion.h"

#include <random>

#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::geometry;
using test::near;
using test::nearRelative;

namespace {

const Vec3 kAxis = glm::normalize(Vec3(1, -2, 0.5));
const Vec3 kThrough(0.3, 0.1, -0.2);

std::vector<Motion> everyMotion() {
    return {Rest{},
            Turn{kAxis, kThrough, 7.5},
            Turn{kAxis, kThrough, -0.2},
            Swing{kAxis, kThrough, 0.7, 3.0, 0.4},
            Shake{kAxis, 2e-3, 50.0, -1.0},
            Slide{Vec3(0.1, -0.2, 0.3)},
            Table{kAxis,
                  kThrough,
                  {{0.1, 0, Vec3(0)}, {0.4, 1.5, Vec3(0.1, 0, 0)}, {0.5, 1.5, Vec3(0)}, {1.1, -1, Vec3(0, 0, 0.2)}}}};
}

std::vector<Schedule> everySchedule() {
    return {{}, {{{0.2, 0.5}, {0.7, 0.9}}}, {{{-1, 0.05}}}};
}

Pose start() {
    return {glm::angleAxis(0.8, glm::normalize(Vec3(1, 1, 0))), Vec3(0.05, -0.4, 0.1)};
}

}  // namespace

TEST_CASE("the velocity of a body is the derivative of its pose") {
    const Vec3 x(0.2, 0.3, -0.1);
    for (std::size_t m = 0; m < everyMotion().size(); ++m)
        for (const Schedule& schedule : everySchedule()) {
            const Course course{start(), everyMotion()[m], schedule};
            REQUIRE(motionFault(course.motion) == "");
            REQUIRE(scheduleFault(schedule) == "");
            for (int n = 0; n < 25; ++n) {
                constexpr double kStep = 1e-5;
                const double t = 0.013 + 0.0517 * n;
                CAPTURE(m, t);
                const Vec3 after = course.pose(t + kStep).toWorld(x), before = course.pose(t - kStep).toWorld(x);
                const Vec3 velocity = (after - before) / (2 * kStep);
                // The largest speeds here are of the order of 5 m/s; the error is a sixth of the third derivative.
                CHECK(near(course.moving(t).at(course.pose(t).toWorld(x)), velocity, 5, 1e-5));
            }
        }
}

TEST_CASE("a pose is a rigid motion, and its inverse leads back") {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (const Motion& motion : everyMotion())
        for (int n = 0; n < 20; ++n) {
            const Course course{start(), motion, {}};
            const Pose pose = course.pose(5 * (1 + unit(random)));
            const Vec3 a(unit(random), unit(random), unit(random)), b(unit(random), unit(random), unit(random));
            CHECK(near(glm::length(pose.toWorld(a) - pose.toWorld(b)), glm::length(a - b), 1, 1e-14));
            CHECK(near(pose.toBody(pose.toWorld(a)), a, 1, 1e-14));
            CHECK(near(pose.directionToWorld(pose.directionToBody(a)), a, 1, 1e-14));
            CHECK(near(pose.toWorld(a) - pose.toWorld(b), pose.directionToWorld(a - b), 1, 1e-14));
        }
}

TEST_CASE("poses are where closed forms say") {
    const Vec3 x(0.5, 0, 0);
    const Course quarter{{}, Turn{{0, 0, 1}, {0, 0, 0}, kPi}, {}};
    CHECK(near(quarter.pose(0.5).toWorld(x), Vec3(0, 0.5, 0), 1, 1e-15));
    CHECK(near(quarter.pose(1e6 + 0.5).toWorld(x), Vec3(0, 0.5, 0), 1, 1e-9));
    const Course aside{{}, Turn{{0, 0, 1}, {1, 0, 0}, kPi}, {}};
    CHECK(near(aside.pose(1).toWorld(x), Vec3(1.5, 0, 0), 1, 1e-15));
    const Course swing{{}, Swing{{0, 0, 1}, {0, 0, 0}, kPi / 2, 2, 0}, {}};
    CHECK(near(swing.pose(0.125).toWorld(x), Vec3(0, 0.5, 0), 1, 1e-15));
    CHECK(near(swing.pose(0.375).toWorld(x), Vec3(0, -0.5, 0), 1, 1e-15));
    const Course tapped{{}, Shake{{0, 1, 0}, 1e-3, 10, kPi / 2}, {}};
    CHECK(near(tapped.pose(0).toWorld(x), Vec3(0.5, 1e-3, 0), 1e-3, 1e-12));
    // Of a table the first and the last row hold before and after.
    const Course table{{}, everyMotion()[6], {}};
    CHECK(near(table.pose(-3).toWorld(x), x, 1, 1e-15));
    CHECK(near(table.pose(99).toWorld(x), table.pose(1.1).toWorld(x), 1, 1e-15));
    CHECK(near(table.moving(99).at(x), Vec3(0), 1, 0));
    // In the middle of a row's way, the shift is halfway.
    CHECK(near(table.pose(0.45).toWorld(kThrough), kThrough + Vec3(0.05, 0, 0), 1, 1e-14));
}

TEST_CASE("a motion repeats itself after its period, and is elsewhere after half of it") {
    std::size_t periodic = 0;
    for (const Motion& motion : everyMotion()) {
        const std::optional<double> period = periodOf(motion);
        if (!period) continue;
        ++periodic;
        const Course course{Pose{}, motion, {}};
        const auto place = [&](double t) { return course.pose(t).toWorld(Vec3(1, 2, 3)); };
        for (const double t : {0.0, 0.123 * *period, 0.7 * *period}) {
            CHECK(near(place(t + *period), place(t), 1, 1e-12));
            CHECK(glm::length(place(t + *period / 2) - place(t)) > 1e-5);
        }
    }
    CHECK(periodic == 4);
    CHECK(nearRelative(*periodOf(Turn{kAxis, kThrough, -4 * kPi}), 0.5, 1e-12));
    CHECK_FALSE(periodOf(Turn{kAxis, kThrough, 0}));
    CHECK_FALSE(periodOf(Shake{kAxis, 1e-3, 0, 0}));
}

TEST_CASE("a body stands still between the intervals of its schedule, and goes on where it was") {
    const Schedule schedule{{{0.2, 0.5}, {0.7, 0.9}}};
    CHECK(schedule.elapsed(0.1) == 0);
    CHECK(nearRelative(schedule.elapsed(0.6), 0.3, 1e-12));
    CHECK(nearRelative(schedule.elapsed(0.8), 0.4, 1e-12));
    CHECK(nearRelative(schedule.elapsed(2), 0.5, 1e-12));
    CHECK_FALSE(schedule.active(0.1));
    CHECK(schedule.active(0.2));
    CHECK_FALSE(schedule.active(0.5));
    const Course course{start(), Turn{kAxis, kThrough, 3}, schedule}, always{start(), Turn{kAxis, kThrough, 3}, {}};
    const Vec3 x(1, 0, 0);
    CHECK(near(course.pose(0.6).toWorld(x), always.pose(0.3).toWorld(x), 1, 1e-14));
    CHECK(near(course.moving(0.6).at(x), Vec3(0), 1, 0));
}

TEST_CASE("no point of a body goes further in a step than the bound, and the bound is not far off") {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> unit(-1, 1);
    const Vec3 centre(0.1, -0.2, 0.3);
    constexpr double kRadius = 0.25;
    for (std::size_t m = 0; m < everyMotion().size(); ++m)
        for (const Schedule& schedule : everySchedule()) {
            const Course course{start(), everyMotion()[m], schedule};
            double bounded = 0, gone = 0;
            for (int n = 0; n < 3000; ++n) {
                const double t = 0.65 * (1 + unit(random)), duration = 1e-3 * (1 + unit(random));
                const Vec3 x = centre + kRadius * glm::normalize(Vec3(unit(random), unit(random), unit(random)));
                const double way = glm::length(course.pose(t + duration).toWorld(x) - course.pose(t).toWorld(x));
                const double bound = wayBound(course, centre, kRadius, t, duration);
                CAPTURE(m, t, duration, way, bound);
                REQUIRE(way <= bound * (1 + 1e-9) + 1e-15);
                if (duration < 1e-9) continue;
                gone = std::max(gone, way / duration);
                bounded = std::max(bounded, bound / duration);
            }
            CHECK(bounded <= 2 * gone);
        }
}

TEST_CASE("motions that cannot be are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Motion& bad :
         {Motion(Turn{{0, 0, 2}, {}, 1}), Motion(Turn{{0, 0, 1}, {}, nan}), Motion(Turn{{0, 0, nan}, {}, 1}),
          Motion(Turn{{0, 0, 1}, {nan, 0, 0}, 1}), Motion(Slide{{nan, 0, 0}}), Motion(Swing{{0, 0, 1}, {}, 1, -1, 0}),
          Motion(Swing{{0, 0, 0}, {}, 1, 1, 0}), Motion(Shake{{0, 0, 1}, nan, 1, 0}), Motion(Shake{{1, 1, 0}, 1, 1, 0}),
          Motion(Table{}), Motion(Table{{0, 0, 1}, {}, {{0, 0, {}}, {0, 1, {}}}}),
          Motion(Table{{0, 0, 1}, {}, {{0, 0, {}}, {1, nan, {}}}})})
        CHECK(motionFault(bad) != "");
    CHECK(scheduleFault({{{1, 1}}}) != "");
    CHECK(scheduleFault({{{0, 2}, {1, 3}}}) != "");
    CHECK(scheduleFault({{{0, nan}}}) != "");
}
