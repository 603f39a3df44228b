#pragma once
// The energy ledger: all energy that was loaded or that coil and bodies supplied is still there, was lost in a known
// way, or has left.

#include <tuple>

#include "host/backend/backend.h"
#include "host/core/columns.h"

namespace vkdose {

/// A plain struct, so that it can be saved. Its only state is `sum`, the joined books of all calls since load [J]. In
/// it instantaneous energies are those of the last call; losses and works are sums over all calls.
struct EnergyLedger {
    EnergyBook sum;

    /// Joins the book of the next call.
    void add(const EnergyBook& call);

    double elastic() const;  ///< in all springs [J]
    double present() const;  ///< motion, potential and elastic energy [J]
    double losses() const;   ///< of all kinds, the time step's own included [J]
    /// loaded + coil work + body work - losses - left - present [J]: zero but for rounding if everything was booked.
    double residual() const;
};

/// What a change of gravity adds to the energy of the active particles [J], so that the book stays closed: it belongs
/// to `loaded`. `particles` is the state at the change, after the last step of the world under `from`. The potential
/// energy of the book jumps between two full steps; its mean position between them is that of the change.
double energyOfGravityChange(const World& world, const Particles& particles, const Vec3& from, const Vec3& to);

// The columns of the book, by the part they play in the balance.
inline constexpr auto kMotionColumns = columns(
    column<&EnergyBook::kinetic>("full_step_kinetic_J", "J",
                                 "Kinetic energy of translation at the full step, from the velocities half a step "
                                 "before and after it."),
    column<&EnergyBook::rotational>("full_step_rotational_J", "J",
                                    "Kinetic energy of rotation at the full step, likewise."),
    column<&EnergyBook::potential>("potential_J", "J", "Potential energy in gravity, zero at the origin."));
inline constexpr auto kElasticColumns = columns(
    column<&EnergyBook::elasticNormal>("elastic_normal_J", "J", "Energy in the normal springs of the contacts."),
    column<&EnergyBook::elasticSliding>("elastic_sliding_J", "J", "Energy in the sliding springs of the contacts."),
    column<&EnergyBook::elasticRolling>("elastic_rolling_J", "J", "Energy in the rolling springs of the contacts."),
    column<&EnergyBook::elasticTorsion>("elastic_torsion_J", "J", "Energy in the torsion springs of the contacts."));
inline constexpr auto kLossColumns = columns(
    column<&EnergyBook::plastic>("loss_plastic_J", "J",
                                 "Loss by the hysteresis of the normal force off its adhesive branch, since the "
                                 "start."),
    column<&EnergyBook::adhesive>("loss_adhesive_J", "J",
                                  "Loss by the hysteresis of the normal force on its adhesive branch, since the "
                                  "start."),
    column<&EnergyBook::viscous>("loss_viscous_J", "J",
                                 "Loss by normal damping and by the dashpots of contacts that stick, since the start."),
    column<&EnergyBook::sliding>("loss_sliding_J", "J",
                                 "Loss by contacts that slide, and by sliding springs when contacts open, since the "
                                 "start."),
    column<&EnergyBook::rolling>("loss_rolling_J", "J",
                                 "Loss by contacts that roll, and by rolling springs when contacts open, since the "
                                 "start."),
    column<&EnergyBook::torsion>("loss_torsion_J", "J",
                                 "Loss by contacts that twist, and by torsion springs when contacts open, since the "
                                 "start."),
    column<&EnergyBook::numerical>("loss_numerical_J", "J",
                                   "Loss by the finite time step where contacts begin and end, since the start."));
inline constexpr auto kLoadedColumns =
    columns(column<&EnergyBook::loaded>("loaded_J", "J",
                                        "Energy of the state that was loaded, its contacts included, of "
                                        "powder that was added, and of a change of gravity."));
inline constexpr auto kOutsideColumns = columns(
    column<&EnergyBook::coilWork>("coil_work_J", "J", "Work of the coil on the particles since the start."),
    column<&EnergyBook::bodyWork>("body_work_J", "J", "Work of moving bodies on the particles since the start."),
    column<&EnergyBook::left>("left_J", "J",
                              "Energy that dosed particles have taken away since the start, their contacts included."));
inline constexpr auto kResidualColumns = columns(
    column<&EnergyLedger::residual>("residual_J", "J",
                                    "loaded + coil work + body work - losses - left - motion - potential - elastic: "
                                    "zero but for rounding."));
inline constexpr auto kMomentumColumns = columns(
    column<&EnergyBook::momentum, 0>("momentum_x_kg_m_s", "kg m/s",
                                     "Momentum along x of all particles that are not dosed, half a step before."),
    column<&EnergyBook::momentum, 1>("momentum_y_kg_m_s", "kg m/s", "The same along y."),
    column<&EnergyBook::momentum, 2>("momentum_z_kg_m_s", "kg m/s", "The same along z."),
    column<&EnergyBook::angularMomentum, 0>("angular_momentum_x_kg_m2_s", "kg m2/s",
                                            "Angular momentum along x about the origin of all particles that are not "
                                            "dosed, spins included, half a step before."),
    column<&EnergyBook::angularMomentum, 1>("angular_momentum_y_kg_m2_s", "kg m2/s", "The same along y."),
    column<&EnergyBook::angularMomentum, 2>("angular_momentum_z_kg_m2_s", "kg m2/s", "The same along z."));

/// Energy that flows in or out during a call: the books of several calls add up.
inline constexpr auto kFlowColumns = std::tuple_cat(kLossColumns, kOutsideColumns, kLoadedColumns);
/// A whole book, as a checkpoint holds it.
inline constexpr auto kBookColumns = std::tuple_cat(kMotionColumns, kElasticColumns, kFlowColumns, kMomentumColumns);
/// Columns of EnergyLedger. They stand behind the other columns of timeseries.csv.
inline constexpr auto kEnergyColumns =
    std::tuple_cat(within<&EnergyLedger::sum>(
                       std::tuple_cat(kMotionColumns, kElasticColumns, kLoadedColumns, kOutsideColumns, kLossColumns)),
                   kResidualColumns, within<&EnergyLedger::sum>(kMomentumColumns));

/// The sum over some columns of a book [J].
template <class... C>
double sumOf(const std::tuple<C...>& columns, const EnergyBook& book) {
    double sum = 0;
    forEachColumn(columns, [&](const auto& c) { sum += c.of(book); });
    return sum;
}

}  // namespace vkdose
