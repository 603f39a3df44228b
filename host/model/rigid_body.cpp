#include "host/model/rigid_body.h"

#include <algorithm>
#include <cmath>

namespace vkdose {

geometry::Pose RigidBody::pose(double time, double driveAngle, const Moved& own) const {
    geometry::Pose pose = course.pose(movesInPhases() ? own.time : clock == Clock::Drive ? driveAngle : time);
    if (clock != Clock::Forces) return pose;
    if (const geometry::Hinge* h = hinge()) return geometry::turned(pose, h->axis, h->through, own.angle);
    pose.origin += own.shift;
    return pose;
}

bool RigidBody::movesAs(const RigidBody& other) const {
    if (rests() || other.rests()) return rests() && other.rests();
    return !movesFreely() && clock == other.clock && phases == other.phases && anew == other.anew &&
           course.motion == other.course.motion && course.schedule == other.course.schedule;
}

std::uint64_t RigidBody::firstFreeStep(double timeStep) const {
    if (course.schedule.intervals.empty()) return 0;
    const double from = course.schedule.intervals.front().from / timeStep;
    return static_cast<std::uint64_t>(std::ceil(from - 1e-6));  // but for rounding
}

double RigidBody::kickOf(std::uint64_t step, double timeStep) const {
    const std::uint64_t first = firstFreeStep(timeStep);
    return step < first ? 0 : step == first ? timeStep / 2 : timeStep;
}

geometry::Moving RigidBody::moving(double time, double driveAngle, double driveRate, std::optional<double> own) const {
    if (movesInPhases()) return own ? course.moving(*own) : geometry::Moving{};
    if (clock != Clock::Drive) return course.moving(time);
    // The course gives the motion per radian of the drive.
    geometry::Moving moving = course.moving(driveAngle);
    moving.velocity *= driveRate;
    moving.spin *= driveRate;
    return moving;
}

double RigidBody::driveOf(double time, std::optional<double> own) const {
    if (movesInPhases()) return own ? course.drive(*own) : 0;
    return course.drive(time);
}

double RigidBody::perMass(const Vec3& x, const Vec3& normal) const {
    if (const auto* free = std::get_if<geometry::Free>(&course.motion)) return 1 / free->mass;
    const geometry::Hinge* h = hinge();
    if (h == nullptr) return 0;
    const double lever = glm::dot(h->axis, glm::cross(x - h->through, normal));
    return lever * lever / h->inertia;
}

namespace {

/// The line about which a motion turns. Null for a motion that does not turn.
struct Line {
    const Vec3 *axis, *through;
};

std::optional<Line> turnedAbout(const geometry::Motion& motion) {
    if (const auto* m = std::get_if<geometry::Turn>(&motion)) return Line{&m->axis, &m->through};
    if (const auto* m = std::get_if<geometry::Swing>(&motion)) return Line{&m->axis, &m->through};
    if (const auto* m = std::get_if<geometry::Table>(&motion)) return Line{&m->axis, &m->through};
    if (const auto* m = std::get_if<geometry::Hinge>(&motion)) return Line{&m->axis, &m->through};
    return std::nullopt;
}

}  // namespace

Vec3 RigidBody::axis() const {
    if (const auto* free = std::get_if<geometry::Free>(&course.motion); free != nullptr && free->line)
        return *free->line;
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
    return std::any_of(bodies.begin(), bodies.end(), [](const RigidBody& b) { return b.movesInPhases(); });
}

bool movesInDoses(const std::vector<RigidBody>& bodies) {
    return std::any_of(bodies.begin(), bodies.end(), [](const RigidBody& b) {
        const bool rotates = std::find(b.phases.begin(), b.phases.end(), Phase::Rotate) != b.phases.end();
        return b.clock == Clock::Drive || rotates;
    });
}

bool moveFreely(const std::vector<RigidBody>& bodies) {
    return std::any_of(bodies.begin(), bodies.end(), [](const RigidBody& b) { return b.movesFreely(); });
}

std::vector<FreeBody> freeAtStart(const std::vector<RigidBody>& bodies) {
    std::vector<FreeBody> start(bodies.size());
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        if (const auto* free = std::get_if<geometry::Free>(&bodies[b].course.motion))
            start[b].velocity = free->velocity;
        if (const geometry::Hinge* hinge = bodies[b].hinge()) start[b].rate = hinge->rate;
    }
    return start;
}

}  // namespace vkdose
