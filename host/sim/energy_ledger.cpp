#include "host/sim/energy_ledger.h"

namespace vkdose {

void EnergyLedger::add(const EnergyBook& call) {
    const EnergyBook before = sum;
    sum = call;
    forEachColumn(kFlowColumns, [&](const auto& c) { c.of(sum) += c.of(before); });
}

double EnergyLedger::elastic() const {
    return sumOf(kElasticColumns, sum);
}

double EnergyLedger::present() const {
    return sum.kinetic + sum.rotational + sum.potential + elastic();
}

double EnergyLedger::losses() const {
    return sumOf(kLossColumns, sum);
}

double EnergyLedger::residual() const {
    return sum.loaded + sum.coilWork + sum.bodyWork - losses() - sum.left - present();
}

double energyOfGravityChange(const World& world, const Particles& particles, const Vec3& from, const Vec3& to) {
    double sum = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (particles.status[i] != Status::Active) continue;
        const Vec3 middle = unfolded(world, particles, i) - 0.5 * world.timeStep * particles.velocity[i];
        sum -= massOf(world, particles, i) * glm::dot(to - from, middle);
    }
    return sum;
}

}  // namespace vkdose
