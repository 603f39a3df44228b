#include "host/advice/figures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "host/model/pull_off.h"
#include "host/model/size_distribution.h"
#include "host/model/stability.h"

namespace vkdose {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kWall = std::numeric_limits<double>::infinity();

/// Cross-section of the canister below the height y over the coil's axis [m2].
double crossSection(const Canister& can, double y) {
    const double half = can.width / 2;
    if (can.flatFloor) return can.width * std::max(0.0, y + half);
    if (y >= 0) return 0.5 * kPi * half * half + can.width * y;
    if (y <= -half) return 0;
    return half * half * std::acos(-y / half) + y * std::sqrt(half * half - y * y);
}

/// Height at which the powder stands once it has settled [m, y].
double settledTop(const Canister& can, double volume) {
    double low = -can.width / 2;
    double high = low + can.width + volume / (can.length * can.width);
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (crossSection(can, middle) * can.length < volume ? low : high) = middle;
    }
    return high;
}

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
    f.bedTop = settledTop(*c.canister, filled.mass / c.world.density / kBedFraction);
    f.bedDepth = f.bedTop + c.canister->width / 2;
    f.fall = std::max(0.0, filled.fillHeight - f.bedTop);
    f.fallTime = std::sqrt(2 * f.fall / down);
    f.fallSpeed = down * f.fallTime;

    const ContactParameters& pair = c.dosingLaw.of(ContactClass::ParticleParticle);
    const ContactParameters& wall = c.dosingLaw.of(ContactClass::ParticleWall);
    // A contact bears the bed's pressure on the square that a sphere takes up.
    const double load = c.world.density * kBedFraction * down * f.bedDepth * 4 * f.mean * f.mean;
    f.overlapUnderBed = load / pair.k1 / f.mean;
    f.overlapOfFall = f.fallSpeed * std::sqrt(sphereMass(c.world.density, f.largest) / wall.k1) / f.largest;
    const double weight = sphereMass(c.world.density, f.mean) * down;
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

void addStep(Figures& f, const Case& c) {
    f.automaticStep = std::numeric_limits<double>::infinity();
    for (const ContactMode& mode : modesOf(c, f.smallest)) {
        ContactMode undamped = mode;
        undamped.decay = 0;
        const double step = automaticTimeStep({mode}, c.stepsPerContact);
        if (!(step < f.automaticStep)) continue;
        f.automaticStep = step;
        f.stepLimit = (step < automaticTimeStep({undamped}, c.stepsPerContact) ? "damping of the " : "") + mode.name;
    }
}

}  // namespace

double restitution(const ContactParameters& p, double density, double a, double b) {
    const double zeta = p.gamma / (2 * std::sqrt(p.k1 * reducedMass(density, a, b)));
    return zeta < 1 ? std::exp(-kPi * zeta / std::sqrt(1 - zeta * zeta)) : 0;
}

double dampingFor(double e, const ContactParameters& p, double density, double a, double b) {
    const double log = std::log(e);
    return -2 * log / std::hypot(kPi, log) * std::sqrt(p.k1 * reducedMass(density, a, b));
}

double pullOffUnder(const ContactParameters& p, double reduced, double load) {
    return pullOff(p, reduced, load / p.k1);
}

Figures figuresOf(const Case& c, const Insertion& filled) {
    Figures f;
    addSizes(f, filled.particles.radius);
    addBed(f, c, filled);
    addCoil(f, c);
    addStep(f, c);
    for (const ContactClass kind : contactClasses(c.world)) {
        const ContactParameters& p = c.dosingLaw.of(kind);
        const bool pair = kind == ContactClass::ParticleParticle;
        const auto of = [&](double r) { return restitution(p, c.world.density, r, pair ? r : kWall); };
        f.restitutions.push_back({kind, of(f.mean), of(f.smallest), of(f.largest)});
    }
    f.runTime = derive(c, filled).steps * c.world.timeStep;
    return f;
}

}  // namespace vkdose
