#include "host/model/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "host/core/vec.h"
#include "host/law/law.h"
#include "host/model/body_form.h"
#include "host/model/body_mesh.h"
#include "host/model/case.h"
#include "host/model/particles.h"
#include "host/model/powders.h"
#include "host/model/size_distribution.h"

namespace vkdose {
namespace {

/// Radius of a wall, beside a sphere.
constexpr double kWall = kInfinity;

/// The surface of a body, with both sides of it if a part has no thickness; infinite if it has no end [m2].
double surfaceOf(const RigidBody& body) {
    if (std::any_of(body.shapes.begin(), body.shapes.end(), [](const geometry::Shape& s) { return formOf(s).endless; }))
        return kInfinity;
    double area = 0;
    for (const geometry::Triangle& t : trianglesOf(body)) area += glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) / 2;
    return std::all_of(body.shapes.begin(), body.shapes.end(), [](const geometry::Shape& s) { return formOf(s).solid; })
               ? area
               : 2 * area;
}

/// The most spheres of radius `a` that can touch a body with this surface at once. They cover a ball of the same
/// surface, packed as densely as can be, and there are no more than `size` counts.
double mostOnBody(double area, const SizeRange& size, double a) {
    const double around = std::sqrt(area / (4 * kPi)) + a;
    const double room = 2 * std::sqrt(3.0) * a * a;
    return std::min(4 * kPi * around * around / room, size.count);
}

/// The least mass that a sphere can see in a body that moves freely [kg].
double leastMass(const RigidBody& body) {
    const geometry::Hinge* hinge = body.hinge();
    if (hinge == nullptr) return std::get<geometry::Free>(body.course.motion).mass;
    const double lever = hingeLever(body);
    return hinge->inertia / (lever * lever);
}

bool isNormal(const ContactMode& mode) {
    return mode.name.ends_with(" normal");
}

}  // namespace

double reducedMass(double density, double a, double b) {
    return reducedMass(density, a, density, b);
}

double reducedMass(double densityA, double a, double densityB, double b) {
    const double volume = 4.0 / 3.0 * kPi;
    const double ma = densityA * volume * a * a * a;
    if (std::isinf(b)) return ma;
    const double mb = densityB * volume * b * b * b;
    return ma * mb / (ma + mb);
}

double reducedMass(const World& world, MaterialPair pair, double a, double b) {
    return reducedMass(world.density(pair.a), a, world.density(pair.b), b);
}

PowderSizes powderSizes(const Case& c) {
    if (c.filling.list) {
        PowderSizes sizes = powderSizes(c.world, *c.filling.list);
        if (!c.refills.empty())
            for (SizeRange& size : sizes) size.count = kInfinity;
        return sizes;
    }
    PowderSizes sizes(c.world.materials.size());
    for (const PowderOf& p : powdersOf(c)) {
        const SizeDistribution& size = p.filling.size;
        double mass = p.filling.mass;
        for (const Refill& r : c.refills) mass += r.material == p.material ? r.mass : 0;
        const double count = mass / sphereMass(c.world.density(p.material), std::cbrt(meanCubedRadius(size)));
        sizes[std::size_t(p.material)] = {smallestRadius(size), largestRadius(size), meanRadius(size), count};
    }
    return sizes;
}

PowderSizes powderSizes(const World& world, const Particles& particles) {
    PowderSizes sizes(world.materials.size());
    std::vector<double> count(sizes.size());
    for (const std::uint8_t m : particles.material) count.at(m) += 1;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        SizeRange& size = sizes[particles.material[i]];
        const double r = particles.radius[i];
        size.smallest = std::min(size.smallest, r);
        size.largest = std::max(size.largest, r);
        size.mean += r / count[particles.material[i]];
        size.count = count[particles.material[i]];
    }
    return sizes;
}

SizeRange overall(const PowderSizes& sizes) {
    SizeRange all;
    double powders = 0;
    for (const SizeRange& size : sizes) powders += size.largest > 0 ? 1 : 0;
    for (const SizeRange& size : sizes) {
        all.smallest = std::min(all.smallest, size.smallest);
        all.largest = std::max(all.largest, size.largest);
        all.mean += size.mean / powders;
    }
    return all;
}

double otherSide(const World& world, MaterialPair pair, const PowderSizes& sizes, double SizeRange::*size) {
    const auto other = static_cast<std::size_t>(pair.b);
    return world.materials.at(other).powder ? sizes.at(other).*size : kWall;
}

