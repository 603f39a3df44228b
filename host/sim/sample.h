#pragma once
// A sample: one line of the time series.

#include <cstdint>
#include <optional>
#include <tuple>

#include "host/backend/backend.h"
#include "host/core/columns.h"
#include "host/sim/body_loads.h"
#include "host/sim/energy_ledger.h"
#include "host/sim/powder_book.h"
#include "host/sim/region_count.h"
#include "host/sim/timeline.h"

namespace vkdose {

/// One line of the time series, at a multiple of the sensor interval or at the end of a phase. Torque and power are
/// means, the overlap is the largest since the sample before; everything else is the value at `time`.
struct Sample {
    std::uint64_t step = 0;
    double time = 0;  ///< [s]
    Phase phase = Phase::Settle;
    int dose = 0;                        ///< 0 while settling
    double coilAngle = 0;                ///< of Backend::coilAngle: rotation about +z since the start [rad]
    Sensors sensors;                     ///< coilTorque: about +z, on the coil, mean since the last sample [N m]
    double outletVelocity = 0;           ///< mean v_z of the mass in the throat [m/s]; NaN while it is empty
    double coilTorque = 0;               ///< the drive's: positive when the powder resists conveying [N m]
    double coilPower = 0;                ///< drive torque times speed [W]
    std::optional<EnergyLedger> energy;  ///< if the case asks for it
    std::vector<BodySample> bodies;      ///< of allBodies, in their order
    std::vector<FreePlace> free;         ///< of those that move freely
    std::vector<RegionSample> regions;   ///< of the world's regions likewise
    std::vector<PowderPlaces> powders;   ///< of each powder; empty with a single one
};

// The columns of the sensors, by regions in the order of Region.
inline constexpr auto kMassColumns = columns(
    column<&Sensors::mass, 0>("canister_mass_kg", "kg", "Mass of the particles in the canister."),
    column<&Sensors::mass, 1>("throat_mass_kg", "kg", "Mass of the particles in the throat of the outlet."),
    column<&Sensors::mass, 2>("dosed_mass_kg", "kg", "Mass that has been dosed since the start of the run."),
    column<&Sensors::mass, 3>("lost_mass_kg", "kg", "Mass of the particles that left the domain, which is an error."));
inline constexpr auto kCountColumns = columns(
    column<&Sensors::count, 0>("canister_count", "1", "Number of particles in the canister."),
    column<&Sensors::count, 1>("throat_count", "1", "Number of particles in the throat of the outlet."),
    column<&Sensors::count, 2>("dosed_count", "1", "Number of particles that have been dosed since the start."),
    column<&Sensors::count, 3>("lost_count", "1", "Number of particles that left the domain, which is an error."));
inline constexpr auto kKineticColumns =
    columns(column<&Sensors::kineticEnergy>("kinetic_energy_J", "J",
                                            "Kinetic energy of translation of all particles that are not dosed."),
            column<&Sensors::rotationalEnergy>("rotational_energy_J", "J",
                                               "Kinetic energy of rotation of all particles that are not dosed."));
inline constexpr auto kOverlapColumns = columns(column<&Sensors::maxOverlapRatio>(
    "max_overlap_ratio", "1", "Largest overlap over the smaller radius of the two, since the line before.", 6));
/// The columns of timeseries.csv that follow where a direction of the domain repeats.
inline constexpr auto kThroughColumns = columns(
    column<&Sensors::through, 0>("through_x_kg", "kg",
                                 "Mass that has gone through the end of the domain along x since the start, upwards "
                                 "less downwards; 0 if that direction does not repeat."),
    column<&Sensors::through, 1>("through_y_kg", "kg", "The same along y."),
    column<&Sensors::through, 2>("through_z_kg", "kg", "The same along z."));
/// Only the checkpoint has these columns.
inline constexpr auto kInnerSensorColumns =
    columns(column<&Sensors::coilTorque>("particle_torque_Nm", "N m", "Torque of the particles on the coil about +z."),
            column<&Sensors::throatMomentumZ>("throat_momentum_z_kg_m_s", "kg m/s", "Momentum along +z in the throat."),
            column<&Sensors::rebuilds>("rebuilds", "1", "Number of times that the neighbour list was built."));
/// All columns of the sensors, as a checkpoint holds them.
inline constexpr auto kSensorColumns =
    std::tuple_cat(kMassColumns, kCountColumns, kKineticColumns, kThroughColumns, kInnerSensorColumns, kOverlapColumns);

// The columns that a sample has beside its sensors.
inline constexpr auto kStepColumns = columns(column<&Sample::step>("step", "1", "Number of time steps made."));
/// The angle has the same sense in every file.
inline constexpr const char* kCoilAngleMeaning =
    "Angle that the coil has turned about +z by the right-hand rule; a right-handed coil conveys at falling angles.";
inline constexpr auto kWhenColumns = columns(
    column<&Sample::time>("time_s", "s", "Simulated time."),
    column<&Sample::phase>("phase", "",
                           "What the schedule asks for in the time before this line: settle, rotate, reverse or rest."),
    column<&Sample::dose>("dose", "1", "Number of the dose, from 1; 0 while settling."),
    column<&Sample::coilAngle>("coil_angle_rad", "rad", kCoilAngleMeaning));
inline constexpr auto kDriveColumns = columns(
    column<&Sample::outletVelocity>("outlet_velocity_m_s", "m/s",
                                    "Mean velocity along +z of the mass in the throat; nan while it is empty."),
    column<&Sample::coilTorque>("coil_torque_Nm", "N m",
                                "Torque of the drive, mean since the line before; positive when the powder resists."),
    column<&Sample::coilPower>("coil_power_W", "W", "Power of the drive, mean since the line before."));
/// The columns that a checkpoint holds beside the sensors and the energy.
inline constexpr auto kOwnSampleColumns = std::tuple_cat(kStepColumns, kWhenColumns, kDriveColumns);

/// The columns of timeseries.csv; with an energy ledger kEnergyColumns follow.
inline constexpr auto kSampleColumns =
    std::tuple_cat(kWhenColumns, within<&Sample::sensors>(picked<2, 0, 1, 3>(kMassColumns)),
                   within<&Sample::sensors>(picked<2, 0, 1, 3>(kCountColumns)),
                   within<&Sample::sensors>(kKineticColumns), kDriveColumns, within<&Sample::sensors>(kOverlapColumns));

}  // namespace vkdose
