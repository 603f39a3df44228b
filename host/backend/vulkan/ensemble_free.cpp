// The bodies of an ensemble that move freely. The host knows where they are between two batches; in a batch the device
// goes on from there by itself (shaders/pass/free_bodies.comp).

#include <algorithm>
#include <limits>

#include "host/backend/vulkan/ensemble.h"
#include "host/backend/vulkan/pack.h"
#include "host/backend/vulkan/pack_bodies.h"
#include "host/backend/vulkan/split.h"

namespace vkdose {

namespace {

static_assert(gpu::kAtStop == float(geometry::kAtStop));

constexpr const char* kSaved = "free_bodies";

/// A stop, on a device.
float kept(double stop) {
    constexpr double kMost = std::numeric_limits<float>::max();
    return float(std::clamp(stop, -kMost, kMost));
}

/// Calls `visit` for each of the numbers that tell where a body has come to: its place and its velocity, on a hinge its
/// angle, its rate and where it is by them; high and low parts.
template <class Motion, class Visit>
void eachNumber(Motion& m, Visit visit) {
    for (int d = 0; d < 3; ++d) {
        visit(m.toBodyHigh[d].w);
        visit(m.toBodyLow[d].w);
        visit(m.velocity[d]);
        visit(m.free[d]);
    }
    if (m.hinge.w == 0) return;
    for (int d = 0; d < 3; ++d) {
        for (int k = 0; k < 3; ++k) {
            visit(m.toBodyHigh[d][k]);
            visit(m.toBodyLow[d][k]);
        }
        visit(m.hinge[d]);
        visit(m.spin[d]);
    }
}

/// As `standing`, of a body on a hinge. `lever`: no point of it is farther from the axis [m].
gpu::BodyMotion standingOnHinge(const RigidBody& body, const geometry::Pose& pose, bool moves, double lever) {
    const geometry::Hinge& hinge = *body.hinge();
    const double start = moves ? hinge.rate : 0;
    gpu::BodyMotion m = packMotion(body, pose, {Vec3(0), start * hinge.axis, hinge.through});
    const Split rate(start);
    const Split3 axis(hinge.axis), through(hinge.through);
    m.free = gpu::vec4(rate.low, 0, 0, float(1 / hinge.inertia));
    m.line = gpu::vec4(axis.high, 0);
    m.held = gpu::vec4(0, 0, kept(hinge.low), kept(hinge.high));
    m.hinge = gpu::vec4(0, 0, rate.high, float(lever));
    m.axisLow = gpu::vec4(axis.low, 0);
    m.pivotLow = gpu::vec4(through.low, 0);
    return m;
}

/// A body that has not moved freely yet, in this pose and with this spin: it stands, until the step at whose beginning
/// it has its first velocity.
gpu::BodyMotion standing(const RigidBody& body, const geometry::Pose& pose, const Vec3& spin, std::uint64_t step,
                         double timeStep, double lever) {
    if (body.hinge() != nullptr) return standingOnHinge(body, pose, step >= body.firstFreeStep(timeStep), lever);
    const auto& motion = std::get<geometry::Free>(body.course.motion);
    const Vec3 velocity = step >= body.firstFreeStep(timeStep) ? motion.velocity : Vec3(0);
    gpu::BodyMotion m = packMotion(body, pose, {velocity, spin, pose.origin});
    const Split3 speed(velocity);
    m.velocity = gpu::vec4(speed.high, m.velocity.w);
    m.free = gpu::vec4(speed.low, float(1 / motion.mass));
    m.line = gpu::vec4(motion.line ? glm::vec3(*motion.line) : glm::vec3(0), 0);
    const double start = motion.line ? glm::dot(body.course.start.origin, *motion.line) : 0;
    m.held.z = kept(start + motion.low);
    m.held.w = kept(start + motion.high);
    return m;
}

gpu::BodyMotion standingAtStart(const RigidBody& body, std::uint64_t step, double timeStep, double lever) {
    return standing(body, body.pose(0, 0), Vec3(0), step, timeStep, lever);
}

/// The same body where it has come to by its forces.
gpu::BodyMotion goingOn(gpu::BodyMotion motion, const gpu::BodyMotion& at) {
    std::vector<float> numbers;
    eachNumber(at, [&](float x) { numbers.push_back(x); });
    auto from = numbers.begin();
    eachNumber(motion, [&](float& x) { x = *from++; });
    motion.way = at.way;
    return motion;
}

/// A bound of the distance of the body's points from its hinge, by the sphere around it in its frame [m]; 0: it has
/// none.
double leverOf(const RigidBody& body, const gpu::vec4& around) {
    const geometry::Hinge* hinge = body.hinge();
    if (hinge == nullptr) return 0;
    const geometry::Course once{body.course.start, geometry::Turn{hinge->axis, hinge->through, 1}, {}};
    return geometry::wayBound(once, Vec3(glm::vec3(around)), double(around.w), 0, 1);
}

}  // namespace

void Ensemble::placeFree(MemberState& m) {
    m.at.assign(m.bodies.size(), {});
    for (std::size_t b = 0; b < m.bodies.size(); ++b)
        if (m.bodies[b].movesFreely())
            m.at[b] = standingAtStart(m.bodies[b], 0, m.world.timeStep, leverOf(m.bodies[b], m.around[b]));
}

gpu::BodyMotion Ensemble::motionOfFree(const MemberState& m, std::size_t b, std::uint32_t n, const Driven& driven) {
    const double dt = m.world.timeStep;
    const RigidBody& body = m.bodies[b];
    gpu::BodyMotion motion = standing(body, driven.pose, driven.spin, m.step + n, dt, leverOf(body, m.around[b]));
    if (n == 0) motion = goingOn(motion, m.at[b]);
    const double kick = body.kickOf(m.step + n, dt);
    motion.line.w = float(kick);
    if (const geometry::Hinge* hinge = body.hinge()) {
        const glm::dvec2 weight = hinge->weight(m.world.gravity) / hinge->inertia;
        motion.held.x = float(driven.drive / hinge->inertia);
        motion.held.y = float(kick * hinge->damping / hinge->inertia);
        motion.axisLow.w = float(weight.x);
        motion.pivotLow.w = float(weight.y);
        return motion;
    }
    const auto& free = std::get<geometry::Free>(body.course.motion);
    motion.held.x = float(driven.drive / free.mass);
    motion.held.y = float(kick * free.damping / free.mass);
    for (int d = 0; d < 3; ++d) motion.pivot[d] = motion.toBodyHigh[d].w;  // RigidBody::pivot
    return motion;
}

void Ensemble::readFree(MemberState& m, std::uint32_t count) const {
    if (!m.free) return;
    const std::size_t first = m.block.bodies.z + std::size_t(count) * m.block.bodies.w;
    m.at = bodies_->motions.readAll<gpu::BodyMotion>(m.bodies.size(), first * sizeof(gpu::BodyMotion));
}

std::vector<FreeBody> Ensemble::freeBodies(std::uint32_t member) const {
    const MemberState& m = members_[member];
    if (!m.free) return {};
    std::vector<FreeBody> bodies(m.world.bodies.size());
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        if (!m.bodies[b].movesFreely()) continue;
        const gpu::BodyMotion& at = m.at[b];
        if (m.bodies[b].hinge() != nullptr) {
            bodies[b].angle = double(at.hinge.x) + double(at.hinge.y);
            bodies[b].rate = double(at.hinge.z) + double(at.free.x);
            continue;
        }
        for (int d = 0; d < 3; ++d) {
            const double place = double(at.toBodyHigh[d].w) + double(at.toBodyLow[d].w);
            bodies[b].shift[d] = place - m.bodies[b].course.start.origin[d];
            bodies[b].velocity[d] = double(at.velocity[d]) + double(at.free[d]);
        }
    }
    return bodies;
}

