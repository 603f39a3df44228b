// Contacts with the bodies of a world and its coil (host/model/world.h, allBodies).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/matching.h"
#include "host/backend/reference/forces.h"
#include "host/core/error.h"
#include "host/law/law.h"

namespace vkdose::reference {

/// The leapfrog knows velocities half a step before the forces act, so it asks for those of the bodies there too.
void Forces::placeBodies() {
    placed_.clear();
    const double back = springDt_ / 2;
    const auto step = static_cast<std::uint64_t>(std::llround(drive_.time / world_->timeStep));
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        const RigidBody& body = bodies_[b];
        const BodyClock clock = clockOf(drive_.clocks, b);
        const Moved own = static_cast<double>(clock.steps) * world_->timeStep;
        const geometry::Moving moving = body.moving(drive_.time - back, drive_.angle - drive_.rate * back, drive_.rate,
                                                    clock.runs ? std::optional(own.time - back) : std::nullopt);
        if (body.movesFreely()) {
            const FreeBody& free = drive_.free[b];
            const geometry::Pose pose = body.pose(drive_.time, 0, Moved(own.time, free));
            const bool yields = body.kickOf(step, world_->timeStep) > 0;  // else it is as a wall, still
            if (const geometry::Hinge* hinge = body.hinge())
                placed_.push_back({pose, {Vec3(0), free.rate * hinge->axis, hinge->through}, yields});
            else
                placed_.push_back({pose, {free.velocity, moving.spin, pose.origin}, yields});
            continue;
        }
        placed_.push_back({body.pose(drive_.time, drive_.angle, own), moving});
    }
}

void Forces::bodies(std::size_t i) {
    beforeOnBodies_.swap(onBodies_[i]);
    onBodies_[i].clear();
    auto from = beforeOnBodies_.cbegin();
    for (std::uint32_t b = 0; b < bodies_.size(); ++b) {
        const auto to =
            std::find_if(from, beforeOnBodies_.cend(), [&](const OnBody& known) { return known.body != b; });
        touchBody(i, b, {from, to});
        from = to;
    }
}

/// Each place where particle i touches body b makes a contact. It goes on with the contact of the last step that lay
/// nearest to it on the body; the springs turn with it.
void Forces::touchBody(std::size_t i, std::uint32_t b, std::span<const OnBody> before) {
    const RigidBody& body = bodies_[b];
    const Placed& placed = placed_[b];
    const double radius = particles_->radius[i];
    const double reduced = body.curvature > 0 ? reducedSize(radius, body.curvature) : 2 * radius;
    const double reach = reachOf(world_->law.between(materialOf(i), body.material), reduced, !before.empty());
    std::vector<geometry::Feature> found;
    if (particles_->status[i] == Status::Active) try {
            found = geometry::touched(body.shapes, placed.pose.toBody(particles_->position[i]), radius, reach);
        } catch (const geometry::TooManyFeatures& e) {
            throw RunError(fmt::format("particle {} at body \"{}\": {}", i, body.name, e.what()));
        }

    std::vector<Vec3> directions, old;
    for (const geometry::Feature& f : found) directions.push_back(f.normal);
    for (const OnBody& known : before) old.push_back(known.direction);
    const std::vector<std::size_t> continues = geometry::continued(old, directions);

    const auto other = static_cast<std::uint32_t>(walls_ + b);
    const geometry::Moving seen = body.surfaceMoves ? placed.moving : geometry::Moving{};
    std::vector<bool> goesOn(before.size(), false);
    for (std::size_t k = 0; k < found.size(); ++k) {
        const Vec3 normal = placed.pose.directionToWorld(directions[k]);
        const bool goes = continues[k] != geometry::kNew;
        std::optional<Touch> touch =
            touchWall(this->body(i), normal, found[k].distance, seen, goes ? reach : 0, springDt_ / 2);
        if (!touch) continue;
        touch->reduced = reduced;
        touch->share = found[k].share;
        if (placed.yields) {
            const Vec3 point = particles_->position[i] + touch->leverI;
            touch->mass /= 1 + touch->mass * body.perMass(point, normal);
        }
        OnBody now{b, directions[k], {}, {}};
        Exerted last;
        if (goes) {
            goesOn[continues[k]] = true;
            const OnBody& known = before[continues[k]];
            const Vec3 from = placed.pose.directionToWorld(known.direction);
            now.history = known.history;
            now.history.sliding = geometry::turnedAlong(known.history.sliding, from, normal);
            now.history.rolling = geometry::turnedAlong(known.history.rolling, from, normal);
            last = known.exerted;
        }
        Pushed pushed = wall(i, body.material, other, *touch, now.history);
        pushed.exerted.leverJ = pushed.point - placed.moving.centre;
        now.exerted = pushed.exerted;
        loadBody(b, pushed);
        bookBody(i, b, last, now.exerted);
        onBodies_[i].push_back(now);
    }
    for (std::size_t k = 0; k < before.size(); ++k)
        if (!goesOn[k]) bookBody(i, b, before[k].exerted, Exerted{});
}

/// The body bears the opposite force at the contact point, and the opposite couple.
void Forces::loadBody(std::uint32_t b, const Pushed& pushed) {
    const RigidBody& body = bodies_[b];
    const Placed& placed = placed_[b];
    BodyLoad& load = loads_->bodies[b];
    const Vec3& force = pushed.exerted.force;
    load.force -= force;
    load.torque -= glm::dot(body.axis(), glm::cross(pushed.point - body.pivot(placed.pose), force) + pushed.couple);
    load.work +=
        springDt_ * (glm::dot(force, placed.moving.at(pushed.point)) + glm::dot(pushed.couple, placed.moving.spin));
}

/// Books a contact with body b that goes on, begins or ends.
void Forces::bookBody(std::size_t i, std::uint32_t b, const Exerted& before, const Exerted& now) {
    if (!world_->energyBook) return;
    if (particles_->status[i] != Status::Active) {
        loads_->energy.left += before.elastic.sum();
        return;
    }
    const geometry::Moving& moving = placed_[b].moving;
    const Body wall{Vec3(0), moving.velocity, moving.spin, 0};
    book(before, now, body(i), wall);
    const bool coil = b == world_->bodies.size();  // the last of allBodies
    (coil ? loads_->energy.coilWork : loads_->energy.bodyWork) +=
        halfStepGiven(before, wall, springDt_) + halfStepGiven(now, wall, springDt_);
}

}  // namespace vkdose::reference
