// Collisions: the rebound along the normal and in the tangent plane.

#include <fmt/format.h>

#include <algorithm>

#include "host/verify/cases.h"
#include "host/verify/head_on.h"
#include "host/verify/setups.h"

namespace vkdose::verify {

namespace {

double overlapOf(const Particles& p, std::size_t pair) {
    return 2 * kRadius - glm::length(p.position[2 * pair + 1] - p.position[2 * pair]);
}

}  // namespace

void headOnAdhesive(Stage& stage) {
    const HeadOn law{.kc = 0.873 * kK2Max};
    const double sticks = law.stickingSpeed();
    std::vector<double> speeds{0.1, 0.4, 0.6, 0.65, 0.99 * sticks, 1.01 * sticks, 1.1 * sticks};
    const std::size_t rebounding = 4;
    const Particles pairs = pairsAt(speeds);
    Trial trial(stage, space(plastic(law.kc, 0), 1e-7), pairs);
    trial.advanceTo(3e-4);

    for (std::size_t i = 0; i < rebounding; ++i)
        stage.check(fmt::format("restitution at {:.2f} m/s", speeds[i]), "-",
                    std::sqrt(law.restitutionSquared(speeds[i])), partingSpeed(trial.now(), i) / speeds[i],
                    {5e-5, "time step of 1/300 of the shortest half period on k2, rounding", 1});
    std::vector<double> stuck(speeds.size(), 0);
    for (const Contact& c : trial.contacts()) stuck[c.particle / 2] += 1;
    for (std::size_t i = rebounding; i < speeds.size(); ++i)
        stage.check(fmt::format("sticks at {:.4f} m/s, {:.2f} of the limit", speeds[i], speeds[i] / sticks), "-",
                    speeds[i] > sticks ? 1 : 0, stuck[i], {0, "it does or it does not", 1});

    const std::size_t last = speeds.size() - 1;
    double low = kRadius, high = 0;
    while (trial.time() < 6e-4) {
        trial.advance(10);
        low = std::min(low, overlapOf(trial.now(), last));
        high = std::max(high, overlapOf(trial.now(), last));
    }
    const HeadOn::Swing swing = law.swing(speeds[last]);
    const Tolerance tolerance{3e-4, "looked at every microsecond, in units of the swing", swing.high - swing.low};
    stage.check("least overlap of the stuck pair", "m", swing.low, low, tolerance);
    stage.check("largest overlap of the stuck pair", "m", swing.high, high, tolerance);
    for (const Contact& c : trial.contacts())
        if (c.particle == 2 * last)
            stage.check("delta_max it remembers", "m", swing.remembered, c.maxOverlap, {1e-4, "time step"});
}

// With damping there is no closed form. The figures are those of the MercuryDPM kernel, another program (the same law,
// double precision, velocity Verlet with half-step velocities), for d = 2.5 mm, gamma = 0.0827 kg/s, dt = 1e-7 s.
void headOnDamped(Stage& stage) {
    struct Known {
        double kc, speed, restitution;
    };
    const std::vector<std::vector<Known>> tables{
        {{0, 0.05, 0.4220781761}, {0, 0.2, 0.3541910262}, {0, 1.0, 0.1578007475}},
        {{0.873, 0.05, 0.4202912628}, {0.873, 0.2, 0.325962277}}};
    for (const std::vector<Known>& table : tables) {
        std::vector<double> speeds;
        for (const Known& row : table) speeds.push_back(row.speed);
        Trial trial(stage, space(plastic(table[0].kc * kK2Max, 0.0827), 1e-7), pairsAt(speeds));
        trial.advanceTo(2e-4);
        for (std::size_t i = 0; i < table.size(); ++i)
            stage.check(fmt::format("restitution at {:.2f} m/s, k_c/k = {:.3f}", speeds[i], table[i].kc), "-",
                        table[i].restitution, partingSpeed(trial.now(), i) / speeds[i],
                        {1e-5, "both make the same steps; rounding", 1});
    }
}

namespace {

/// One sphere for every pair of normal and tangential speed, about to touch the floor, without gravity.
Particles thrownAtFloor(double normal, const std::vector<double>& tangential) {
    Particles p;
    for (std::size_t i = 0; i < tangential.size(); ++i)
        p.add(Vec3(0, kRadius, kFar * static_cast<double>(i)), kRadius, Vec3(tangential[i], -normal, 0));
    return p;
}

}  // namespace

// The sphere slips from first to last. The impulse of friction is then mu times that of the normal force: with theta
// from the normal e_t = 1 - mu (1 + e)/tan(theta), and the spin is 5/2 mu (1 + e) v_n/a^2 times the mean lever.
void obliqueSliding(Stage& stage) {
    const double normal = 0.05, mu = 0.2;
    ContactParameters p = plastic(0, 0);
    p.mu = mu;
    p.kt = 0.286 * kK2Max;
    const std::vector<double> tangential{normal * std::tan(75 * kPi / 180), normal * std::tan(85 * kPi / 180)};
    RuledWorld world = floor(p, 1e-7, 0);
    Trial trial(stage, world, thrownAtFloor(normal, tangential));
    trial.advanceTo(4e-4);

    // Loading on k1, unloading on k2 without adhesion: e^2 = k1/k2 at the depth v sqrt(m/k1).
    const double deepest = normal * std::sqrt(massOf(kRadius) / kK1);
    const double limit = kK2Max / (kK2Max - kK1) * kPlasticity * 2 * kRadius;
    const double e = std::sqrt(1 / (1 + (kK2Max / kK1 - 1) * deepest / limit));
    // The lever is a - delta/2; weighted with the force of a half sine, delta is pi/4 of its largest.
    const double lever = 1 - kPi / 8 * deepest / kRadius;
    for (std::size_t i = 0; i < tangential.size(); ++i) {
        const std::string angle = i == 0 ? "75" : "85";
        const Vec3 v = trial.now().velocity[i], w = trial.now().spin[i];
        const double lost = mu * (1 + e) * normal;
        stage.check("normal restitution at " + angle + " deg", "-", e, v.y / normal, {1e-5, "time step, rounding"});
        stage.check("tangential restitution at " + angle + " deg", "-", 1 - lost / tangential[i], v.x / tangential[i],
                    {1e-4, "time step, rounding, in units of the loss", lost / tangential[i]});
        stage.check("spin times radius at " + angle + " deg", "m/s", 2.5 * lost * lever, -w.z * kRadius,
                    {1e-4, "k2 is larger than k1 on the way out, so that the force is not quite a sine"});
    }
}

// The sphere never slips. Its surface speed follows the tangential spring, of stiffness k_t on 2/7 of the mass, for the
// half period of the normal spring: it comes back times cos(pi sqrt(7/2 k_t/k)).
void obliqueSticking(Stage& stage) {
    const double normal = 0.02, k = 5000, ratio = 0.5, tangential = 0.03;
    ContactParameters p = spring(k);
    p.mu = 1e6;
    p.kt = ratio * k;
    Trial trial(stage, floor(p, 1e-7, 0), thrownAtFloor(normal, {tangential}));
    trial.advanceTo(3e-4);
    const Vec3 v = trial.now().velocity[0], w = trial.now().spin[0];
    const double depth = normal * std::sqrt(massOf(kRadius) / k) / kRadius;
    const Tolerance tolerance{depth / 2, "the lever is a - delta/2: half the depth over the radius", tangential};
    const double factor = std::cos(kPi * std::sqrt(3.5 * ratio));
    stage.check("surface speed after", "m/s", factor * tangential, v.x + kRadius * w.z, tolerance);
    // Friction changes the velocity and the speed of the surface in the ratio 1 to 7/2.
    stage.check("speed after", "m/s", tangential * (1 - (1 - factor) / 3.5), v.x, tolerance);
}

}  // namespace vkdose::verify
