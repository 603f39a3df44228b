// The fewest time steps in a contact that a case may ask for keep a crystal of equal spheres stable, in which every
// sphere has twelve contacts and the fastest motion is twice as fast as that of a pair; much fewer do not.

#include <cmath>
#include <random>

#include "host/model/stability.h"
#include "tests/law/setups.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr int kCells = 3;

/// Linear springs in every direction with the ratios of the paper, and sliders that never slip.
ContactParameters sticking(double gamma) {
    ContactParameters p = spring(24067);
    p.gamma = gamma;
    p.kt = p.kr = 0.286 * p.k1;
    p.gammaT = p.gammaR = 0.286 * gamma;
    p.mu = p.muR = 1e6;
    return p;
}

/// A face-centred cubic block in a box that presses it together by a thousandth of a radius.
RuledWorld boxed(double gamma, double timeStep) {
    RuledWorld world = freeWorld(sticking(gamma), timeStep);
    const double edge = std::sqrt(2.0) * kRadius, pressed = 1e-3 * kRadius;
    const double low = -kRadius + pressed, high = 2 * kCells * edge + kRadius - pressed;
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 normal(0), far(0);
        normal[axis] = 1;
        far[axis] = high;
        world.walls.push_back(geometry::Plane{low * normal, normal});
        world.walls.push_back(geometry::Plane{far, -normal});
    }
    return world;
}

Particles crystal() {
    Particles p;
    const double edge = std::sqrt(2.0) * kRadius;
    for (int x = 0; x <= 2 * kCells; ++x)
        for (int y = 0; y <= 2 * kCells; ++y)
            for (int z = 0; z <= 2 * kCells; ++z)
                if ((x + y + z) % 2 == 0) p.add(edge * Vec3(x, y, z), kRadius);
    return p;
}

/// Energy of motion after 4000 steps over that at the start, from small random velocities and spins.
double growth(double stepsPerContact) {
    auto backend = makeReferenceBackend();
    backend->load(boxed(0.05, 5e-7), crystal());
    backend->advance(4000, 0);
    Particles p = backend->particles();

    RuledWorld world = boxed(0, 1);
    const auto modes = contactModes(world, world.law, {{kRadius, kRadius, kRadius}});
    world.timeStep = automaticTimeStep(modes, stepsPerContact);
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto any = [&]() { return Vec3(unit(random), unit(random), unit(random)); };
    // Ways of some tenth of the overlap, so that no contact opens; the energy of motion is then far above the little
    // that the block sets free because its springs of sliding and rolling start anew.
    const double speed = 5e-3;
    for (std::size_t i = 0; i < p.size(); ++i) {
        p.velocity[i] = speed * any();
        p.spin[i] = speed / kRadius * any();
    }
    backend->load(world, p);
    const auto motion = [](const Sensors& s) { return s.kineticEnergy + s.rotationalEnergy; };
    const double start = motion(backend->advance(1, 0));
    double most = 0;
    for (int n = 0; n < 800; ++n) {
        const double now = motion(backend->advance(5, 0));
        most = std::max(most, now / start);
        if (most > 100) break;  // and growing: before it bursts the box
    }
    return most;
}

}  // namespace

TEST_CASE("time step: a crystal stays as it is with the fewest steps in a contact that a case may ask for") {
    // Energies at half steps swing by up to 1/(1 - (omega dt/2)^2), 2.6 at omega dt = pi/2, if all went into one
    // motion.
    CHECK(growth(kFewestSteps) < 2.6);
    CHECK(growth(2.5) > 100);
}
