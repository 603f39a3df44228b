#include "host/backend/reference/forces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/error.h"

namespace vkdose::reference {

void Forces::reset(std::size_t particles) {
    pairs_.assign(particles, {});
    surfaces_.assign(particles, {});
    turns_.assign(particles, {});
}

void Forces::evaluate(const World& world, const Particles& particles, const Neighbours& neighbours,
                      const CoilMotion& coilMotion, double springDt, Loads& loads) {
    world_ = &world;
    particles_ = &particles;
    neighbours_ = &neighbours;
    motion_ = coilMotion;
    springDt_ = springDt;
    loads_ = &loads;
    loads.force.assign(particles.size(), Vec3(0));
    loads.torque.assign(particles.size(), Vec3(0));
    loads.coilTorque = 0;
    loads.deepest = {};
    for (std::size_t i = 0; i < particles.size(); ++i) {
        pairs(i);
        surfaces(i);
        coil(i);
    }
}

Body Forces::body(std::size_t i) const {
    return {particles_->position[i], particles_->velocity[i], particles_->spin[i], particles_->radius[i]};
}

void Forces::note(const Touch& touch, ContactClass kind, std::size_t particle, std::size_t other) {
    const double ratio = touch.overlap / touch.smaller;
    if (ratio > loads_->deepest.ratio)
        loads_->deepest = {ratio, kind, static_cast<std::uint32_t>(particle), static_cast<std::uint32_t>(other)};
}

/// Contacts of particle i with those of larger index: each pair once.
void Forces::pairs(std::size_t i) {
    before_.swap(pairs_[i]);
    pairs_[i].clear();
    if (particles_->status[i] != Status::Active) return;
    auto known = before_.cbegin();
    for (const std::uint32_t j : neighbours_->after(i)) {
        if (particles_->status[j] != Status::Active) continue;
        const std::optional<Touch> touch = touchSphere(body(i), body(j));
        if (!touch) continue;
        while (known != before_.cend() && known->other < j) ++known;
        const bool continues = known != before_.cend() && known->other == j;
        History history = continues ? known->history : History{};

        const Response response =
            contactResponse(world_->law, ContactClass::ParticleParticle, *touch, springDt_, history);
        loads_->force[i] += response.force;
        loads_->force[j] -= response.force;
        loads_->torque[i] += response.torqueI;
        loads_->torque[j] += response.torqueJ;
        pairs_[i].push_back({j, history});
        note(*touch, ContactClass::ParticleParticle, i, j);
    }
}

void Forces::wall(std::size_t i, ContactClass kind, std::uint32_t other, const Touch& touch, History& history) {
    const Response response = contactResponse(world_->law, kind, touch, springDt_, history);
    loads_->force[i] += response.force;
    loads_->torque[i] += response.torqueI;
    note(touch, kind, i, other);
    if (kind != ContactClass::ParticleCoil) return;
    // The coil bears the opposite force at the contact point, and the opposite couple.
    const Vec3 point = particles_->position[i] + touch.leverI;
    loads_->coilTorque -= (glm::cross(point, response.force) + response.couple).z;
}

void Forces::surfaces(std::size_t i) {
    before_.swap(surfaces_[i]);
    surfaces_[i].clear();
    if (particles_->status[i] != Status::Active) return;
    for (std::uint32_t s = 0; s < world_->surfaces.size(); ++s) {
        const geometry::Closest closest = geometry::closestPoint(world_->surfaces[s], particles_->position[i]);
        const std::optional<Touch> touch = touchWall(body(i), closest.normal, closest.distance, 0);
        if (!touch) continue;
        const auto known = std::find_if(before_.cbegin(), before_.cend(), [&](const Known& k) { return k.other == s; });
        History history = known != before_.cend() ? known->history : History{};
        wall(i, ContactClass::ParticleWall, s, *touch, history);
        surfaces_[i].push_back({s, history});
    }
}

/// The slot of the turn that touched at `wireAngle` in the last step and has not been found yet in this one; the number
/// of slots if there is none. The same turn moves far less than half a turn in a step.
std::size_t Forces::slotOf(const Turns& before, const Turns& now, double wireAngle) {
    std::size_t slot = 0;
    while (slot < before.size() &&
           !(before[slot].touching && !now[slot].touching && std::abs(before[slot].wireAngle - wireAngle) < kPi))
        ++slot;
    return slot;
}

/// Each turn touched has its own history, in a slot that is its own for as long as it is touched.
void Forces::coil(std::size_t i) {
    const Turns before = turns_[i];
    Turns& now = turns_[i];
    for (Turn& turn : now) turn.touching = false;
    if (particles_->status[i] != Status::Active || !world_->coil) return;

    const std::vector<geometry::CoilTouch> found =
        geometry::touches(*world_->coil, motion_.angle, particles_->position[i], particles_->radius[i]);
    std::array<bool, kMaxCoilTouches> taken{};  // slots spoken for, by a turn of the last step or a new one
    std::transform(before.begin(), before.end(), taken.begin(), [](const Turn& turn) { return turn.touching; });

    for (const geometry::CoilTouch& at : found) {
        const std::optional<Touch> touch = touchWall(body(i), at.normal, at.distance, motion_.rate);
        if (!touch) continue;
        std::size_t slot = slotOf(before, now, at.wireAngle);
        const bool continues = slot < before.size();
        if (!continues) {
            const auto free = std::find(taken.begin(), taken.end(), false);
            if (free == taken.end())
                throw RunError(fmt::format(
                    "particle {} touches more than {} turns of the coil: use smaller particles or a wider pitch", i,
                    kMaxCoilTouches));
            slot = static_cast<std::size_t>(free - taken.begin());
            taken[slot] = true;
        }
        now[slot] = {true, at.wireAngle, continues ? before[slot].history : History{}};
        wall(i, ContactClass::ParticleCoil, static_cast<std::uint32_t>(slot), *touch, now[slot].history);
    }
}

std::vector<Contact> Forces::contacts() const {
    std::vector<Contact> list;
    const auto add = [&](ContactClass kind, std::size_t i, std::size_t other, const History& h) {
        list.push_back({kind, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(other), h.maxOverlap, h.sliding,
                        h.rolling, h.torsion});
    };
    for (std::size_t i = 0; i < pairs_.size(); ++i)
        for (const Known& known : pairs_[i]) add(ContactClass::ParticleParticle, i, known.other, known.history);
    for (std::size_t i = 0; i < surfaces_.size(); ++i)
        for (const Known& known : surfaces_[i]) add(ContactClass::ParticleWall, i, known.other, known.history);
    for (std::size_t i = 0; i < turns_.size(); ++i)
        for (std::size_t slot = 0; slot < turns_[i].size(); ++slot)
            if (turns_[i][slot].touching) add(ContactClass::ParticleCoil, i, slot, turns_[i][slot].history);
    return list;
}

void Forces::save(Record& record) const {
    const std::vector<Contact> list = contacts();
    std::vector<std::uint32_t> ends;
    std::vector<double> history, wireAngle;
    for (const Contact& c : list) {
        ends.insert(ends.end(), {static_cast<std::uint32_t>(c.kind), c.particle, c.other});
        history.insert(history.end(), {c.maxOverlap, c.sliding.x, c.sliding.y, c.sliding.z, c.rolling.x, c.rolling.y,
                                       c.rolling.z, c.torsion});
        wireAngle.push_back(c.kind == ContactClass::ParticleCoil ? turns_[c.particle][c.other].wireAngle : 0);
    }
    record.put("contact_ends", std::move(ends));
    record.put("contact_history", std::move(history));
    record.put("contact_wire_angle", std::move(wireAngle));
}

void Forces::restore(const Record& record) {
    const auto& wireAngle = record.get<double>("contact_wire_angle");
    const auto& ends = record.get<std::uint32_t>("contact_ends", 3 * wireAngle.size());
    const auto& h = record.get<double>("contact_history", 8 * wireAngle.size());
    for (std::size_t c = 0; c < wireAngle.size(); ++c) {
        const std::uint32_t kind = ends[3 * c], particle = ends[3 * c + 1], other = ends[3 * c + 2];
        const double* v = &h[8 * c];
        const History history{v[0], Vec3(v[1], v[2], v[3]), Vec3(v[4], v[5], v[6]), v[7]};
        const bool coil = kind == static_cast<std::uint32_t>(ContactClass::ParticleCoil);
        if (particle >= pairs_.size() || kind >= kContactClasses || (coil && other >= kMaxCoilTouches))
            throw RecordError(fmt::format("contact {} is of a particle or turn that there is not", c));
        // Saved in this order, so that every row is ascending again.
        if (coil)
            turns_[particle][other] = {true, wireAngle[c], history};
        else
            (kind == 0 ? pairs_ : surfaces_)[particle].push_back({other, history});
    }
}

}  // namespace vkdose::reference
