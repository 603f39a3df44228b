#pragma once
// The energy ledger: what was loaded and what the coil did is still there, was lost in a known way, or has left.

#include "host/backend/backend.h"

namespace vkdose {

/// Plain, so that it can be saved: all of it is `sum`, the books of all calls since load in one. Instantaneous
/// energies are those of the last call, losses and works of all of them [J].
struct EnergyLedger {
    EnergyBook sum;

    /// Joins the book of the next call.
    void add(const EnergyBook& call);

    double elastic() const;  ///< in all springs [J]
    double present() const;  ///< motion, potential and elastic energy [J]
    double losses() const;   ///< of all kinds, the time step's own included [J]
    /// loaded + coil work - losses - left - present [J]: zero but for rounding if everything was booked.
    double residual() const;
};

}  // namespace vkdose