void Ensemble::saveFree(const MemberState& m, Record& record) {
    if (!m.free) return;
    std::vector<float> numbers;
    for (std::size_t b = 0; b < m.bodies.size(); ++b)
        if (m.bodies[b].movesFreely()) eachNumber(m.at[b], [&](float x) { numbers.push_back(x); });
    record.put(kSaved, std::move(numbers));
}

void Ensemble::restoreFree(const Record& record, std::uint64_t step, MemberState& m) {
    if (!m.free) return;
    std::size_t count = 0;
    for (std::size_t b = 0; b < m.bodies.size(); ++b)
        if (m.bodies[b].movesFreely()) eachNumber(m.at[b], [&](float) { ++count; });
    auto next = record.get<float>(kSaved, count).begin();
    for (std::size_t b = 0; b < m.bodies.size(); ++b) {
        if (!m.bodies[b].movesFreely()) continue;
        eachNumber(m.at[b], [&](float& x) { x = *next++; });
        // A state of another time step may know it as standing where it begins to move here.
        if (step <= m.bodies[b].firstFreeStep(m.world.timeStep))
            m.at[b] = standingAtStart(m.bodies[b], step, m.world.timeStep, leverOf(m.bodies[b], m.around[b]));
    }
}

}  // namespace vkdose
