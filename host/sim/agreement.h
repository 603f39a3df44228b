#pragma once
// The verdicts of a comparison: which differences rounding and chaos explain, and which not. NaN never agrees.

#include <vector>

#include "host/sim/comparison.h"

namespace vkdose {

/// Units of the differences.
struct Scales {
    double radius = 0;        ///< mean [m]
    double particleMass = 0;  ///< mean [kg]
    double filledMass = 0;    ///< [kg]
    Vec3 period{0};           ///< World::period
};
Scales scalesOf(const World& world, const Particles& particles, double filledMass);

/// Largest difference of two states over the particles that are active in both.
struct StateDifference {
    double position = 0;  ///< [m]
    double velocity = 0;  ///< [m/s]
};
StateDifference difference(const Particles& a, const Particles& b, const Vec3& period = Vec3(0));

/// Compares particle by particle, time after time. The limit on a candidate's difference allows for three causes:
/// - Mass, time step and parameters are rounded to single precision once, and forces in every step. In free flight that
///   is up to kVelocityFloor of the velocity scale, and half of that times the distance travelled in position.
/// - It keeps positions and speeds in two floats. Loading them loses nothing that matters (kPositionFloor). The radii
///   are rounded to single precision, so that the first touch comes early or late by up to kRadiusRounding.
/// - Contacts amplify differences, but not more than kOneTwin times what they made of the fine twin's displacement,
///   which is one of many. What they may leave in the velocities adds up in the positions.
/// Once the limit exceeds kWidest (of a radius, of the velocity scale) the state is chaotic and is no longer judged.
class ParticleJudge {
  public:
    static constexpr double kVelocityFloor = 1e-6;
    static constexpr double kPositionFloor = 1e-9;
    static constexpr double kRadiusRounding = 0x1p-22;
    static constexpr double kOneTwin = 3;
    static constexpr double kWidest = 0.1;

    explicit ParticleJudge(const Scales& scales) : scales_(scales) {}

    ParticleRow row(std::uint64_t step, double time, std::size_t contacts, const Particles& reference,
                    const Particles& fineTwin, const Particles& candidate);

  private:
    Scales scales_;
    double speed_ = 0;         ///< velocity scale [m/s]
    double twinPosition_ = 0;  ///< largest so far [mean radii]
    double twinVelocity_ = 0;  ///< largest so far [velocity scales]
    double time_ = 0;          ///< of the latest row [s]
    double way_ = 0;           ///< that differences of the velocities may have led to [mean radii]
    bool touched_ = false;     ///< there was a contact
    bool chaotic_ = false;
};

/// The packing as a whole at one time.
struct Moment {
    double time = 0;
    Phase phase = Phase::Settle;
    bool lateInPhase = false;      ///< in the second half: the mean torque means something
    double kineticEnergy = 0;      ///< translation and rotation [J]
    double meanKineticEnergy = 0;  ///< since the start of the phase [J]
    double meanTorque = 0;         ///< on the coil about +z, since the start of the phase [N m]
    double maxOverlap = 0;         ///< over the radius, since the start of the phase [-]
    double meanHeight = 0;         ///< of the active particles [m]
    double contactsEach = 0;       ///< contacts over active particles, mean since the start of the phase
    double dosedMass = 0;          ///< [kg]
    double freeWay = 0;            ///< from where the bodies that move freely began, their sum [m]
};
using History = std::vector<Moment>;

/// Compares histories made at the same times. A quantity may differ by a floor (see the table in agreement.cpp) plus
/// three times the largest spread of the rough twins. If that is more than the quantity's cap, agreement would mean
/// nothing, and the verdict is Undecided (unless the candidate differs by even more). A quantity that never exceeds its
/// floor in any history (hardly anything was dosed) has no row, because many wrong programs would agree as well as the
/// right ones.
std::vector<QuantityRow> judgeQuantities(const History& reference, const std::vector<const History*>& twins,
                                         const History& candidate, const Scales& scales);

}  // namespace vkdose
