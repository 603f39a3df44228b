#include "host/backend/reference/forces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>
#include "host/law/law.h"

namespace vkdose::reference {

namespace {

/// A fixed wall, as a body.
const Body kFixed{Vec3(0), Vec3(0), Vec3(0), 0};

}  // namespace

void Forces::follow(const ContactLaw& law) {
    user_.reset();
    if (law.user) user_.emplace(*law.user);
}

/// How far beyond touch the contact may be: only one that has come about holds on.
double Forces::reachOf(const ContactParameters& p, double reduced, bool continues) {
    if (!continues) return 0;
    const double most = vkdose::reachOf(p, reduced);
    return user_ ? std::min(user_->reach(p.own, reduced / 2), most) : most;
}

void Forces::reset(std::size_t particles, const World& world) {
    bodies_ = allBodies(world);
    walls_ = world.walls.size();
    pairs_.assign(particles, {});
    surfaces_.assign(particles, {});
    onBodies_.assign(particles, {});
}

void Forces::evaluate(const RuledWorld& world, const Particles& particles, const Neighbours& neighbours,
                      const Drive& drive, double springDt, Loads& loads) {
    world_ = &world;
    particles_ = &particles;
    neighbours_ = &neighbours;
    drive_ = drive;
    springDt_ = springDt;
    loads_ = &loads;
    loads.force.assign(particles.size(), Vec3(0));
    loads.torque.assign(particles.size(), Vec3(0));
    loads.flows.assign(particles.properties.size(), {});
    loads.bodies.assign(bodies_.size() + (world.wallLoads ? walls_ : 0), {});
    loads.deepest = {};
    loads.energy = {};
    loads.branches.clear();
    placeBodies();
    for (std::size_t i = 0; i < particles.size(); ++i) {
        pairs(i);
        surfaces(i);
        bodies(i);
    }
}

Body Forces::body(std::size_t i) const {
    const double radius = particles_->radius[i];
    return {particles_->position[i], particles_->velocity[i], particles_->spin[i], radius,
            massOf(*world_, *particles_, i)};
}

/// Particle j, at its image that is nearest to particle i.
Body Forces::imageNear(std::size_t i, std::size_t j) const {
    Body image = body(j);
    const Vec3& x = particles_->position[i];
    if (world_->repeats()) image.position = x + world_->shortest(image.position - x);
    return image;
}

void Forces::note(const Touch& touch, ContactClass kind, std::size_t particle, std::size_t other) {
    const double ratio = touch.overlap / touch.smaller;
    if (ratio > loads_->deepest.ratio)
        loads_->deepest = {ratio, kind, static_cast<std::uint32_t>(particle), static_cast<std::uint32_t>(other)};
}

Exerted Forces::exertedBy(MaterialPair pair, const Touch& touch, const Response& response,
                          const History& history) const {
    Exerted exerted;
    exerted.force = response.force;
    if (!world_->energyBook) return exerted;
    const Elastic elastic = elasticEnergy(world_->law.of(pair), response.parts, touch.overlap, touch.reduced, history);
    return {true, touch.normal, touch.overlap, touch.leverI, touch.leverJ, response.parts, elastic, response.force};
}

/// Books a contact that goes on, begins or ends, or that was loaded touching.
void Forces::book(const Exerted& before, const Exerted& now, const Body& i, const Body& j) {
    if (!world_->energyBook) return;
    if (springDt_ > 0)
        bookContact(before, now, i, j, springDt_, loads_->energy);
    else
        bookLoaded(now, loads_->energy);
    addElastic(now.elastic, loads_->energy);
}

/// Ends a pair of the last step that no longer touches, or of which one or both particles have left the motion.
void Forces::partPair(std::size_t i, const Known& known) {
    if (!world_->energyBook) return;
    const auto present = [&](std::size_t k) {
        return particles_->status[k] == Status::Active ? body(k) : Body{particles_->position[k], Vec3(0), Vec3(0), 0};
    };
    const bool both = particles_->status[i] == Status::Active && particles_->status[known.other] == Status::Active;
    if (both)
        book(known.exerted, Exerted{}, body(i), imageNear(i, known.other));
    else
        bookDeparture(known.exerted, present(i), present(known.other), springDt_, loads_->energy);
}

void Forces::partWall(std::size_t i, const Exerted& before) {
    if (!world_->energyBook) return;
    if (particles_->status[i] == Status::Active)
        book(before, Exerted{}, body(i), kFixed);
    else
        loads_->energy.left += before.elastic.sum();
}

/// Contacts of particle i with particles of larger index, so that each pair counts once.
void Forces::pairs(std::size_t i) {
    before_.swap(pairs_[i]);
    pairs_[i].clear();
    auto known = before_.cbegin();
    const auto partThoseBefore = [&](std::uint32_t j) {
        for (; known != before_.cend() && known->other < j; ++known) partPair(i, *known);
    };
    for (const std::uint32_t j : neighbours_->after(i)) {
        if (particles_->status[i] != Status::Active) break;
        if (particles_->status[j] != Status::Active) continue;
        partThoseBefore(j);
        const bool continues = known != before_.cend() && known->other == j;
        const double reduced = reducedSize(particles_->radius[i], particles_->radius[j]);
        const MaterialPair pair{materialOf(i), materialOf(j)};
        const Body other = imageNear(i, j);
        std::optional<Touch> touch = touchSphere(body(i), other, reachOf(world_->law.of(pair), reduced, continues));
        if (!touch) continue;
        if (!particles_->properties.empty()) touch->sides = {particles_->properties[i], particles_->properties[j]};
        const Known before = continues ? *known++ : Known{j, {}, {}};
        History history = before.history;

        const Response response = contactResponse(world_->law, pair, *touch, springDt_, history, user());
        loads_->force[i] += response.force;
        loads_->force[j] -= response.force;
        loads_->torque[i] += response.torqueI;
        loads_->torque[j] += response.torqueJ;
        flow(i, response.flows, 1);
        flow(j, response.flows, -1);
        loads_->branches.push_back({static_cast<std::uint32_t>(i), j, true, particles_->position[i],
                                    particles_->position[i] - other.position, response.force});
        const Exerted now = exertedBy(pair, *touch, response, history);
        book(before.exerted, now, body(i), other);
        pairs_[i].push_back({j, history, now});
        note(*touch, ContactClass::ParticleParticle, i, j);
    }
    partThoseBefore(std::numeric_limits<std::uint32_t>::max());
}

/// Adds what flows to a particle by a contact.
void Forces::flow(std::size_t i, const LawProperties& rate, double sign) {
    if (loads_->flows.empty()) return;
    for (std::size_t k = 0; k < rate.size(); ++k) loads_->flows[i][k] += sign * rate[k];
}

/// The caller books the force, because it knows that of the last step.
Forces::Pushed Forces::wall(std::size_t i, int material, std::uint32_t other, Touch touch, History& history) {
    const MaterialPair pair{materialOf(i), material};
    if (!particles_->properties.empty())
        touch.sides = {particles_->properties[i], world_->materials[std::size_t(material)].properties};
    const Response response = contactResponse(world_->law, pair, touch, springDt_, history, user());
    loads_->force[i] += response.force;
    loads_->torque[i] += response.torqueI;
    flow(i, response.flows, 1);
    const Vec3 toWall = (particles_->radius[i] - touch.overlap) * touch.normal;
    loads_->branches.push_back(
        {static_cast<std::uint32_t>(i), other, false, particles_->position[i], toWall, response.force});
    note(touch, classAtWall(material), i, other);
    const Vec3 point = particles_->position[i] + touch.leverI;
    Pushed pushed{exertedBy(pair, touch, response, history), point, response.couple};
    pushed.exerted.leverJ = point;
    return pushed;
}

/// Finds for every fixed surface, in order, the position of particle i relative to it and its history from the last
/// step.
void Forces::meetSurfaces(std::size_t i) {
    met_.clear();
    auto known = before_.cbegin();
    for (std::uint32_t s = 0; s < world_->walls.size(); ++s) {
        const bool continues = known != before_.cend() && known->other == s;
        Met met{continues, continues ? *known++ : Known{s, {}, {}}};
        if (particles_->status[i] == Status::Active) {
            const Wall& wall = world_->walls[s];
            met.closest = geometry::closestPoint(wall.shape, particles_->position[i]);
            const double radius = particles_->radius[i];
            met.reach = reachOf(world_->law.between(materialOf(i), wall.material), 2 * radius, continues);
            met.touches = radius - met.closest.distance > -met.reach;
        }
        met_.push_back(met);
    }
}

/// Where a wall continues into the throat, wall and front wall may both overlap the sphere although they form one
/// contact. Only the deeper one counts. It takes over the history of the other one unless it has its own.
void Forces::joinAtFront(std::size_t i) {
    const auto isFront = [&](const Met& m) {
        return std::holds_alternative<geometry::Front>(world_->walls[m.known.other].shape);
    };
    const auto front = std::find_if(met_.begin(), met_.end(), isFront);
    if (front == met_.end()) return;
    for (Met& wall : met_) {
        if (!wall.touches || !front->touches || !geometry::endsAtFront(world_->walls[wall.known.other].shape)) continue;
        const geometry::Joint joint = geometry::jointContact(wall.closest, front->closest, particles_->radius[i]);
        if (joint == geometry::Joint::Apart) continue;
        Met& counts = joint == geometry::Joint::Wall ? wall : *front;
        Met& other = joint == geometry::Joint::Wall ? *front : wall;
        other.touches = false;
        if (!other.continues || counts.continues) continue;
        counts.continues = true;
        counts.known.history = other.known.history;
        counts.known.exerted = other.known.exerted;
        other.continues = false;
    }
}

void Forces::surfaces(std::size_t i) {
    before_.swap(surfaces_[i]);
    surfaces_[i].clear();
    meetSurfaces(i);
    joinAtFront(i);
    for (const Met& met : met_) {
        std::optional<Touch> touch;
        if (met.touches)
            touch = touchWall(body(i), met.closest.normal, met.closest.distance, geometry::Moving{}, met.reach);
        if (!touch) {
            if (met.continues) partWall(i, met.known.exerted);
            continue;
        }
        History history = met.known.history;
        const std::uint32_t which = met.known.other;
        const Pushed pushed = wall(i, world_->walls[which].material, which, *touch, history);
        if (world_->wallLoads) loadWall(which, pushed);
        book(met.known.exerted, pushed.exerted, body(i), kFixed);
        surfaces_[i].push_back({which, history, pushed.exerted});
    }
}

/// As a body bears what is exerted on it.
void Forces::loadWall(std::uint32_t which, const Pushed& pushed) {
    BodyLoad& load = loads_->bodies[bodies_.size() + which];
    const Vec3& force = pushed.exerted.force;
    load.force -= force;
    load.torque -= glm::dot(kWallAxis, glm::cross(pushed.point, force) + pushed.couple);
}

std::vector<Contact> Forces::contacts() const {
    std::vector<Contact> list;
    const auto add = [&](ContactClass kind, std::size_t i, std::size_t other, const History& h, const Exerted& e) {
        list.push_back({kind, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(other), h.maxOverlap, h.sliding,
                        h.rolling, h.torsion, e.force});
    };
    for (std::size_t i = 0; i < pairs_.size(); ++i)
        for (const Known& known : pairs_[i])
            add(ContactClass::ParticleParticle, i, known.other, known.history, known.exerted);
    for (std::size_t i = 0; i < surfaces_.size(); ++i)
        for (const Known& known : surfaces_[i])
            add(ContactClass::ParticleWall, i, known.other, known.history, known.exerted);
    for (std::size_t i = 0; i < onBodies_.size(); ++i)
        for (const OnBody& c : onBodies_[i])
            add(classAtWall(bodies_[c.body].material), i, walls_ + c.body, c.history, c.exerted);
    return list;
}

}  // namespace vkdose::reference
