#pragma once
// Checks that two cases say the same.

#include <vector>

#include "host/model/case.h"
#include "tests/support/catch.h"

namespace vkdose::test {

inline void checkSameLaw(const ContactLaw& a, const ContactLaw& b) {
    CHECK(a.rollingLever == b.rollingLever);
    for (int i = 0; i < kContactClasses; ++i) {
        const ContactParameters& p = a.between(0, i);
        const ContactParameters& q = b.between(0, i);
        CHECK(p.coulombLimit == q.coulombLimit);
        CHECK(std::vector<double>{p.k1, p.k2Max, p.kc, p.plasticityDepth, p.gamma, p.kt, p.gammaT, p.mu, p.kr, p.gammaR,
                                  p.muR, p.kTo, p.gammaTo, p.muTo} ==
              std::vector<double>{q.k1, q.k2Max, q.kc, q.plasticityDepth, q.gamma, q.kt, q.gammaT, q.mu, q.kr, q.gammaR,
                                  q.muR, q.kTo, q.gammaTo, q.muTo});
    }
}

/// Everything but `resolved`, to the last bit.
inline void checkSame(const Case& a, const Case& b) {
    CHECK(a.name == b.name);
    CHECK(a.reason == b.reason);
    CHECK(a.seed == b.seed);
    checkSameLaw(a.dosingLaw, b.dosingLaw);
    checkSameLaw(a.settlingLaw, b.settlingLaw);
    CHECK(a.world.walls.size() == b.world.walls.size());
    CHECK(a.world.gravity == b.world.gravity);
    CHECK(a.world.density() == b.world.density());
    CHECK(a.world.coilSurfaceMoves == b.world.coilSurfaceMoves);
    CHECK(a.world.coilWireCurved == b.world.coilWireCurved);
    CHECK(a.world.timeStep == b.world.timeStep);
    CHECK(a.world.skin == b.world.skin);
    CHECK(a.world.domain.low == b.world.domain.low);
    CHECK(a.world.domain.high == b.world.domain.high);
    CHECK(a.world.throatZ == b.world.throatZ);
    CHECK(a.world.outletZ == b.world.outletZ);
    REQUIRE(a.world.coil.has_value() == b.world.coil.has_value());
    if (a.world.coil) {
        CHECK(a.world.coil->radius == b.world.coil->radius);
        CHECK(a.world.coil->pitch == b.world.coil->pitch);
        CHECK(a.world.coil->wireRadius == b.world.coil->wireRadius);
        CHECK(a.world.coil->length == b.world.coil->length);
        CHECK(a.world.coil->hand == b.world.coil->hand);
    }
    CHECK(a.schedule.settleTime == b.schedule.settleTime);
    CHECK(a.schedule.rotateTime == b.schedule.rotateTime);
    CHECK(a.schedule.restTime == b.schedule.restTime);
    CHECK(a.schedule.coilSpeed == b.schedule.coilSpeed);
    CHECK(a.schedule.stop.kind == b.schedule.stop.kind);
    CHECK(a.schedule.stop.threshold == b.schedule.stop.threshold);
    CHECK(a.schedule.stop.doses == b.schedule.stop.doses);
    CHECK(a.schedule.stop.maxDoses == b.schedule.stop.maxDoses);
    CHECK(a.schedule.stop.endTime == b.schedule.stop.endTime);
    CHECK(a.sensorInterval == b.sensorInterval);
    CHECK(a.bulkDensity == b.bulkDensity);
    const Insertion x = insertParticles(a);
    const Insertion y = insertParticles(b);
    CHECK(x.particles.position == y.particles.position);
    CHECK(x.particles.radius == y.particles.radius);
    CHECK(x.particles.velocity == y.particles.velocity);
}

}  // namespace vkdose::test
