#include "host/advice/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "host/law/law.h"
#include "host/model/bed_weight.h"
#include "host/model/powders.h"
#include "host/model/stability.h"

namespace vkdose {
namespace {

void addSizes(Figures& f, const std::vector<double>& radii) {
    const auto [low, high] = std::minmax_element(radii.begin(), radii.end());
    f.smallest = *low;
    f.largest = *high;
    f.mean = std::accumulate(radii.begin(), radii.end(), 0.0) / static_cast<double>(radii.size());
}

/// The bed and the fall into it. Gravity must pull downwards.
void addBed(Figures& f, const Case& c, const Insertion& filled) {
    const double down = -c.world.gravity.y;
    f.bedTop = f.bedDepth = f.fall = f.fallTime = f.fallSpeed = f.overlapUnderBed = f.overlapOfFall = kNaN;
    f.bondUnderBed = f.bondLargest = kNaN;
    if (!c.canister || !(down > 0)) return;
    const double density = solidDensity(c);
    f.bedDepth = bedDepth(*c.canister, filled.mass, density);
    f.bedTop = f.bedDepth - c.canister->width / 2;
    f.fall = std::max(0.0, filled.fillHeight - f.bedTop);
    const double settling = -c.settlingGravity().y;
    f.fallTime = std::sqrt(2 * f.fall / settling);
    f.fallSpeed = settling * f.fallTime;

    const ContactParameters& pair = c.dosingLaw.of(ContactClass::ParticleParticle);
    const ContactParameters& wall = c.dosingLaw.of(canisterPair(c));
    const double load = loadUnderBed(density, down, f.bedDepth, f.mean);
    f.overlapUnderBed = overlapUnder(pair, f.mean, load) / f.mean;
    f.overlapOfFall = overlapOfImpact(wall, sphereMass(density, f.largest), 2 * f.largest, f.fallSpeed) / f.largest;
    const double weight = sphereMass(density, f.mean) * down;
    f.bondUnderBed = pullOffUnder(pair, f.mean, load) / weight;
    f.bondLargest = pullOffUnder(pair, f.mean, std::numeric_limits<double>::infinity()) / weight;
}

void addCoil(Figures& f, const Case& c) {
    f.coilGap = f.coilClearance = kNaN;
    if (!c.world.coil) return;
    const geometry::Coil& coil = *c.world.coil;
    const double round = 2 * kPi * coil.radius;
    f.coilGap = coil.pitch * round / std::hypot(round, coil.pitch) - 2 * coil.wireRadius;
    if (!c.canister) return;
    const bool inHole = coil.zStart + coil.length > c.canister->length;
    const double room = inHole ? std::min(c.canister->width, c.canister->outletDiameter) : c.canister->width;
    f.coilClearance = room / 2 - coil.radius - coil.wireRadius;
}

/// The bodies that a motion may be one of, in brackets, if its name is that of a powder and a material of bodies.
std::string bodiesOf(const World& world, const std::string& motion) {
    const std::string pair = motion.substr(0, motion.rfind(' '));
    std::string names;
    for (const MaterialPair& p : occurringPairs(world))
        for (const RigidBody& body : world.bodies)
            if (nameOf(world, p) == pair && body.material == p.b) names += (names.empty() ? "" : ", ") + body.name;
    return names.empty() ? "" : fmt::format(" (bodies of this material: {})", names);
}

void addStep(Figures& f, const Case& c, const Insertion& filled) {
    f.automaticStep = std::numeric_limits<double>::infinity();
    // Refills count: the more spheres there are, the more of them a body that moves freely can swing on.
    for (const ContactMode& mode : modesOf(c, powderSizes(c.world, filled.allParticles()))) {
        ContactMode undamped = mode;
        undamped.decay = 0;
        const double step = automaticTimeStep({mode}, c.stepsPerContact);
        if (!(step < f.automaticStep)) continue;
        f.automaticStep = step;
        f.stepLimit = (step < automaticTimeStep({undamped}, c.stepsPerContact) ? "damping of the " : "") + mode.name +
                      bodiesOf(c.world, mode.name);
    }
}

}  // namespace

MaterialPair canisterPair(const Case& c) {
    return {kFirstPowder, c.world.walls.front().material};  // of all walls of a canister the same
}

Figures figuresOf(const Case& c, const Insertion& filled) {
    Figures f;
    addSizes(f, filled.particles.radius);
    addBed(f, c, filled);
    addCoil(f, c);
    addStep(f, c, filled);
    const PowderSizes sizes = powderSizes(c.world, filled.particles);
    for (const MaterialPair& pair : occurringPairs(c.world)) {
        if (!haveSpheres(c.world, pair, sizes)) continue;
        const auto of = [&](double SizeRange::*size) {
            const double a = sizes[std::size_t(pair.a)].*size, b = otherSide(c.world, pair, sizes, size);
            return restitution(c.dosingLaw.of(pair), reducedMass(c.world, pair, a, b));
        };
        f.restitutions.push_back({pair, of(&SizeRange::mean), of(&SizeRange::smallest), of(&SizeRange::largest)});
    }
    f.runTime = derive(c, filled).steps * c.world.timeStep;
    return f;
}

}  // namespace vkdose
