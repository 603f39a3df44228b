#include "host/sim/agreement.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "host/core/worse.h"

namespace vkdose {

namespace {

double rootMeanSquareSpeed(const Particles& p) {
    double sum = 0, active = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (p.status[i] != Status::Active) continue;
        sum += glm::dot(p.velocity[i], p.velocity[i]);
        active += 1;
    }
    return active > 0 ? std::sqrt(sum / active) : 0;
}

/// A difference in units of a scale. Without a scale it is zero if the two are equal and infinite otherwise.
double inUnits(double difference, double scale) {
    if (scale > 0) return difference / scale;
    return difference == 0 ? 0 : kInfinity;
}

/// One figure of the packing and how much of it may differ without a reason.
struct Quantity {
    const char* name;
    const char* unit;
    std::function<double(const Moment&)> value;
    std::function<bool(const Moment&)> counts;  ///< at which moments
    double fixedScale;                          ///< 0: the largest magnitude of the reference
    double floor;
    double cap;
};

bool settling(const Moment& m) {
    return m.phase == Phase::Settle;
}
bool dosing(const Moment& m) {
    return m.phase != Phase::Settle;
}
bool turning(const Moment& m) {
    return m.phase == Phase::Rotate;
}

/// While the coil turns the powder sticks and slips, so that only means over the phase say anything. The floors are:
/// - energies and torques: 2 % of the largest, the order of the change by one particle more or less in motion in a
///   small packing;
/// - height, and way of the bodies that move freely: a fiftieth of a radius;
/// - contacts: 0.1 in the number of each particle;
/// - overlap: 5 %, because it is an extreme of a few hard contacts;
/// - dosed mass: two particles, because they leave one by one and those near the edge may or may not.
std::vector<Quantity> quantities(const Scales& s) {
    const auto energy = [](const Moment& m) { return m.kineticEnergy; };
    const auto meanEnergy = [](const Moment& m) { return m.meanKineticEnergy; };
    const auto height = [](const Moment& m) { return m.meanHeight; };
    const auto contacts = [](const Moment& m) { return m.contactsEach; };
    const auto overlap = [](const Moment& m) { return m.maxOverlap; };
    const auto torque = [](const Moment& m) { return m.meanTorque; };
    const auto freeWay = [](const Moment& m) { return m.freeWay; };
    const auto dosed = [](const Moment& m) { return m.dosedMass; };
    const auto late = [](const Moment& m) { return m.lateInPhase; };
    const auto lateTurn = [](const Moment& m) { return turning(m) && m.lateInPhase; };
    const double dosedCap = std::max(3.0, 0.2 * s.filledMass / s.particleMass);
    return {
        {"kinetic energy, settling", "of its largest", energy, settling, 0, 0.02, 0.5},
        {"kinetic energy, turning", "of its largest", meanEnergy, lateTurn, 0, 0.02, 0.5},
        {"mean height, settling", "mean radii", height, settling, s.radius, 0.02, 1},
        {"mean height, dosing", "mean radii", height, dosing, s.radius, 0.02, 1},
        {"way of free bodies", "mean radii", freeWay, [](const Moment&) { return true; }, s.radius, 0.02, 1},
        {"contacts per particle", "contacts", contacts, late, 1, 0.1, 0.5},
        {"largest overlap, settling", "of its largest", overlap, settling, 0, 0.05, 0.5},
        {"largest overlap, dosing", "of its largest", overlap, dosing, 0, 0.05, 0.5},
        {"mean coil torque, turning", "of its largest", torque, lateTurn, 0, 0.02, 0.5},
        {"dosed mass", "mean particles", dosed, [](const Moment&) { return true; }, s.particleMass, 2, dosedCap},
    };
}

double scaleOf(const Quantity& q, const History& reference) {
    double scale = q.fixedScale;
    if (scale > 0) return scale;
    for (const Moment& m : reference) {
        if (q.counts(m)) scale = worse(scale, std::abs(q.value(m)));
    }
    return scale;
}

QuantityRow judge(const Quantity& q, const History& reference, const std::vector<const History*>& twins,
                  const History& candidate) {
    QuantityRow row;
    row.name = q.name;
    row.unit = q.unit;
    const double scale = scaleOf(q, reference);
    const auto off = [&](const History& h, std::size_t i) {
        if (i >= h.size()) return kInfinity;
        return inUnits(std::abs(q.value(h[i]) - q.value(reference[i])), scale);
    };
    for (std::size_t i = 0; i < reference.size(); ++i) {
        if (!q.counts(reference[i])) continue;
        const double d = worse(0, off(candidate, i));
        if (d > row.difference || row.time == 0) row.time = reference[i].time;
        row.difference = std::max(row.difference, d);
        for (const History* twin : twins) row.spread = worse(row.spread, off(*twin, i));
    }
    row.tolerance = q.floor + 3 * row.spread;
    const bool within = std::isfinite(row.difference) && row.difference <= row.tolerance;
    row.verdict = !within ? Verdict::Differs : row.tolerance <= q.cap ? Verdict::Agrees : Verdict::Undecided;
    return row;
}

}  // namespace

