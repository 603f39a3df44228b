// A domain that repeats: what goes through its end goes on as it was.

#include <cmath>

#include "geometry/coil.h"
#include "host/core/random.h"
#include "host/verify/cases.h"
#include "host/verify/setups.h"

namespace vkdose::verify {

namespace {

void repeat(RuledWorld& world, int d, double low, double high) {
    world.domain.low[d] = low;
    world.domain.high[d] = high;
    world.period[d] = high - low;
}

/// Of particle i along axis `d`.
double wayOf(const RuledWorld& world, const Particles& p, std::size_t i, int d) {
    return unfolded(world, p, i)[d];
}

}  // namespace

// Two spheres meet across the end while both go through it. A damped spring leaves the share
// exp(-pi zeta/sqrt(1 - zeta^2)) of their relative speed, with zeta = gamma/(2 sqrt(k mu)).
void periodRebound(Stage& stage) {
    const double k = 500, gamma = 0.03, speed = 0.5, drift = 2, dt = 1e-6, length = 10 * kRadius;
    const double reduced = massOf(kRadius) / 2, zeta = gamma / (2 * std::sqrt(k * reduced));
    for (int d = 0; d < 3; ++d) {
        RuledWorld world = space(spring(k, gamma), dt);
        repeat(world, d, -length / 2, length / 2);
        Vec3 along(0);
        along[d] = 1;
        // They touch after 1 ms, when the first is at the end; the second is ahead of it, at the other end.
        const double start = length / 2 - (drift + speed / 2) * 1e-3;
        Particles p;
        p.add(start * along, kRadius, (drift + speed / 2) * along);
        p.add((start + 2 * kRadius + speed * 1e-3 - length) * along, kRadius, (drift - speed / 2) * along);
        Trial trial(stage, world, p);
        trial.advance(1800);  // they part after 1340 of them
        const char* const axis = d == 0 ? "x" : d == 1 ? "y" : "z";
        const Particles& now = trial.now();
        stage.check(std::string("restitution along ") + axis, "-", std::exp(-kPi * zeta / std::sqrt(1 - zeta * zeta)),
                    (now.velocity[1] - now.velocity[0])[d] / speed,
                    {5e-3, "damping is first order in the time step: gamma dt/2m = 2.6e-3"});
        stage.check(std::string("mean speed along ") + axis, "m/s", drift, (now.velocity[0] + now.velocity[1])[d] / 2,
                    {1e-6, "rounding"});
        const double middle = (wayOf(world, now, 0, d) + wayOf(world, now, 1, d) + length) / 2;
        const double from = start + kRadius + speed * 1e-3 / 2;
        stage.check(std::string("way of both along ") + axis, "m", drift * trial.time(), middle - from,
                    {1e-5, "rounding"});
    }
}

// A cluster in a box whose ends along two directions are joined, under every interaction: its momentum stays.
void periodMomentum(Stage& stage) {
    Particles cluster;
    std::uint64_t draw = 0;
    const auto random = [&] { return uniforms(11, Stream::Jitter, draw++)[0]; };
    const double length = 10 * kRadius;
    double scale = 0;
    Vec3 before(0);
    for (int i = 0; i < 64; ++i) {
        const double radius = double(float(kRadius * (0.8 + 0.3 * random())));
        cluster.add(2.5 * kRadius * (Vec3(i % 4, i / 4 % 4, i / 16) - 1.5), radius,
                    2.0 * (Vec3(random(), random(), random()) - 0.5),
                    50.0 * (Vec3(random(), random(), random()) - 0.5));
        before += massOf(radius) * cluster.velocity.back();
        scale += massOf(radius) * glm::length(cluster.velocity.back());
    }
    RuledWorld world = space(everyInteraction(), 2e-6);
    repeat(world, 0, -length / 2, length / 2);
    repeat(world, 2, -length / 2, length / 2);
    Trial trial(stage, world, cluster);
    std::size_t across = 0;
    for (int i = 0; i < 20; ++i) {
        trial.advance(250);
        const Particles& now = trial.now();
        std::size_t here = 0;
        for (const Contact& c : trial.contacts())
            here += glm::length(now.position[c.particle] - now.position[c.other]) > length / 2 ? 1 : 0;
        across = std::max(across, here);
    }
    Vec3 after(0);
    for (std::size_t i = 0; i < cluster.size(); ++i) after += massOf(cluster.radius[i]) * trial.now().velocity[i];
    stage.plausible("most contacts across the ends at once", "-", 10, double(across),
                    {0.8, "how many there are depends on the tumble"});
    stage.check("drift of the momentum", "kg m/s", 0, glm::length(after - before),
                {5e-7, "rounding in single precision over 5000 steps, in units of the sum of |m v|", scale});
}

// A sphere rolls down an endless slope: it gains 5/7 g sin(tilt), however often it goes through the end, and what has
// gone through is its mass by the whole periods of its way.
void periodIncline(Stage& stage) {
    const double tilt = kPi / 6, dt = 2e-5, k = 500, length = 8 * kRadius;
    ContactParameters p = spring(k, 0.02);
    p.mu = 2;
    p.kt = 0.5 * k;
    p.gammaT = 0.01;
    RuledWorld world = floor(p, dt, kGravity, tilt);
    world.energyBook = true;
    repeat(world, 0, -length / 4, 0.75 * length);
    Particles one;
    one.add(Vec3(0, kRadius + massOf(kRadius) * world.gravity.y / k, 0), kRadius);
    Trial trial(stage, world, one);
    const Sensors sensors = trial.advance(7500);
    const double gained = 5.0 / 7 * kGravity * std::sin(tilt), way = gained * trial.time() * trial.time() / 2;
    stage.check("speed", "m/s", gained * trial.halfStep(), trial.now().velocity[0].x,
                {1e-3, "oscillation on the spring's stretch, lever a - delta/2"});
    stage.check("way", "m", way, wayOf(world, trial.now(), 0, 0), {1e-3, "the same"});
    stage.check("mass that has gone through", "kg", massOf(kRadius) * std::floor(way / length + 0.25),
                sensors.through[0], {1e-6, "single precision of a device's sums"});
    stage.check("residual of the ledger", "J", 0, trial.energy().residual(),
                {1e-4, "rounding, in units of the energy that it has gained", massOf(kRadius) * kGravity * way / 2});
}

// One turn of a screw that repeats pushes a sphere uphill as the long one does (bodies/pushed-sphere): one pitch a
// turn, for a torque of m g_z p/2 pi.
void periodScrew(Stage& stage) {
    const double trough = 0.0115, slope = 20 * kPi / 180, pitch = 0.00875;
    const geometry::Coil coil{.radius = 0.0104, .pitch = pitch, .wireRadius = 0.001, .length = 3 * pitch};
    const geometry::Flight blade{3e-3, 11e-3, 1e-3, pitch, pitch, 6 * kPi, -pitch, 0, 1};
    RuledWorld world = space(spring(200, 0.05), 8e-5);
    world.gravity = kGravity * Vec3(0, -std::cos(slope), -std::sin(slope));
    world.walls = {geometry::Trough{trough}};
    world.bodies = {bodyOf({blade}, geometry::Turn{Vec3(0, 0, 1), Vec3(0), 1})};
    world.bodies[0].clock = Clock::Drive;
    repeat(world, 2, 0, pitch);
    Particles one;  // at the bottom, before the blade that passes it there
    one.add(Vec3(0, -(trough - kRadius), 0.75 * pitch + 1.05 * (kRadius + coil.wireRadius) - pitch * 0.9), kRadius);
    Trial trial(stage, world, one);
    const double rate = geometry::conveyingRate(coil, 4 * kPi), turn = 2 * kPi / std::abs(rate);
    trial.advanceTo(turn, rate);
    const double from = wayOf(world, trial.now(), 0, 2), since = trial.time();
    const Sensors sensors = trial.advanceTo(3 * turn, rate);
    stage.check("mean v_z over 2 turns", "m/s", pitch * std::abs(rate) / (2 * kPi),
                (wayOf(world, trial.now(), 0, 2) - from) / (trial.time() - since),
                {1e-2, "the sphere sways at the bottom, by a fiftieth of the two pitches"});
    stage.check("mean torque", "N m", massOf(kRadius) * kGravity * std::sin(slope) * pitch / (2 * kPi),
                sensors.bodies.at(0).torque, {3e-3, "the sphere sways"});
}

}  // namespace vkdose::verify
