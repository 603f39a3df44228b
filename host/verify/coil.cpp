// The turning coil: the wall that moves.

#include <fmt/format.h>

#include <algorithm>

#include "host/core/worse.h"
#include "host/verify/cases.h"
#include "host/verify/setups.h"

namespace vkdose::verify {

namespace {

/// The paper's narrow coil; right-handed, so that it conveys towards +z when it turns clockwise seen from +z.
geometry::Coil narrowCoil() {
    return {.radius = 0.0104, .pitch = 0.00875, .wireRadius = 0.001, .length = 0.07};
}

constexpr double kTrough = 0.0115;  // half width [m]

}  // namespace

// The wire passes spheres at rest by a hundredth of a radius, and one sphere lies on the axis. There must be no torque
// and no motion at all.
void emptyCanister(Stage& stage) {
    RuledWorld world = space(spring(1000), 1e-5);
    const geometry::Coil coil = narrowCoil();
    world.coil = coil;
    const double clear = coil.radius + coil.wireRadius + 1.01 * kRadius;  // from the axis
    Particles spheres;
    spheres.add(Vec3(0, 0, coil.length / 2), kRadius);
    for (int i = 0; i < 7; ++i) {
        const double angle = 2 * kPi * i / 7;
        spheres.add(Vec3(clear * std::cos(angle), clear * std::sin(angle), coil.length * (0.1 + 0.13 * i)), kRadius);
    }
    Trial trial(stage, world, spheres);
    const double dt = world.timeStep, rate = -50;
    const int steps = 12600;  // a turn: the wire passes every one of them
    const Sensors sensors = trial.advance(steps, rate);
    stage.check("torque", "N m", 0, sensors.coilTorque, {0, "there is nothing to turn against", 1});
    stage.check("energy of the spheres that it passes", "J", 0, sensors.kineticEnergy + sensors.rotationalEnergy,
                {0, "nothing touches them", 1});
    stage.check("angle turned", "rad", rate * steps * dt, stage.backend().coilAngle(), {1e-6, "rounding"});
}

namespace {

/// A sphere pressed against the wire, and the figures of the contact that are known by construction.
struct Pressed {
    Vec3 centre;      ///< [m]
    Vec3 normal;      ///< from the wire's centre line to the sphere
    Vec3 point;       ///< of the contact, a - depth/2 from the centre [m]
    Vec3 tangential;  ///< velocity of the wire there, without its normal part [m/s]
};

/// Spheres pressed by `depth` against the wire at places all along and around it, no two touching.
std::vector<Pressed> aroundWire(const geometry::Coil& coil, double depth, double rate) {
    std::vector<Pressed> all;
    for (int i = 0; i < 7; ++i) {
        const double s = coil.length * (0.1 + 0.13 * i), psi = coil.hand * 2 * kPi * s / coil.pitch;
        const Vec3 radial(std::cos(psi), std::sin(psi), 0), round(-std::sin(psi), std::cos(psi), 0);
        const Vec3 along = glm::normalize(coil.hand * coil.radius * round + Vec3(0, 0, coil.pitch / (2 * kPi)));
        // Places range from straight outwards up to 67 degrees to either side: further in, another turn may be nearer.
        const double around = (i - 3) * kPi / 8;
        Pressed p{};
        p.normal = std::cos(around) * radial + std::sin(around) * glm::cross(along, radial);
        p.centre = coil.radius * radial + Vec3(0, 0, s) + (kRadius + coil.wireRadius - depth) * p.normal;
        p.point = p.centre - (kRadius - depth / 2) * p.normal;
        const Vec3 wall = glm::cross(Vec3(0, 0, rate), p.point);
        p.tangential = wall - glm::dot(wall, p.normal) * p.normal;
        all.push_back(p);
    }
    return all;
}

}  // namespace

// A sphere at rest is pressed against the wire. In the first step all springs are at rest, so friction is the smaller
// of mu F_n and gamma_t v_t. It points along the velocity of the wire's surface Omega x r, and acts back on the drive.
void pressedAgainstWire(Stage& stage) {
    const geometry::Coil coil = narrowCoil();
    const double k = 5000, depth = 0.01 * kRadius, rate = -9.42, mu = 0.2, dt = 1e-6, m = massOf(kRadius);
    const double normal = k * depth;
    for (const bool slips : {true, false}) {
        ContactParameters p = spring(k);
        p.mu = slips ? mu : 1e3;
        p.gammaT = slips ? 1e4 : 0.05;
        RuledWorld world = space(p, dt);
        world.coil = coil;
        const std::vector<Pressed> pressed = aroundWire(coil, depth, rate);
        Particles start;
        for (const Pressed& c : pressed) start.add(c.centre, kRadius);
        Trial trial(stage, world, start);
        const Sensors sensors = trial.advance(1, rate);

        double worstForce = 0, worstDirection = 0, torque = 0, size = 0;
        for (std::size_t i = 0; i < start.size(); ++i) {
            const Pressed& c = pressed[i];
            const double speed = glm::length(c.tangential);
            const double friction = slips ? mu * normal : p.gammaT * speed;
            // The opening kick is half a step.
            const Vec3 force = trial.now().velocity[i] * (m / (dt / 2));
            const Vec3 tangential = force - glm::dot(force, c.normal) * c.normal;
            worstForce = worse(worstForce, std::abs(glm::length(tangential) / friction - 1));
            worstDirection =
                worse(worstDirection, glm::length(tangential / glm::length(tangential) - c.tangential / speed));
            const Vec3 onSphere = normal * c.normal + friction * c.tangential / speed;
            torque -= glm::cross(c.point, onSphere).z;
            size += std::abs(glm::cross(c.point, onSphere).z);
        }
        // Overlap 12.5 um, and the phase of the wire in single precision: 3e-9 m.
        const Tolerance tolerance{5e-4, "phase of the wire in single precision: 3e-9 m of an overlap of 12.5e-6 m", 1};
        const std::string kind = slips ? "mu F_n" : "gamma_t v_t";
        stage.check(fmt::format("friction over {}, worst of {} - 1", kind, start.size()), "-", 0, worstForce,
                    tolerance);
        stage.check("direction off the wire's velocity, worst", "rad", 0, worstDirection, tolerance);
        stage.check("torque on the coil, friction " + kind, "N m", torque, sensors.coilTorque,
                    {tolerance.share, tolerance.reason, size});
    }
}

// The coil conveys uphill, so that the sphere stays at the wire that pushes it. The sphere advances one pitch a turn,
// V_z = p Omega/2 pi. Without friction the drive works against gravity alone: torque = m g_z p/2 pi.
void pushedAlongTrough(Stage& stage) {
    const geometry::Coil coil = narrowCoil();
    const double slope = 20 * kPi / 180, rate = geometry::conveyingRate(coil, 4 * kPi);
    for (const double mu : {0.0, 0.3}) {
        ContactParameters p = spring(200, 0.05);
        p.mu = mu;
        p.kt = 60;
        p.gammaT = 0.003;
        RuledWorld world = space(p, 8e-5);
        world.gravity = kGravity * Vec3(0, -std::cos(slope), -std::sin(slope));
        world.coil = coil;
        world.walls = {geometry::Trough{kTrough}};
        Particles one;  // at the bottom, before the wire that passes it there
        one.add(Vec3(0, -(kTrough - kRadius), 0.75 * coil.pitch + 1.05 * (kRadius + coil.wireRadius)), kRadius);
        Trial trial(stage, world, one);
        const double turn = 2 * kPi / std::abs(rate);
        trial.advanceTo(turn, rate);
        const double from = trial.now().position[0].z, since = trial.time();
        const Sensors sensors = trial.advanceTo(5 * turn, rate);
        const std::string kind = mu > 0 ? ", rough" : ", smooth";
        stage.check("mean v_z over 4 turns" + kind, "m/s", coil.pitch * std::abs(rate) / (2 * kPi),
                    (trial.now().position[0].z - from) / (trial.time() - since),
                    {5e-3, "the sphere sways at the bottom, by a fiftieth of the four pitches"});
        if (mu == 0)
            stage.check("mean torque on the coil" + kind, "N m",
                        massOf(kRadius) * kGravity * std::sin(slope) * coil.pitch / (2 * kPi), sensors.coilTorque,
                        {3e-3, "the sphere sways"});
    }
}

}  // namespace vkdose::verify
