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

}  // namespace vkdose
