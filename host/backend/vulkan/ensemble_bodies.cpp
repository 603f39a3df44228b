// The bodies of an ensemble: their shapes, where they are in each step of a batch, and what bears on them.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

#include "host/backend/vulkan/ensemble.h"
#include "host/backend/vulkan/pack.h"
#include "host/backend/vulkan/pack_bodies.h"

namespace vkdose {

namespace {

/// The unit of the drive's angle [turns]. Its sums are exact, so that a body stands where it does whatever the batches.
constexpr double kDrive = 0x1p-44;

double driveAngle(std::int64_t drive) {
    return 2 * kPi * kDrive * double(drive);
}

/// The sphere around body `b` of a packed table: centre and radius [m].
gpu::vec4 aroundOf(const PackedBodies& packed, std::size_t b) {
    return std::bit_cast<gpu::vec4>(packed.table[gpu::kBodyVectors * b + 1]);
}

/// What all motions of bodies may take together [bytes].
constexpr std::size_t kMostMotionBytes = 16U << 20U;

/// A body and the clocks that it may follow, at the beginning of a step.
struct Instant {
    double time = 0, angle = 0, rate = 0;  ///< since load [s]; of the drive [rad], [rad/s]
    double own = 0;                        ///< if the body moves in phases [s]
    bool runs = false;                     ///< that clock

    Instant(const World& world, std::uint64_t step, double driveAngle, double driveRate, const BodyClock& clock,
            std::uint64_t more)
        : time(double(step) * world.timeStep),
          angle(driveAngle),
          rate(driveRate),
          own(double(clock.after(more)) * world.timeStep),
          runs(clock.runs) {}

