#include "host/model/stability.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/core/vec.h"
#include "host/model/case.h"
#include "host/model/normal_law.h"
#include "host/model/particles.h"
#include "host/model/restitution.h"

namespace vkdose {
namespace {

constexpr double kWall = std::numeric_limits<double>::infinity();

bool isNormal(const ContactMode& mode) {
    return mode.name.ends_with(" normal");
}

}  // namespace

double reducedMass(double density, double a, double b) {
    const double volume = 4.0 / 3.0 * kPi;
    const double ma = density * volume * a * a * a;
    if (std::isinf(b)) return ma;
    const double mb = density * volume * b * b * b;
    return ma * mb / (ma + mb);
}

std::string className(ContactClass c) {
    switch (c) {
        case ContactClass::ParticleParticle:
            return "particle-particle";
        case ContactClass::ParticleWall:
            return "particle-wall";
        case ContactClass::ParticleCoil:
            return "particle-coil";
    }
    return "unknown";
}

std::vector<ContactClass> contactClasses(const World& world) {
    std::vector<ContactClass> classes{ContactClass::ParticleParticle};
    const auto hasBody = [&](ContactClass kind) {
        return std::any_of(world.bodies.begin(), world.bodies.end(),
                           [&](const RigidBody& b) { return b.kind == kind; });
    };
    if (!world.surfaces.empty() || hasBody(ContactClass::ParticleWall)) classes.push_back(ContactClass::ParticleWall);
    if (world.coil || hasBody(ContactClass::ParticleCoil)) classes.push_back(ContactClass::ParticleCoil);
    return classes;
}

ContactParameters stiffest(const ContactParameters& p, double density, double a, double b, double maxOverlapRatio) {
    return linearised(p, reducedMass(density, a, b), reducedSize(a, b), maxOverlapRatio * std::min(a, b));
}

std::vector<ContactMode> contactModes(const ContactLaw& law, double density, double smallest,
                                      const std::vector<ContactClass>& used, double maxOverlapRatio) {
    const double mass = sphereMass(density, smallest);
    std::vector<ContactMode> modes;
    const auto add = [&](const std::string& name, double k, double gamma, double effectiveMass) {
        if (k <= 0) return;
        modes.push_back({name, kPi * std::sqrt(effectiveMass / k), gamma / effectiveMass});
    };
    for (const ContactClass c : used) {
        const bool pair = c == ContactClass::ParticleParticle;
        const double normal = pair ? mass / 2 : mass;
        const ContactParameters p = stiffest(law.of(c), density, smallest, pair ? smallest : kWall, maxOverlapRatio);
        add(className(c) + " normal", p.k2Max, p.gamma, normal);
        // Sliding moves the surface: 1/m + a^2/I = 3.5/m for a full sphere of inertia 0.4 m a^2.
        if (p.mu > 0) add(className(c) + " sliding", p.kt, p.gammaT, normal / 3.5);
        // Rolling: a_r^2/I with a_r <= 2 a. The bound is reached against a wall or a much larger sphere. For "half" it
        // is half as large.
        const double lever = law.rollingLever == RollingLever::Full ? 2 : 1;
        const double turning = 0.4 * mass / (lever * lever);
        if (p.muR > 0) add(className(c) + " rolling", p.kr, p.gammaR, turning);
        if (p.muTo > 0) add(className(c) + " torsion", p.kTo, p.gammaTo, turning);
    }
    return modes;
}

std::vector<ContactMode> modesOf(const Case& c, double smallest) {
    const std::vector<ContactClass> used = contactClasses(c.world);
    std::vector<ContactMode> modes =
        contactModes(c.dosingLaw, c.world.density, smallest, used, c.world.maxOverlapRatio);
    const auto settling = contactModes(c.settlingLaw, c.world.density, smallest, used, c.world.maxOverlapRatio);
    modes.insert(modes.end(), settling.begin(), settling.end());
    return modes;
}

double automaticTimeStep(const std::vector<ContactMode>& modes, std::optional<double> stepsPerContact) {
    double step = std::numeric_limits<double>::infinity();
    for (const ContactMode& mode : modes) {
        step = std::min(step, mode.duration / stepsPerContact.value_or(isNormal(mode) ? 8 : 6));
        if (mode.decay > 0) step = std::min(step, 0.5 / mode.decay);
    }
    return step;
}

}  // namespace vkdose
