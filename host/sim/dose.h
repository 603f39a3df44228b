#pragma once
// A dose: one turning of the coil and the rest after it.

#include <cstdint>
#include <vector>

#include "host/core/columns.h"

namespace vkdose {

struct Dose {
    int index = 0;         ///< 1 for the first
    double startTime = 0;  ///< [s]
    double mass = 0;       ///< dosed from the start of its rotation to the end of its rest [kg]
    std::uint64_t particles = 0;
    double cumulative = 0;  ///< dosed since the start of the run [kg]
    double coilTorque = 0;  ///< drive torque, mean over its rotation [N m]
    double closedForm = 0;  ///< rho_b p pi r_c^2 n_t [kg]; 0 without a coil
    bool complete = false;  ///< false if the run ended within it: then it is in no statistics
};

inline constexpr auto kDoseColumns = columns(
    column<&Dose::index>("dose", "1", "Number of the dose, from 1."),
    column<&Dose::startTime>("start_time_s", "s", "Simulated time at which its rotation began."),
    column<&Dose::mass>("mass_kg", "kg", "Mass dosed from the start of its rotation to the end of its rest."),
    column<&Dose::cumulative>("cumulative_mass_kg", "kg", "Mass dosed since the start of the run."),
    column<&Dose::particles>("particles", "1", "Number of particles that the mass of the dose is made of."),
    column<&Dose::coilTorque>("coil_torque_Nm", "N m",
                              "Torque of the drive, mean over the rotation; positive when the powder resists."),
    column<&Dose::closedForm>("closed_form_mass_kg", "kg",
                              "Mass per dose by the closed form: bulk density times the volume that the coil sweeps."),
    column<&Dose::complete>("complete", "1", "1; 0 if the run ended within the dose, which is in no statistics then."));

struct DoseStatistics {
    int doses = 0;         ///< complete ones
    double mean = 0;       ///< [kg]
    double deviation = 0;  ///< sample standard deviation (n - 1) [kg]; 0 for fewer than two doses
    double relative = 0;   ///< deviation / mean [-]; 0 if nothing was dosed
};
DoseStatistics statistics(const std::vector<Dose>& doses);

}  // namespace vkdose
