#pragma once
// What the particles do to the bodies of a world between two samples, and the work of each body since the start.

#include <cstdint>
#include <vector>

#include "host/backend/backend.h"
#include "host/core/columns.h"
#include "host/core/record.h"

namespace vkdose {

/// Of one body in one line of the time series.
struct BodySample {
    Vec3 force{0};      ///< on the body, mean since the last sample [N]
    double torque = 0;  ///< on the body about its axis, likewise [N m]
    double power = 0;   ///< of the body on the particles, likewise [W]
    double work = 0;    ///< of the body on the particles since the start [J]
};

/// The columns of timeseries.csv for each body, behind all others. The name of the body and a dot stand before each.
inline constexpr auto kBodyColumns = columns(
    column<&BodySample::force, 0>("force_x_N", "N", "Force of the particles on the body along x, mean."),
    column<&BodySample::force, 1>("force_y_N", "N", "The same along y."),
    column<&BodySample::force, 2>("force_z_N", "N", "The same along z."),
    column<&BodySample::torque>("torque_Nm", "N m",
                                "Torque of the particles on the body, mean: about the axis of its motion, without one "
                                "about z through its place."),
    column<&BodySample::power>("power_W", "W", "Power of the body on the particles, mean."),
    column<&BodySample::work>("work_J", "J", "Work of the body on the particles since the start."));

/// Where a body is that moves freely, in one line of the time series.
struct FreePlace {
    Vec3 at{0};        ///< [m]
    Vec3 velocity{0};  ///< half a step before [m/s]
    bool hinged = false;
    double angle = 0;  ///< about its hinge, if it has one [rad]
    double rate = 0;   ///< likewise, half a step before [rad/s]
};

/// The columns of timeseries.csv for each body that moves freely, behind those of all bodies.
inline constexpr auto kFreeBodyColumns = columns(
    column<&FreePlace::at, 0>("x_m", "m", "Where the origin of the body's frame is, along x."),
    column<&FreePlace::at, 1>("y_m", "m", "The same along y."),
    column<&FreePlace::at, 2>("z_m", "m", "The same along z."),
    column<&FreePlace::velocity, 0>("velocity_x_m_s", "m/s", "Velocity of the body along x, half a step before."),
    column<&FreePlace::velocity, 1>("velocity_y_m_s", "m/s", "The same along y."),
    column<&FreePlace::velocity, 2>("velocity_z_m_s", "m/s", "The same along z."));
/// Of those on a hinge, behind them.
inline constexpr auto kHingedBodyColumns =
    columns(column<&FreePlace::angle>("angle_rad", "rad", "By how much the body has turned about its hinge."),
            column<&FreePlace::rate>("rate_rad_s", "rad/s", "How fast it turns about its hinge, half a step before."));

/// The columns of doses.csv for each body, likewise.
inline constexpr auto kDoseBodyColumns = columns(
    column<&BodySample::force, 0>("force_x_N", "N",
                                  "Force of the particles on the body along x, mean over the rotation."),
    column<&BodySample::force, 1>("force_y_N", "N", "The same along y."),
    column<&BodySample::force, 2>("force_z_N", "N", "The same along z."),
    column<&BodySample::torque>("torque_Nm", "N m", "Torque of the particles on the body, mean over the rotation."),
    column<&BodySample::power>("power_W", "W", "Power of the body on the particles, mean over the rotation."),
    column<&BodySample::work>("work_J", "J", "Work of the body on the particles in the dose, to the end of its rest."));

/// What a drive, a bearing or a wall must bear: the largest magnitudes among the samples of a run.
struct BodyPeaks {
    double force = 0, torque = 0, power = 0;  ///< [N], [N m], [W]
};
inline constexpr auto kBodyPeakColumns =
    columns(column<&BodyPeaks::force>("largest_force_N", "N", "Largest force on the body."),
            column<&BodyPeaks::torque>("largest_torque_Nm", "N m", "Largest torque on the body, either way."),
            column<&BodyPeaks::power>("largest_power_W", "W", "Largest power of the body, either way."));

/// All numbers of the samples, one after another, and back.
std::vector<double> numbersOf(const std::vector<BodySample>& samples);
std::vector<BodySample> samplesOf(const std::vector<double>& numbers);

/// Joins the calls of a backend between two samples.
class BodyLoads {
  public:
    /// `bodies`: how many there are, the coil counted.
    explicit BodyLoads(std::size_t bodies) : sums_(bodies), turned_(bodies), peaks_(bodies) {}

    /// `rotates`: the drive conveys in these steps.
    void add(const std::vector<BodyLoad>& call, std::uint64_t steps, bool rotates);
    /// The sample of all calls since the last one, which together made `steps` of `timeStep` [s].
    std::vector<BodySample> take(std::uint64_t steps, double timeStep);
    const std::vector<BodyPeaks>& peaks() const { return peaks_; }

    void openDose();
    /// Of the dose under way: means over its rotation, and the work since it was opened.
    std::vector<BodySample> sinceDose(double timeStep) const;

    /// For a checkpoint, and back. Throws RecordError if the record has other bodies.
    void save(Record& record) const;
    void restore(const Record& record);
    /// From the state of another run, whose work counts on and whose peaks do not.
    void takeOver(const Record& record);

  private:
    std::vector<BodySample> sums_;    ///< force and torque times steps; power holds the work since the last sample [J]
    std::vector<BodySample> turned_;  ///< the same over the rotation of the dose; `work` at its opening [J]
    std::uint64_t turnedSteps_ = 0;
    std::vector<BodyPeaks> peaks_;
};

}  // namespace vkdose
