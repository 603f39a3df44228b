#include "host/model/rigid_body.h"

#include <algorithm>

namespace vkdose {

geometry::Pose RigidBody::pose(double time, double driveAngle, double own) const {
    return course.pose(clock == Clock::Time ? time : clock == Clock::Drive ? driveAngle : own);
}

geometry::Moving RigidBody::moving(double time, double driveAngle, double driveRate, std::optional<double> own) const {
    if (clock == Clock::Time) return course.moving(time);
    if (clock == Clock::Phases) return own ? course.moving(*own) : geometry::Moving{};
    // The course gives the motion per radian of the drive.
    geometry::Moving moving = course.moving(driveAngle);
    moving.velocity *= driveRate;
    moving.spin *= driveRate;
    return moving;
}

namespace {

/// The line about which a motion turns; null if it turns about none.
struct Line {
    const Vec3 *axis, *through;
};

std::optional<Line> turnedAbout(const geometry::Motion& motion) {
    if (const auto* m = std::get_if<geometry::Turn>(&motion)) return Line{&m->axis, &m->through};
    if (const auto* m = std::get_if<geometry::Swing>(&motion)) return Line{&m->axis, &m->through};
    if (const auto* m = std::get_if<geometry::Table>(&motion)) return Line{&m->axis, &m->through};
    return std::nullopt;
}

}  // namespace

Vec3 RigidBody::axis() const {
    const auto line = turnedAbout(course.motion);
    return line ? *line->axis : Vec3(0, 0, 1);
}

Vec3 RigidBody::pivot(const geometry::Pose& pose) const {
    const auto line = turnedAbout(course.motion);
    return line ? *line->through : pose.origin;
}

BodyClock clockOf(std::span<const BodyClock> clocks, std::size_t body) {
    return body < clocks.size() ? clocks[body] : BodyClock{};
}

void advanceClocks(std::vector<BodyClock>& clocks, std::uint64_t steps) {
    for (BodyClock& clock : clocks) {
        const bool passes = clock.runs && clock.steps + steps >= clock.anewAt;
        clock.steps = clock.after(steps);
        if (passes) clock.anewAt = BodyClock::kNever;
    }
}

bool followsDrive(const std::vector<RigidBody>& bodies) {
    return std::any_of(bodies.begin(), bodies.end(), [](const RigidBody& b) { return b.clock == Clock::Drive; });
}

bool movesInPhases(const std::vector<RigidBody>& bodies) {
    return std::any_of(bodies.begin(), bodies.end(), [](const RigidBody& b) { return b.clock == Clock::Phases; });
}

}  // namespace vkdose
