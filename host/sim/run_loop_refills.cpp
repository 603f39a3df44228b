// The powder that is added while a run goes on.
#include <algorithm>

#include "host/model/refill.h"
#include "host/sim/added_series.h"
#include "host/sim/run_loop.h"

namespace vkdose {

bool RunLoop::isAdded(std::size_t refill) const {
    return std::any_of(result_.added.begin(), result_.added.end(),
                       [&](const AddedPowder& p) { return p.refill == refill; });
}

double RunLoop::watched(const Refill& refill) const {
    const Sample& last = result_.last;
    if (refill.watched) return *refill.watched < last.regions.size() ? last.regions[*refill.watched].content.mass : 0;
    return mass(last.sensors, Region::Canister) + mass(last.sensors, Region::Throat);
}

bool RunLoop::due(std::size_t refill) {
    const Refill& r = case_.refills[refill];
    if (r.time) return timeline_.time(step_) > *r.time - case_.world.timeStep / 2;
    if (r.below) {
        const double now = watched(r);
        const bool next = !r.again || isAdded(refill - 1);
        if (next && now >= *r.below) wasAbove_[refill] = 1;
        return wasAbove_[refill] != 0 && now < *r.below;
    }
    if (!r.beforeDose) return false;
    const Timeline::Stretch next = timeline_.at(step_);
    return next.phase != Phase::Settle && next.dose >= *r.beforeDose;
}

std::uint64_t RunLoop::planned() const {
    std::uint64_t sum = 0;
    for (std::size_t k = 0; k < case_.refills.size(); ++k)
        if (case_.refills[k].planned() && !isAdded(k)) sum += result_.filled.waiting[k].particles.size();
    return sum;
}

void RunLoop::addPowder() {
    if (gathered_ > 0) return;
    for (std::size_t k = 0; k < case_.refills.size(); ++k) {
        if (isAdded(k) || (!due(k) && !observer_.wantsRefill(k))) continue;
        const Insertion::Waiting& powder = result_.filled.waiting[k];
        const Clearance around(case_.world, timeline_.time(step_), backend_.coilAngle(), clocks_.now(),
                               moveFreely(case_.world.bodies) ? backend_.freeBodies() : std::vector<FreeBody>());
        const std::vector<Vec3> places = placeRefill(case_, result_.filled, k, backend_.particles(), around);
        backend_.addParticles(result_.filled.firstOf(k), places);
        if (energy_) energy_->sum.loaded += energyOfRest(powder.particles, places);
        active_ += places.size();
        bookAdded(k, step_);
        observer_.onRefill(result_.added.back());
    }
}

void RunLoop::bookAdded(std::size_t refill, std::uint64_t step) {
    const Insertion::Waiting& powder = result_.filled.waiting[refill];
    const std::size_t count = powder.particles.size();
    const std::size_t table = case_.refills[refill].table;
    result_.added.push_back({refill, case_.refills[refill].name, table, refillsOfTable(case_.refills, table), step,
                             timeline_.time(step), count, powder.mass});
    result_.ledger.add(count, powder.mass);
}

/// Kinetic energy is that of the book: its velocities are those half a step before and after (EnergyBook).
double RunLoop::energyOfRest(const Particles& powder, const std::vector<Vec3>& positions) const {
    const World& world = case_.world;
    const Vec3 before = velocityOfRest(world.timeStep, gravity_, step_), after = before + world.timeStep * gravity_;
    double sum = 0;
    for (std::size_t i = 0; i < positions.size(); ++i)
        sum += massOf(world, powder, i) * (0.5 * glm::dot(before, after) - glm::dot(gravity_, positions[i]));
    return sum;
}

void RunLoop::saveAdded(Record& r) const {
    if (case_.refills.empty()) return;
    std::vector<std::uint64_t> added;
    for (const AddedPowder& p : result_.added) added.insert(added.end(), {p.refill, p.step});
    r.put("refills", std::move(added));
    r.put("refills_were_above", wasAbove_);
}

void RunLoop::restoreAdded(const Record& r, double scale) {
    if (case_.refills.empty() || !r.arrays().contains("refills")) return;
    wasAbove_ = r.get<std::uint64_t>("refills_were_above", case_.refills.size());
    const auto& added = r.get<std::uint64_t>("refills");
    for (std::size_t i = 0; i + 1 < added.size(); i += 2) {
        const std::uint64_t k = added[i];
        if (k >= case_.refills.size() || isAdded(k)) throw RecordError("refills names what there is not");
        bookAdded(k, static_cast<std::uint64_t>(std::llround(static_cast<double>(added[i + 1]) * scale)));
    }
}

}  // namespace vkdose