Scales scalesOf(const World& world, const Particles& particles, double filledMass) {
    Scales s;
    s.period = world.period;
    const auto n = static_cast<double>(particles.size());
    for (const double r : particles.radius) s.radius += r / n;
    s.filledMass = filledMass;
    s.particleMass = filledMass / n;
    return s;
}

StateDifference difference(const Particles& a, const Particles& b, const Vec3& period) {
    if (a.size() != b.size()) return {kInfinity, kInfinity};
    StateDifference d;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a.status[i] != Status::Active || b.status[i] != Status::Active) continue;
        d.position = worse(d.position, glm::length(shortest(a.position[i] - b.position[i], period)));
        d.velocity = worse(d.velocity, glm::length(a.velocity[i] - b.velocity[i]));
    }
    return d;
}

ParticleRow ParticleJudge::row(std::uint64_t step, double time, std::size_t contacts, const Particles& reference,
                               const Particles& fineTwin, const Particles& candidate) {
    speed_ = worse(speed_, rootMeanSquareSpeed(reference));
    const StateDifference t = difference(reference, fineTwin, scales_.period);
    twinPosition_ = worse(twinPosition_, inUnits(t.position, scales_.radius));
    twinVelocity_ = worse(twinVelocity_, inUnits(t.velocity, speed_));
    const StateDifference d = difference(reference, candidate, scales_.period);
    ParticleRow row;
    row.step = step;
    row.time = time;
    row.position = inUnits(d.position, scales_.radius);
    row.velocity = inUnits(d.velocity, speed_);

    row.contacts = contacts;
    touched_ = touched_ || contacts > 0;
    const double drift = (touched_ ? kRadiusRounding : kPositionFloor) +  // in mean radii
                         0.5 * kVelocityFloor * speed_ * time / scales_.radius;
    // What contacts leave in the velocities moves the spheres from then on.
    const double left = drift * kOneTwin * twinVelocity_ / kFineShift;
    way_ += inUnits(left * speed_ * (time - time_), scales_.radius);
    time_ = time;
    row.positionLimit = drift * std::max(1.0, kOneTwin * twinPosition_ / kFineShift) + way_;
    row.velocityLimit = kVelocityFloor + left;
    chaotic_ = chaotic_ || row.positionLimit > kWidest || row.velocityLimit > kWidest;
    const bool within = row.position <= row.positionLimit && row.velocity <= row.velocityLimit;  // false for NaN
    row.verdict = chaotic_ ? Verdict::Undecided : within ? Verdict::Agrees : Verdict::Differs;
    return row;
}

std::vector<QuantityRow> judgeQuantities(const History& reference, const std::vector<const History*>& twins,
                                         const History& candidate, const Scales& scales) {
    std::vector<const History*> all{&reference, &candidate};
    all.insert(all.end(), twins.begin(), twins.end());
    const auto happened = [&](const Quantity& q) {
        const double least = q.floor * scaleOf(q, reference);
        const auto shows = [&](const Moment& m) { return q.counts(m) && !(std::abs(q.value(m)) <= least); };  // or NaN
        return std::any_of(all.begin(), all.end(),
                           [&](const History* h) { return std::any_of(h->begin(), h->end(), shows); });
    };
    std::vector<QuantityRow> rows;
    for (const Quantity& q : quantities(scales)) {
        if (happened(q)) rows.push_back(judge(q, reference, twins, candidate));
    }
    return rows;
}

}  // namespace vkdose
