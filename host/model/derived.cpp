// Closed forms of the paper and the figures that say whether a case is stable and how long it runs.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "host/model/case.h"
#include "host/model/size_distribution.h"
#include "host/model/stability.h"

namespace vkdose {
namespace {

struct Sizes {
    double mean;
    double smallest;
};

Sizes sizesOf(const Case& c) {
    if (!c.filling.list) return {meanRadius(c.filling.size), smallestRadius(c.filling.size)};
    const std::vector<double>& r = c.filling.list->radius;
    return {std::accumulate(r.begin(), r.end(), 0.0) / static_cast<double>(r.size()),
            *std::min_element(r.begin(), r.end())};
}

double predictedSteps(const Case& c, double doses) {
    const Schedule& s = c.schedule;
    double time = s.settleTime;
    if (s.rotateTime > 0) {
        double count = std::isfinite(doses) ? std::ceil(doses) : 0;
        if (s.stop.kind != StopRule::Kind::None) count += s.stop.doses;
        count = std::min(count, static_cast<double>(s.stop.maxDoses));
        time += count * (s.rotateTime + s.restTime);
    }
    return std::ceil(std::min(time, s.stop.endTime) / c.world.timeStep);
}

}  // namespace

double contactDuration(const ContactParameters& p, double density, double a, double b, double k) {
    const double m12 = reducedMass(density, a, b);
    const double decay = p.gamma / (2 * m12);
    const double square = k / m12 - decay * decay;
    return square > 0 ? kPi / std::sqrt(square) : std::numeric_limits<double>::infinity();
}

Derived derive(const Case& c, const Insertion& filled) {
    constexpr double kWall = std::numeric_limits<double>::infinity();
    Derived d;
    const Sizes sizes = sizesOf(c);
    d.stiffest = kWall;
    for (const ContactClass kind : contactClasses(c.world)) {
        const ContactParameters& p = c.dosingLaw.of(kind);
        const bool pair = kind == ContactClass::ParticleParticle;
        ContactParameters undamped = p;
        undamped.gamma = 0;
        const double mean = contactDuration(p, c.world.density, sizes.mean, pair ? sizes.mean : kWall, p.k1);
        const double stiffest =
            contactDuration(undamped, c.world.density, sizes.smallest, pair ? sizes.smallest : kWall, p.k2Max);
        d.durations.push_back({className(kind), mean, stiffest});
        d.stiffest = std::min(d.stiffest, stiffest);
    }
    d.timeStep = c.world.timeStep;
    d.particles = filled.particles.size();
    d.fillMass = filled.mass;
    if (c.world.coil) {
        const geometry::Coil& coil = *c.world.coil;
        const double turns = c.schedule.coilSpeed * c.schedule.rotateTime / (2 * kPi);
        d.pushVelocity = coil.pitch * c.schedule.coilSpeed / (2 * kPi);
        d.tipVelocity = c.schedule.coilSpeed * coil.radius;
        d.massPerDose = c.bulkDensity * coil.pitch * kPi * coil.radius * coil.radius * turns;
        d.doses = d.massPerDose > 0 ? d.fillMass / d.massPerDose : 0;
    }
    d.steps = predictedSteps(c, d.doses);
    return d;
}

}  // namespace vkdose
