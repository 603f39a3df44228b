#include "host/sim/energy_ledger.h"

namespace vkdose {

void EnergyLedger::add(const EnergyBook& call) {
    const EnergyBook before = sum;
    sum = call;
    for (double EnergyBook::*flow :
         {&EnergyBook::plastic, &EnergyBook::adhesive, &EnergyBook::viscous, &EnergyBook::sliding, &EnergyBook::rolling,
          &EnergyBook::torsion, &EnergyBook::numerical, &EnergyBook::coilWork, &EnergyBook::left, &EnergyBook::loaded})
        sum.*flow += before.*flow;
}

double EnergyLedger::elastic() const {
    return sum.elasticNormal + sum.elasticSliding + sum.elasticRolling + sum.elasticTorsion;
}

double EnergyLedger::present() const {
    return sum.kinetic + sum.rotational + sum.potential + elastic();
}

double EnergyLedger::losses() const {
    return sum.plastic + sum.adhesive + sum.viscous + sum.sliding + sum.rolling + sum.torsion + sum.numerical;
}

double EnergyLedger::residual() const {
    return sum.loaded + sum.coilWork - losses() - sum.left - present();
}

}  // namespace vkdose
