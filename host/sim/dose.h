#pragma once
// A dose: one turning of the coil, forth and perhaps back, and the rest after it.

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>
#include <vector>

#include "host/core/columns.h"
#include "host/sim/body_loads.h"
#include "host/sim/powder_book.h"
#include "host/sim/region_count.h"

namespace vkdose {

/// What told the coil to stop.
enum class StopCause { None, Time, Mass, Torque, Order };
template <>
struct Words<StopCause> {
    static constexpr std::array<const char*, 5> kNames{"none", "time", "mass", "torque", "order"};
};

/// An order to the drive that is not in the case.
struct DriveOrder {
    bool stop = false;
    std::optional<double> speed;  ///< conveying, to change to [rad/s]
};

/// The word of an order in tables and events.
constexpr const char* orderWord(const DriveOrder& order) {
    return order.stop ? "stop" : "speed";
}

/// One that the drive has obeyed.
struct GivenOrder {
    std::uint64_t step = 0;  ///< made before
    double time = 0;         ///< [s]
    DriveOrder order;
};

struct Dose {
    int index = 0;         ///< 1 for the first
    double startTime = 0;  ///< [s]
    double mass = 0;       ///< dosed from the start of its rotation to the end of its rest [kg]
    std::uint64_t particles = 0;
    double cumulative = 0;  ///< dosed since the start of the run [kg]
    double coilTorque = 0;  ///< drive torque, mean over its rotation [N m]
    /// rho_b p pi r_c^2 n_t [kg]; NaN where there is none.
    double closedForm = std::numeric_limits<double>::quiet_NaN();
    bool complete = false;  ///< false if the run ended within it: then it is in no statistics
    double target = 0;      ///< [kg]; 0: it is a dose by time
    double stopMass = std::numeric_limits<double>::quiet_NaN();  ///< dosed when the coil was told to stop [kg]
    double rotation = std::numeric_limits<double>::quiet_NaN();  ///< from its start until then [s]
    StopCause stoppedBy = StopCause::None;
    double endTime = std::numeric_limits<double>::quiet_NaN();  ///< [s]

    std::vector<RegionCount> regions;  ///< into each of the world's regions; not kept in a checkpoint
    std::vector<BodySample> bodies;    ///< of each of allBodies, as kDoseBodyColumns tell
    std::vector<PowderDose> powders;   ///< of each powder; empty with a single one; not kept in a checkpoint

    double overshoot() const { return mass - stopMass; }  ///< dosed after the coil was told to stop [kg]
};

inline constexpr auto kDoseColumns = columns(
    column<&Dose::index>("dose", "1", "Number of the dose, from 1."),
    column<&Dose::startTime>("start_time_s", "s", "Simulated time at which its rotation began."),
    column<&Dose::mass>("mass_kg", "kg", "Mass dosed from the start of its rotation to the end of its rest."),
    column<&Dose::cumulative>("cumulative_mass_kg", "kg", "Mass dosed since the start of the run."),
    column<&Dose::particles>("particles", "1", "Number of particles that the mass of the dose is made of."),
    column<&Dose::coilTorque>("coil_torque_Nm", "N m",
                              "Torque of the drive, mean over the rotation; positive when the powder resists."),
    emptyIfNaN(column<&Dose::closedForm>(
        "closed_form_mass_kg", "kg",
        "Mass per dose by the closed form: bulk density times the volume that the coil sweeps. Empty without one.")),
    column<&Dose::complete>("complete", "1", "1; 0 if the run ended within the dose, which is in no statistics then."),
    column<&Dose::target>("target_mass_kg", "kg", "Mass that the dose was to have; 0 in a dose by time."),
    column<&Dose::stopMass>("stop_mass_kg", "kg", "Mass dosed from its start until the coil was told to stop."),
    column<&Dose::overshoot>("overshoot_kg", "kg",
                             "Mass dosed after the coil was told to stop, to the end of the dose's rest."),
    column<&Dose::rotation>("rotation_s", "s", "Time from its start until the coil was told to stop."),
    column<&Dose::stoppedBy>("stopped_by", "",
                             "What told the coil to stop: time, mass, torque or order; none if the run ended "
                             "before."),
    column<&Dose::endTime>("end_time_s", "s", "Simulated time at which the dose ended."));

struct DoseStatistics {
    int doses = 0;         ///< complete ones
    double mean = 0;       ///< [kg]
    double deviation = 0;  ///< sample standard deviation (n - 1) [kg]; 0 for fewer than two doses
    double relative = 0;   ///< deviation / mean [-]; 0 if nothing was dosed
};
DoseStatistics statistics(const std::vector<Dose>& doses);

}  // namespace vkdose
