// Closed forms of the paper and the figures that say whether a case is stable and how long it runs.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "host/model/case.h"
#include "host/model/conveyors.h"
#include "host/model/size_distribution.h"
#include "host/model/stability.h"

namespace vkdose {
namespace {

/// Time that the coil is expected to turn in a dose, ramps included [s].
double turningTime(const Schedule& s, const Derived& d) {
    const double rate = d.rate(s.coilSpeed);
    return s.targetMass > 0 && rate > 0 ? std::min(s.rotateTime, s.targetMass / rate + s.rampTime) : s.rotateTime;
}

/// The closed form of a device without a coil.
void deriveBodies(const Case& c, Derived& d) {
    const std::optional<Conveyance> sum = conveyanceOf(c);
    if (!sum) return;
    const double mass = c.bulkDensity * sum->volume();
    (sum->byDrive ? d.massPerTurn : d.massPerSecond) = mass;
    d.turnsInRests = sum->inRests;
    d.conveyors = sum->names();
    const Conveyor& first = sum->conveyors.front();
    const double turns = first.turns * (sum->byDrive ? c.schedule.coilSpeed / (2 * kPi) : 1);  // [1/s]
    d.pushVelocity = first.lead * turns;
    d.tipVelocity = 2 * kPi * first.radius * turns;
}

double predictedSteps(const Case& c, const Derived& d) {
    const Schedule& s = c.schedule;
    double time = s.settleTime;
    if (s.rotateTime > 0) {
        // Without a closed form nobody knows how many doses empty the device; what else ends the run decides.
        const bool ends = s.stop.maxDoses != std::numeric_limits<int>::max() || std::isfinite(s.stop.endTime);
        double count = d.massPerDose > 0 ? std::ceil(d.doses) : ends ? std::numeric_limits<double>::infinity() : 0;
        if (s.stop.kind != StopRule::Kind::None) count += s.stop.doses;
        count = std::min(count, static_cast<double>(s.stop.maxDoses));
        time += count * (turningTime(s, d) + s.reverseTime() + s.restTime);
    }
    return std::ceil(std::min(time, s.stop.endTime) / c.world.timeStep);
}

/// When a refill is expected [s]; infinite if nobody knows.
double expectedTime(const Refill& refill, const Schedule& s, const Derived& d) {
    if (refill.time) return *refill.time;
    if (!refill.beforeDose) return std::numeric_limits<double>::infinity();
    return s.settleTime + (*refill.beforeDose - 1) * (turningTime(s, d) + s.reverseTime() + s.restTime);
}

/// Whether particles can leave the device.
bool hasOutlet(const World& world) {
    return std::isfinite(world.outletZ) ||
           std::any_of(world.regions.begin(), world.regions.end(), [](const CountRegion& r) { return r.deletes; });
}

/// Of a run without doses: the time until `time` for which the body that carries powder out has moved [s].
double carriedFor(const Case& c, const Derived& d, double time) {
    for (const RigidBody& body : c.world.bodies) {
        if (d.conveyors.empty() || body.name != d.conveyors.front()) continue;
        // One that moves in phases does so while the powder settles, or it had no closed form (conveyors.h).
        return body.movesInPhases() ? time : body.course.schedule.elapsed(time);
    }
    return 0;
}

/// What has left the device by `time` if its powder lasts, by the closed form [kg].
double leftBy(const Case& c, const Derived& d, double time) {
    const Schedule& s = c.schedule;
    if (s.rotateTime == 0) return d.massPerSecond * carriedFor(c, d, time);
    return d.massPerDose * std::max(0.0, time - s.settleTime) / (turningTime(s, d) + s.reverseTime() + s.restTime);
}

/// Whether the closed form tells how much powder is inside. Refills at a mark make up for what leaves, and nobody knows
/// when they come.
bool knowsLeaving(const Case& c, const Derived& d) {
    return (c.schedule.rotateTime > 0 ? d.massPerDose : d.massPerSecond) > 0 &&
           std::none_of(c.refills.begin(), c.refills.end(), [](const Refill& r) { return r.below.has_value(); });
}

/// The particle-steps that particles do not make because they have left.
double sparedWork(const Case& c, const Insertion& filled, const Derived& d) {
    if (!knowsLeaving(c, d) || !(d.fillMass > 0)) return 0;
    constexpr int kSlices = 1000;
    const double slice = d.steps * d.timeStep / kSlices, each = d.fillMass / static_cast<double>(d.particles);
    double inside = d.fillMass, left = 0, spared = 0;  // [kg], [kg s]
    for (int k = 0; k < kSlices; ++k) {
        const double from = k * slice;
        for (std::size_t r = 0; r < std::min(c.refills.size(), filled.waiting.size()); ++r) {
            const double comes = expectedTime(c.refills[r], c.schedule, d);
            if (comes >= from && comes < from + slice) inside += filled.waiting[r].mass;
        }
        const double goes = std::min(inside, leftBy(c, d, from + slice) - leftBy(c, d, from));
        inside -= goes;
        spared += (left + goes / 2) * slice;
        left += goes;
    }
    return spared / each / d.timeStep;
}

double predictedWork(const Case& c, const Insertion& filled, const Derived& d) {
    double work = d.steps * static_cast<double>(d.particles);
    for (std::size_t k = 0; k < std::min(c.refills.size(), filled.waiting.size()); ++k) {
        const double before = expectedTime(c.refills[k], c.schedule, d) / d.timeStep;
        work += std::max(0.0, d.steps - before) * static_cast<double>(filled.waiting[k].particles.size());
    }
    return work - sparedWork(c, filled, d);
}

}  // namespace

double Schedule::fastestSpeed() const {
    double fastest = coilSpeed;
    for (const DoseStage& stage : stages) fastest = std::max(fastest, stage.speed);
    return fastest;
}

double Schedule::reverseTime() const {
    return reverseTurns > 0 ? reverseTurns * 2 * kPi / coilSpeed + rampTime : 0;
}

bool Schedule::isPlain() const {
    return targetMass == 0 && rampTime == 0 && !std::isfinite(maxTorque);
}

double contactDuration(const ContactParameters& p, double mass, double k) {
    const double decay = p.gamma / (2 * mass);
    const double square = k / mass - decay * decay;
    return square > 0 ? kPi / std::sqrt(square) : std::numeric_limits<double>::infinity();
}

Derived derive(const Case& c, const Insertion& filled) {
    Derived d;
    const PowderSizes sizes = powderSizes(c);
    d.stiffest = std::numeric_limits<double>::infinity();
    for (const MaterialPair& pair : occurringPairs(c.world)) {
        if (!haveSpheres(c.world, pair, sizes)) continue;
        /// Of spheres of these sizes, without damping if that is not wanted, on the stiffness that `k` names.
        const auto duration = [&](double SizeRange::*size, bool damped, double ContactParameters::*k) {
            const double a = sizes[std::size_t(pair.a)].*size, b = otherSide(c.world, pair, sizes, size);
            const double mass = reducedMass(c.world, pair, a, b);
            ContactParameters p = stiffest(c.dosingLaw.of(pair), mass, a, b, c.world.maxOverlapRatio);
            if (!damped) p.gamma = 0;
            return contactDuration(p, mass, p.*k);
        };
        const double shortest = duration(&SizeRange::smallest, false, &ContactParameters::k2Max);
        d.durations.push_back(
            {nameOf(c.world, pair), duration(&SizeRange::mean, true, &ContactParameters::k1), shortest});
        d.stiffest = std::min(d.stiffest, shortest);
    }
    d.timeStep = c.world.timeStep;
    d.particles = filled.particles.size();
    d.fillMass = filled.mass;
    if (c.world.coil) {
        const geometry::Coil& coil = *c.world.coil;
        d.pushVelocity = coil.pitch * c.schedule.coilSpeed / (2 * kPi);
        d.tipVelocity = c.schedule.coilSpeed * coil.radius;
        d.massPerTurn = c.bulkDensity * coil.pitch * kPi * coil.radius * coil.radius;
    } else {
        deriveBodies(c, d);
    }
    if (const Schedule& s = c.schedule; d.conveys() && s.rotateTime > 0) {
        const double rests = d.turnsInRests ? s.reverseTime() + s.restTime : 0;
        const double turns = s.coilSpeed * (s.rotateTime - s.rampTime) / (2 * kPi);
        d.massPerDose = d.massPerTurn * turns + d.massPerSecond * (s.rotateTime + rests);
        if (s.targetMass > 0) d.massPerDose = std::min(d.massPerDose, s.targetMass);
        d.doses = d.massPerDose > 0 ? d.fillMass / d.massPerDose : 0;
    }
    d.steps = predictedSteps(c, d);
    d.work = predictedWork(c, filled, d);
    d.countsLeaving = !hasOutlet(c.world) || knowsLeaving(c, d);
    return d;
}

}  // namespace vkdose