    geometry::Pose pose(const RigidBody& body) const { return body.pose(time, angle, own); }
    double drive(const RigidBody& body) const { return body.driveOf(time, runs ? std::optional(own) : std::nullopt); }
    /// `back` [s] before.
    geometry::Moving moving(const RigidBody& body, double back) const {
        return body.moving(time - back, angle - rate * back, rate, runs ? std::optional(own - back) : std::nullopt);
    }
};

/// As ShapeForm::approach, of a body that turns about the z axis of its frame.
std::optional<double> approachByTurning(const RigidBody& body) {
    const auto* turn = std::get_if<geometry::Turn>(&body.course.motion);
    if (turn == nullptr) return std::nullopt;
    const geometry::Pose& start = body.course.start;
    const Vec3 axis = start.directionToBody(turn->axis), through = start.toBody(turn->through);
    constexpr double kSame = 1e-12;  // [m], and of a unit vector
    if (std::hypot(axis.x, axis.y) > kSame || std::hypot(through.x, through.y) > kSame) return std::nullopt;
    double most = 0;
    for (const geometry::Shape& shape : body.shapes) {
        const std::optional<double> approach = formOf(shape).approach;
        if (!approach) return std::nullopt;
        most = std::max(most, *approach);
    }
    return most * std::abs(turn->rate);
}

/// Bound of how much nearer any particle the body can come in the step that begins at that instant. Of a body that
/// moves freely its turn counts alone: the device watches its way. The lists take a wire for endless (law/coil.glsl,
/// nearCoil), so its ends do not count.
double longestWay(const World& world, const RigidBody& body, const gpu::vec4& around,
                  const std::optional<double>& approach, const Instant& now) {
    const geometry::Pose pose = now.pose(body);
    const Box& room = world.domain;
    Vec3 centre = Vec3(glm::vec3(around));
    double radius = double(around.w);
    const double reach = glm::length(room.high - room.low) / 2;
    if (radius > reach) {  // what is outside of the domain does not matter
        centre = pose.toBody((room.low + room.high) / 2.0);
        radius = reach;
    }
    const bool byDrive = body.clock == Clock::Drive;
    if (body.movesInPhases() && !now.runs) return 0;
    const double span = byDrive ? std::abs(now.rate) * world.timeStep : world.timeStep;
    const double from = byDrive ? now.angle - (now.rate > 0 ? 0 : span) : body.movesInPhases() ? now.own : now.time;
    if (approach) return *approach * span;
    return geometry::wayBound(body.course, centre, radius, from, span);
}

}  // namespace

std::int64_t Ensemble::drivePerStep(double rate, double dt) {
    return std::llround(rate * dt / (2 * kPi) / kDrive);
}

PackedBodies Ensemble::packedBodies(MemberState& m, TableSizes& sizes) {
    const double largest = largestRadius(m.loaded) + double(reachOf(m.block));
    // Spheres and bodies may go their slack, and the skin is more than that (pass/near.comp). A body that goes farther
    // than the skin in a step would need longer reach; the time steps here are far too short for that.
    PackedBodies packed = packBodies(m.bodies, largest, m.world.skin);
    m.moves = std::any_of(m.bodies.begin(), m.bodies.end(),
                          [](const RigidBody& b) { return !std::holds_alternative<geometry::Rest>(b.course.motion); });
    m.free = moveFreely(m.bodies);
    if (m.free) sizes.shapeKinds |= gpu::kFreeBodies;
    m.around.clear();
    m.approach.clear();
    for (std::size_t b = 0; b < m.bodies.size(); ++b) {
        m.around.push_back(aroundOf(packed, b));
        m.approach.push_back(approachByTurning(m.bodies[b]));
    }
    placeFree(m);
    sizes.shapeKinds |= packed.kinds;
    sizes.mostPlaces = std::max(sizes.mostPlaces, packed.places);
    return packed;
}

void Ensemble::packAllBodies(Plan& plan) {
    if (plan.sizes.bodies == 0) return;
    for (MemberState& m : plan.members) {
        const PackedBodies packed = packedBodies(m, plan.sizes);
        m.shapes = std::uint32_t(packed.table.size());
        m.block.bodies = gpu::uvec4(m.bodies.size(), plan.shapes.size(), 0, 0);
        plan.shapes.insert(plan.shapes.end(), packed.table.begin(), packed.table.end());
    }
}

/// Makes the tables of the bodies, with room for their motions in a batch.
void Ensemble::makeBodies(Plan& plan) {
    if (plan.sizes.bodies == 0) return;
    std::size_t motions = 0;  // of one step
    for (const MemberState& m : members_) motions += m.bodies.size();
    const VkPhysicalDeviceLimits& limits = device_.limits();
    const std::size_t room =
        std::min({kMostMotionBytes, std::size_t(limits.maxStorageBufferRange),
                  std::size_t(limits.maxTexelBufferElements) * sizeof(gpu::vec4)});  // so that there is a view
    const std::size_t stepsOfRoom = room / (sizeof(gpu::BodyMotion) * std::max<std::size_t>(motions, 1));
    // A slot beyond what the device can bind keeps no triangles: its particle looks at all of its cell.
    std::size_t slots = 0;
    if ((plan.sizes.shapeKinds & 1U << gpu::kShapeMesh) != 0) {
        const std::size_t all = std::size_t(plan.sizes.members) * plan.sizes.bodySlots;
        slots = std::min<std::size_t>(all, limits.maxStorageBufferRange / (gpu::kNearbyWords * sizeof(std::uint32_t)));
        if (slots == all) plan.sizes.shapeKinds |= gpu::kSortedSlots;
    }
    bodies_ = std::make_unique<BodyTables>(device_, plan.shapes,
                                           std::clamp<std::size_t>(stepsOfRoom, 2, 1025) * motions, slots);
    boundBatch();
}

bool Ensemble::boundBatch() {
    if (!bodies_) return true;
    std::size_t motions = 0;
    for (const MemberState& m : members_) motions += m.bodies.size();
    const std::size_t steps = bodies_->motions.size() / sizeof(gpu::BodyMotion) / std::max<std::size_t>(motions, 1);
    if (steps < 2) return false;
    mostBatch_ = std::uint32_t(std::min<std::size_t>(steps, 1025) - 1);  // and one more is kept
    return true;
}

/// Where the bodies of all live members are in each step of the next batch.
void Ensemble::writeMotions(std::uint32_t count, const std::vector<double>& coilRates) {
    if (!bodies_) return;
    std::vector<gpu::BodyMotion> motions;
    for (const std::uint32_t index : live_) {
        MemberState& m = members_[index];
        const std::vector<RigidBody>& bodies = m.bodies;
        const double rate = coilRates[index], dt = m.world.timeStep;
        const std::int64_t perStep = drivePerStep(rate, dt);
        m.block.bodies.z = std::uint32_t(motions.size());
        m.block.bodies.w = m.moves ? std::uint32_t(bodies.size()) : 0;
        for (std::uint32_t n = 0; n < (m.free ? count + 1 : m.moves ? count : 1); ++n) {
            const double angle = driveAngle(m.drive + perStep * n);
            const double back = m.step + n == 0 ? 0 : dt / 2;  // velocities are those half a step before
            const std::size_t first = motions.size();
            double way = 0;
            for (std::size_t b = 0; b < bodies.size(); ++b) {
                const RigidBody& body = bodies[b];
                const Instant now(m.world, m.step + n, angle, rate, clockOf(m.clocks, b), n);
                const geometry::Pose pose = now.pose(body);
                const geometry::Moving moving = now.moving(body, back);
                motions.push_back(body.movesFreely() ? motionOfFree(m, b, n, {pose, moving.spin, now.drive(body)})
                                                     : packMotion(body, pose, moving));
                way = std::max(way, longestWay(m.world, bodies[b], m.around[b], m.approach[b], now));
            }
            if (!bodies.empty()) motions[first].way.y = float(way);
        }
    }
    bodies_->motions.writeAll(motions);
}

std::vector<vk::Buffer::Part> Ensemble::loadRows(std::uint32_t member) const {
    const MemberState& m = members_[member];
    const TableSizes& sizes = passes_->sizes;
    std::vector<vk::Buffer::Part> rows;
    const auto add = [&](std::size_t first, std::size_t count) {
        for (std::size_t row = gpu::kBodyLoads * first; row < gpu::kBodyLoads * (first + count); ++row) {
            const std::uint64_t at = passes_->at.bodyLoadIndex(row, std::uint64_t(member) * sizes.share);
            rows.push_back({at * sizeof(float), m.loaded.size() * sizeof(float)});
        }
    };
    add(0, m.bodies.size());
    if (m.world.wallLoads) add(sizes.bodies, m.world.walls.size());
    return rows;
}

std::vector<std::vector<BodyLoad>> Ensemble::takeLoads(const std::vector<Look>& looks) {
    std::vector<vk::Buffer::Part> rows;
    std::size_t count = 0;
    for (const Look& look : looks)
        for (const vk::Buffer::Part& part : loadRows(look.member)) {
            rows.push_back(part);
            count += part.bytes / sizeof(float);
        }
    std::vector<float> values(count);
    passes_->bodyLoads.read(rows, values.data());
    passes_->bodyLoads.clear(rows);
    std::vector<std::vector<BodyLoad>> all;
    auto value = values.begin();
    for (const Look& look : looks) {
        const MemberState& m = members_[look.member];
        const double share = look.steps > 0 ? 1.0 / look.steps : 0.0;
        std::vector<BodyLoad>& loads = all.emplace_back();
        const auto take = [&](const Vec3& axis) {
            std::array<double, gpu::kBodyLoads> sums{};
            for (double& sum : sums)
                for (std::size_t i = 0; i < m.loaded.size(); ++i) sum += double(*value++);
            const Vec3 force = -share * Vec3(sums[0], sums[1], sums[2]),
                       moment = -share * Vec3(sums[3], sums[4], sums[5]);
            loads.push_back({force, glm::dot(axis, moment), sums[6]});
        };
        for (const RigidBody& body : m.bodies) take(body.axis());
        for (std::size_t w = 0; m.world.wallLoads && w < m.world.walls.size(); ++w) take(kWallAxis);
    }
    return all;
}

}  // namespace vkdose
