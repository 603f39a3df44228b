// Several materials: each pair has its own law, each powder its own density. Every case has at least two powders and
// differs from what a mix-up of materials would give.

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "host/law/hertz.h"
#include "host/verify/cases.h"
#include "host/verify/setups.h"

namespace vkdose::verify {

namespace {

constexpr int kSecondPowder = 3, kFloorMaterial = 4;
constexpr double kSecondDensity = 2600;  // [kg/m3]

/// Adds a second powder and a material for floors.
RuledWorld withMaterials(RuledWorld world) {
    world.materials.push_back({"second", true, kSecondDensity});
    world.materials.push_back({"floor", false, 0});
    world.law.pairs.resize(static_cast<int>(world.materials.size()));
    return world;
}

double densityOf(int material) {
    return material == kSecondPowder ? kSecondDensity : kDensity;
}

/// Mass of a sphere of that powder, from the volume [kg].
double massOf(int material, double radius) {
    return verify::massOf(radius) * densityOf(material) / kDensity;
}

/// Spheres of two powders that meet head on at a relative speed [m/s], far from the others.
struct Meeting {
    int a, b;
    double radiusA, radiusB, speed;

    double mass() const {
        const double ma = massOf(a, radiusA), mb = massOf(b, radiusB);
        return ma * mb / (ma + mb);
    }
    double reduced() const { return 2 * radiusA * radiusB / (radiusA + radiusB); }
};

/// Adds the two; the first flies along +x, both with half of the speed.
void add(Particles& p, const Meeting& m) {
    const Vec3 aside(0, 20 * kRadius * static_cast<double>(p.size()), 0);
    p.add(aside - Vec3(m.radiusA, 0, 0), m.radiusA, Vec3(m.speed / 2, 0, 0), Vec3(0), m.a);
    p.add(aside + Vec3(m.radiusB, 0, 0), m.radiusB, Vec3(-m.speed / 2, 0, 0), Vec3(0), m.b);
}

constexpr std::array<Meeting, 3> kMeetings{{{0, 0, 1e-3, 1e-3, 0.4},
                                            {0, kSecondPowder, 1e-3, 1.5e-3, 0.4},
                                            {kSecondPowder, kSecondPowder, 1.5e-3, 0.8e-3, 0.4}}};

std::string nameOf(const Meeting& m) {
    return fmt::format("powders {} and {}", m.a == 0 ? 1 : 2, m.b == 0 ? 1 : 2);
}

}  // namespace

// 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2, m* and R* of the pair give Hertz's overlap, force and duration. Undamped
// spheres part as unequal billiard balls do.
void materialsHertz(Stage& stage) {
    const std::array<Elasticity, 2> solid{{{1e9, 0.2}, {0.4e9, 0.35}}};
    RuledWorld world = withMaterials(space({}, 0));
    const auto of = [&](int material) -> const Elasticity& { return solid[material == kSecondPowder ? 1 : 0]; };
    struct Known {
        double overlap, force, duration;
    };
    std::array<Known, kMeetings.size()> known{};
    Particles pairs;
    double shortest = 1, longest = 0;
    for (std::size_t k = 0; k < kMeetings.size(); ++k) {
        const Meeting& m = kMeetings[k];
        const auto softness = [](const Elasticity& e) { return (1 - e.poisson * e.poisson) / e.modulus; };
        const double stiff = std::sqrt(m.reduced() / 2) / (softness(of(m.a)) + softness(of(m.b)));
        const double overlap = std::pow(15.0 / 16 * m.mass() * m.speed * m.speed / stiff, 0.4);
        known[k] = {overlap, 4.0 / 3 * stiff * std::pow(overlap, 1.5), 2.9432750 * overlap / m.speed};
        shortest = std::min(shortest, known[k].duration);
        longest = std::max(longest, known[k].duration);
        world.law.between(m.a, m.b) = hertzMindlin(of(m.a), of(m.b), 1);
        add(pairs, m);
    }
    world.timeStep = shortest / 100;
    Trial trial(stage, world, pairs);
    std::array<Known, kMeetings.size()> got{};
    while (trial.time() < 1.5 * longest) {
        trial.advance(1);
        for (std::size_t k = 0; k < kMeetings.size(); ++k) {
            const Meeting& m = kMeetings[k];
            const double apart = glm::length(trial.now().position[2 * k + 1] - trial.now().position[2 * k]);
            const double overlap = m.radiusA + m.radiusB - apart;
            got[k].overlap = std::max(got[k].overlap, overlap);
            if (got[k].duration == 0 && overlap < 0) got[k].duration = trial.time();
        }
        for (const Contact& c : trial.contacts())
            got[c.particle / 2].force = std::max(got[c.particle / 2].force, glm::length(c.force));
    }
    const Tolerance tolerance{1e-3, "time step of 1/100 of the contact, looked at every step"};
    for (std::size_t k = 0; k < kMeetings.size(); ++k) {
        const Meeting& m = kMeetings[k];
        stage.check("largest overlap, " + nameOf(m), "m", known[k].overlap, got[k].overlap, tolerance);
        stage.check("largest force, " + nameOf(m), "N", known[k].force, got[k].force, tolerance);
        stage.check("duration, " + nameOf(m), "s", known[k].duration, got[k].duration,
                    {1.0 / 100 + 1e-3, "looked at every step"});
        const double ma = massOf(m.a, m.radiusA), mb = massOf(m.b, m.radiusB);
        stage.check("speed after, " + nameOf(m), "m/s", m.speed / 2 * (1 - 4 * mb / (ma + mb)),
                    trial.now().velocity[2 * k].x, {4e-4, "time step, rounding; of the speed", m.speed});
    }
}

// Without damping and adhesion, on Luding's law below the plastic limit phi a* k2/(k2 - k1): the largest overlap is
// v sqrt(m*/k1), the contact unloads on k = k1 + (k2 - k1) overlap/limit, and e^2 = k1/k.
void materialsLuding(Stage& stage) {
    RuledWorld world = withMaterials(space({}, 1e-6));
    const std::array<std::array<double, 2>, 3> stiffness{{{2000, 20000}, {3500, 10000}, {1200, 15000}}};  // k1, k2
    Particles pairs;
    std::array<double, 3> known{};
    for (std::size_t k = 0; k < kMeetings.size(); ++k) {
        const Meeting& m = kMeetings[k];
        ContactParameters& p = world.law.between(m.a, m.b);
        p.k1 = stiffness[k][0];
        p.k2Max = stiffness[k][1];
        p.plasticityDepth = kPlasticity;
        const double limit = p.k2Max / (p.k2Max - p.k1) * p.plasticityDepth * m.reduced();
        const double overlap = m.speed * std::sqrt(m.mass() / p.k1);
        stage.check("overlap over the plastic limit is below 1, " + nameOf(m), "-", 1, overlap < limit ? 1 : 0,
                    {0, "else another closed form holds"});
        known[k] = std::sqrt(p.k1 / (p.k1 + (p.k2Max - p.k1) * overlap / limit));
        add(pairs, m);
    }
    Trial trial(stage, world, pairs);
    trial.advanceTo(2e-3);
    for (std::size_t k = 0; k < kMeetings.size(); ++k) {
        const double apart = trial.now().velocity[2 * k + 1].x - trial.now().velocity[2 * k].x;
        stage.check("restitution, " + nameOf(kMeetings[k]), "-", known[k], apart / kMeetings[k].speed,
                    {1e-3, "time step of some 1/300 of the contact"});
    }
}

// Spheres of two powders slide on a floor of a third material and on a plate, a body, of a fourth. Each is braked by
// the friction of its pair until it rolls with 5/7 of its speed.
void materialsSliding(Stage& stage) {
    const double stiff = 500, start = 0.1, dt = 1e-5;
    RuledWorld world = withMaterials(floor({}, dt));
    const double top = 0.2;  // [m]
    world.materials.push_back({"plate", false, 0});
    const int plateMaterial = static_cast<int>(world.materials.size()) - 1;
    world.law.pairs.resize(plateMaterial + 1);
    world.walls.front().material = kFloorMaterial;
    RigidBody plate;
    plate.name = "plate";
    plate.shapes = {geometry::Block{Vec3(-0.2, -0.01, -0.2), Vec3(0.2, 0, 0.2)}};
    plate.course.start.origin = Vec3(0, top, 0);
    plate.material = plateMaterial;
    world.bodies.push_back(plate);
    const auto rough = [&](int powder, int wall, double mu) {
        ContactParameters p = spring(stiff, 0.02);
        p.mu = mu;
        p.kt = 0.5 * stiff;
        p.gammaT = 0.01;
        world.law.between(powder, wall) = p;
        return mu;
    };
    struct Slider {
        int powder;
        double ground, mu;
    };
    const std::array<Slider, 4> sliders{{{0, 0, rough(0, kFloorMaterial, 0.3)},
                                         {kSecondPowder, 0, rough(kSecondPowder, kFloorMaterial, 0.2)},
                                         {0, top, rough(0, plateMaterial, 0.25)},
                                         {kSecondPowder, top, rough(kSecondPowder, plateMaterial, 0.15)}}};
    Particles spheres;
    for (std::size_t k = 0; k < sliders.size(); ++k) {
        const Slider& s = sliders[k];
        const double sinking = massOf(s.powder, kRadius) * kGravity / stiff;
        spheres.add(Vec3(0, s.ground + kRadius - sinking, 0.02 * static_cast<double>(k)), kRadius, Vec3(start, 0, 0),
                    Vec3(0), s.powder);
    }
    Trial trial(stage, world, spheres);
    const double slowest = 2.0 / 7 * start / (0.15 * kGravity), fastest = 2.0 / 7 * start / (0.3 * kGravity);
    trial.advanceTo(0.8 * fastest);
    for (const Slider& s : sliders) {
        const auto k = static_cast<std::size_t>(&s - sliders.data());
        stage.check(fmt::format("speed of powder {} on {}", s.powder == 0 ? 1 : 2, s.ground == 0 ? "floor" : "plate"),
                    "m/s", start - s.mu * kGravity * trial.halfStep(), trial.now().velocity[k].x,
                    {2e-3, "stretch of the tangential spring, time step", start});
    }
    trial.advanceTo(1.5 * slowest);
    for (std::size_t k = 0; k < sliders.size(); ++k)
        stage.check(fmt::format("speed of rolling, sphere {}", k + 1), "m/s", 5.0 / 7 * start,
                    trial.now().velocity[k].x, {2e-3, "stretch of the tangential spring, time step", start});
}

// A cluster of two powders with every interaction on keeps its momentum and its angular momentum, and its ledger
// closes.
void materialsCluster(Stage& stage) {
    RuledWorld world = withMaterials(space(everyInteraction(), 1e-6));
    world.energyBook = true;
    world.law.pairs.fill(everyInteraction());
    ContactParameters &mixed = world.law.between(0, kSecondPowder),
                      &second = world.law.between(kSecondPowder, kSecondPowder);
    mixed.k1 *= 0.7, mixed.kc *= 0.5, mixed.mu = 0.3;
    second.k1 *= 1.3, second.k2Max *= 1.2, second.muR = 0.2, second.gamma *= 1.5;
    Particles cluster = collapsingCluster();
    for (std::size_t i = 0; i < cluster.size(); ++i)
        if (i % 5 < 2) cluster.material[i] = kSecondPowder;

    struct Sums {
        Vec3 linear{0}, angular{0};
        double linearSize = 0, angularSize = 0, energy = 0;
        explicit Sums(const Particles& p) {
            for (std::size_t i = 0; i < p.size(); ++i) {
                const double m = massOf(int(p.material[i]), p.radius[i]), inertia = 0.4 * m * p.radius[i] * p.radius[i];
                const Vec3 mv = m * p.velocity[i], iw = inertia * p.spin[i];
                linear += mv;
                angular += glm::cross(p.position[i], mv) + iw;
                linearSize += glm::length(mv);
                angularSize += glm::length(p.position[i]) * glm::length(mv) + glm::length(iw);
                energy += glm::dot(mv, p.velocity[i]) / 2 + glm::dot(iw, p.spin[i]) / 2;
            }
        }
    };
    const Sums before(cluster);
    Trial trial(stage, world, cluster);
    std::array<bool, 3> met{};
    for (int i = 0; i < 80; ++i) {
        trial.advance(250);
        for (const Contact& c : trial.contacts())
            met[std::size_t((cluster.material[c.particle] + cluster.material[c.other]) / kSecondPowder)] = true;
    }
    stage.check("pairs of powders that met", "-", 3, double(met[0]) + double(met[1]) + double(met[2]),
                {0, "else the case is about less than it says"});
    const Sums after(trial.now());
    stage.check("drift of the momentum", "kg m/s", 0, glm::length(after.linear - before.linear),
                {5e-7, "rounding in single precision, in units of the sum of |m v|", before.linearSize});
    stage.check("drift of the angular momentum", "kg m2/s", 0, glm::length(after.angular - before.angular),
                {5e-7, "the same, in units of the sum of |x||m v| + I|omega|", before.angularSize});
    const EnergyLedger& ledger = trial.energy();
    stage.check("energy loaded", "J", before.energy, ledger.sum.loaded, {1e-5, "rounding; the opening half kick"});
    stage.check("what the ledger leaves over", "J", 0, ledger.residual(), {1e-5, "rounding", before.energy});
    stage.check("the time step's own loss", "J", 0, ledger.sum.numerical,
                {3e-4, "of second order in the step; some meet more than once", before.energy});
}

}  // namespace vkdose::verify
