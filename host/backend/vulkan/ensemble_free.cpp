// The bodies of an ensemble that move freely. The host knows where they are between two batches; in a batch the device
// goes on from there by itself (shaders/pass/free_bodies.comp).

#include <algorithm>
#include <array>
#include <limits>

#include "host/backend/vulkan/ensemble.h"
#include "host/backend/vulkan/pack.h"
#include "host/backend/vulkan/pack_bodies.h"
#include "host/backend/vulkan/split.h"

namespace vkdose {

namespace {

static_assert(gpu::kAtStop == float(geometry::kAtStop));

constexpr const char* kSaved = "free_bodies";
constexpr std::size_t kNumbers = 12;  // of each body: its place and its velocity, high and low parts

/// Calls `visit` for each of these numbers.
template <class Motion, class Visit>
void eachNumber(Motion& m, Visit visit) {
    for (int d = 0; d < 3; ++d) {
        visit(m.toBodyHigh[d].w);
        visit(m.toBodyLow[d].w);
        visit(m.velocity[d]);
        visit(m.free[d]);
    }
}

/// A body that has not moved freely yet, in this pose and with this spin: it stands, until the step at whose beginning
/// it has its first velocity.
gpu::BodyMotion standing(const RigidBody& body, const geometry::Pose& pose, const Vec3& spin, std::uint64_t step,
                         double timeStep) {
    const auto& motion = std::get<geometry::Free>(body.course.motion);
    const Vec3 velocity = step >= body.firstFreeStep(timeStep) ? motion.velocity : Vec3(0);
    gpu::BodyMotion m = packMotion(body, pose, {velocity, spin, pose.origin});
    const Split3 speed(velocity);
    m.velocity = gpu::vec4(speed.high, m.velocity.w);
    m.free = gpu::vec4(speed.low, float(1 / motion.mass));
    m.line = gpu::vec4(motion.line ? glm::vec3(*motion.line) : glm::vec3(0), 0);
    const double start = motion.line ? glm::dot(body.course.start.origin, *motion.line) : 0;
    constexpr double kMost = std::numeric_limits<float>::max();
    m.held.z = float(std::max(start + motion.low, -kMost));
    m.held.w = float(std::min(start + motion.high, kMost));
    return m;
}

gpu::BodyMotion standingAtStart(const RigidBody& body, std::uint64_t step, double timeStep) {
    return standing(body, body.pose(0, 0), Vec3(0), step, timeStep);
}

/// The same body where it has come to by its forces.
gpu::BodyMotion goingOn(gpu::BodyMotion motion, const gpu::BodyMotion& at) {
    std::array<float, kNumbers> numbers{};
    auto to = numbers.begin();
    eachNumber(at, [&](float x) { *to++ = x; });
    auto from = numbers.begin();
    eachNumber(motion, [&](float& x) { x = *from++; });
    motion.way = at.way;
    return motion;
}

}  // namespace

void Ensemble::placeFree(MemberState& m) {
    m.at.assign(m.bodies.size(), {});
    for (std::size_t b = 0; b < m.bodies.size(); ++b)
        if (m.bodies[b].movesFreely()) m.at[b] = standingAtStart(m.bodies[b], 0, m.world.timeStep);
}

gpu::BodyMotion Ensemble::motionOfFree(const MemberState& m, std::size_t b, std::uint32_t n, const Driven& driven) {
    const double dt = m.world.timeStep;
    const RigidBody& body = m.bodies[b];
    const auto& free = std::get<geometry::Free>(body.course.motion);
    gpu::BodyMotion motion = standing(body, driven.pose, driven.spin, m.step + n, dt);
    if (n == 0) motion = goingOn(motion, m.at[b]);
    const double kick = body.kickOf(m.step + n, dt);
    motion.line.w = float(kick);
    motion.held.x = float(driven.force / free.mass);
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
    for (const RigidBody& body : m.bodies) count += body.movesFreely() ? 1 : 0;
    auto next = record.get<float>(kSaved, kNumbers * count).begin();
    for (std::size_t b = 0; b < m.bodies.size(); ++b) {
        if (!m.bodies[b].movesFreely()) continue;
        eachNumber(m.at[b], [&](float& x) { x = *next++; });
        // A state of another time step may know it as standing where it begins to move here.
        if (step <= m.bodies[b].firstFreeStep(m.world.timeStep))
            m.at[b] = standingAtStart(m.bodies[b], step, m.world.timeStep);
    }
}

}  // namespace vkdose