bool haveSpheres(const World& world, MaterialPair pair, const PowderSizes& sizes) {
    const auto some = [&](int material) {
        return !world.materials.at(std::size_t(material)).powder ||
               std::isfinite(sizes.at(std::size_t(material)).smallest);
    };
    return some(pair.a) && some(pair.b);
}

ContactParameters stiffest(const ContactParameters& p, double mass, double a, double b, double maxOverlapRatio) {
    return linearised(p, mass, reducedSize(a, b), maxOverlapRatio * std::min(a, b));
}

std::vector<ContactMode> contactModes(const World& world, const ContactLaw& law, const PowderSizes& sizes) {
    std::vector<ContactMode> modes;
    const auto add = [&](const std::string& name, double k, double gamma, double effectiveMass) {
        if (k <= 0) return;
        modes.push_back({name, kPi * std::sqrt(effectiveMass / k), gamma / effectiveMass});
    };
    for (const MaterialPair& pair : occurringPairs(world)) {
        const double a = sizes.at(static_cast<std::size_t>(pair.a)).smallest;
        const double b = otherSide(world, pair, sizes, &SizeRange::smallest);
        const bool wall = !world.materials[static_cast<std::size_t>(pair.b)].powder;
        if (!haveSpheres(world, pair, sizes)) continue;
        const double massA = sphereMass(world.density(pair.a), a);
        const double massB = wall ? kWall : sphereMass(world.density(pair.b), b);
        const double normal = massA / (1 + massA / massB);
        const ContactParameters p = stiffest(law.of(pair), reducedMass(world, pair, a, b), a, b, world.maxOverlapRatio);
        const std::string name = nameOf(world, pair);
        add(name + " normal", p.k2Max, p.gamma, normal);
        // Sliding moves the surface: 1/m + a^2/I = 3.5/m for a full sphere of inertia 0.4 m a^2.
        if (p.mu > 0) add(name + " sliding", p.kt, p.gammaT, normal / 3.5);
        // Rolling: a_r^2 (1/I_a + 1/I_b) with a_r = 2 a b/(a + b) is at most 4 a^2/I of the lighter one. The bound is
        // reached against a wall or a much larger sphere. For "half" it is half as large.
        const double lever = law.rollingLever == RollingLever::Full ? 2 : 1;
        const double turning = 0.4 * std::min(massA, massB) / (lever * lever);
        if (p.muR > 0) add(name + " rolling", p.kr, p.gammaR, turning);
        if (p.muTo > 0) add(name + " torsion", p.kTo, p.gammaTo, turning);
    }
    // A body that moves freely swings on all spheres that carry it, one on a hinge with its rim.
    for (const RigidBody& body : world.bodies) {
        if (!body.movesFreely()) continue;
        const double freeMass = leastMass(body);
        const double area = surfaceOf(body);
        for (const int powder : powdersOf(world)) {
            const MaterialPair pair{powder, body.material};
            if (!haveSpheres(world, pair, sizes)) continue;
            const SizeRange& size = sizes.at(std::size_t(powder));
            const std::string name = fmt::format("{}-{}", world.materials[std::size_t(powder)].name, body.name);
            // There is room for more small spheres, but under some laws large ones are stiffer.
            for (const double a : {size.smallest, size.largest}) {
                const double mass = sphereMass(world.density(powder), a), many = mostOnBody(area, size, a);
                const ContactParameters p = stiffest(law.of(pair), mass, a, kWall, world.maxOverlapRatio);
                const auto swinging = [&](double sphere) {
                    return std::min(sphere / (1 + sphere / freeMass), freeMass / std::max(1.0, many));
                };
                add(name + " normal", p.k2Max, p.gamma, swinging(mass));
                if (p.mu > 0) add(name + " sliding", p.kt, p.gammaT, swinging(mass / 3.5));
            }
        }
    }
    return modes;
}

std::vector<ContactMode> modesOf(const Case& c, const PowderSizes& sizes) {
    std::vector<ContactMode> modes = contactModes(c.world, c.dosingLaw, sizes);
    const auto settling = contactModes(c.world, c.settlingLaw, sizes);
    modes.insert(modes.end(), settling.begin(), settling.end());
    return modes;
}

double automaticTimeStep(const std::vector<ContactMode>& modes, std::optional<double> stepsPerContact) {
    double step = kInfinity;
    for (const ContactMode& mode : modes) {
        step = std::min(step, mode.duration / stepsPerContact.value_or(isNormal(mode) ? 8 : 6));
        if (mode.decay > 0) step = std::min(step, 0.5 / mode.decay);
    }
    return step;
}

}  // namespace vkdose
