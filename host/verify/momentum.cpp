// Contacts change neither the momentum nor the angular momentum of particles left to themselves.

#include <algorithm>

#include "host/core/random.h"
#include "host/verify/cases.h"
#include "host/verify/setups.h"

namespace vkdose::verify {

namespace {

struct Momentum {
    Vec3 linear{0}, angular{0};
    double linearSize = 0, angularSize = 0;  ///< sums of the terms' lengths

    explicit Momentum(const Particles& p) {
        for (std::size_t i = 0; i < p.size(); ++i) {
            const Vec3 mv = massOf(p.radius[i]) * p.velocity[i], iw = inertiaOf(p.radius[i]) * p.spin[i];
            linear += mv;
            angular += glm::cross(p.position[i], mv) + iw;
            linearSize += glm::length(mv);
            angularSize += glm::length(p.position[i]) * glm::length(mv) + glm::length(iw);
        }
    }
};

}  // namespace

ContactParameters everyInteraction() {
    ContactParameters p;
    p.k1 = kK1;
    p.k2Max = kK2Max;
    p.kc = 0.873 * kK2Max;
    p.plasticityDepth = kPlasticity / 10;  // small, so that spheres that collide at these speeds stick
    p.gamma = 0.0827;
    p.mu = p.muR = 0.5;
    p.muTo = 0.2;
    p.kt = p.kr = p.kTo = 0.286 * kK2Max;
    p.gammaT = p.gammaR = p.gammaTo = 0.286 * p.gamma;
    return p;
}

Particles collapsingCluster() {
    // A grid with jitter, thrown at its middle, so that all collide within a few milliseconds.
    Particles cluster;
    std::uint64_t draw = 0;
    const auto random = [&] { return uniforms(7, Stream::Jitter, draw++)[0]; };
    const int side = 3;
    for (int i = 0; i < side * side * side + 4; ++i) {
        const Vec3 site(i % side - 1, i / side % side - 1, i / (side * side) - 1);
        const double radius = static_cast<double>(static_cast<float>(kRadius * (0.7 + 0.6 * random())));
        const Vec3 jitter = 0.05 * kRadius * (Vec3(random(), random(), random()) - 0.5);
        const Vec3 x = 2.7 * kRadius * site + jitter;
        const Vec3 v = -60.0 * x + 0.02 * (Vec3(random(), random(), random()) - 0.5);
        cluster.add(x, radius, v, 20.0 * (Vec3(random(), random(), random()) - 0.5));
    }
    return cluster;
}

// The leapfrog conserves both exactly: x(n) x v(n-1/2) changes only by the torques of the contacts about the origin,
// and both sides of a pair act at the same point. Only rounding is left. Both backends are given radii that single
// precision holds, so that masses agree.
void isolatedCluster(Stage& stage) {
    const Particles cluster = collapsingCluster();
    RuledWorld world = space(everyInteraction(), 1e-6);
    const Momentum before(cluster);
    Trial trial(stage, world, cluster);
    std::size_t most = 0;
    for (int i = 0; i < 80; ++i) {
        trial.advance(250);
        most = std::max(most, trial.contacts().size());
    }
    const Momentum after(trial.now());
    // Checks that there were contacts. Without them the case would be about spheres that fly past each other.
    stage.plausible("most contacts at once, for each sphere", "-", 1,
                    static_cast<double>(most) / static_cast<double>(cluster.size()),
                    {0.5, "how many there are depends on the tumble; so many that it is one"});
    const Tolerance tolerance{5e-7, "rounding in single precision over 20000 steps, in units of the sum of |m v|",
                              before.linearSize};
    stage.check("drift of the momentum", "kg m/s", 0, glm::length(after.linear - before.linear), tolerance);
    stage.check("drift of the angular momentum", "kg m2/s", 0, glm::length(after.angular - before.angular),
                {tolerance.share, "the same, in units of the sum of |x||m v| + I|omega|", before.angularSize});
}

}  // namespace vkdose::verify
