#pragma once
// The dynamic angle of the powder in a turning drum: of all the powder, and as photographs through the glass show it.

#include <optional>
#include <vector>

#include "host/analysis/averaged_view.h"
#include "host/model/particles.h"

namespace vkdose {

/// Particles in the frame of a drum: z along its axis, y upwards and x to the side to which the drum's lowest point
/// moves, so that powder that the drum lifts rises towards +x. `through` is a point of the axis [m]; `axis` and `up`
/// are unit vectors, and the drum turns about `axis` by the right-hand rule. Throws std::invalid_argument if the axis
/// is upright.
Particles inDrum(const Particles& particles, const Vec3& through, const Vec3& axis, const Vec3& up);

/// Angle of the free surface to the horizontal [rad], positive where the powder rises towards +x (`inDrum`). The line
/// is fitted by least squares to the surface as it looks along the line's own normal, over the middle half of the bed's
/// width, so that steep surfaces count like flat ones. Surface: the highest point of any sphere over a spot, on a
/// lattice of a quarter of the mean diameter. Powder in flight counts. None if there are fewer than ten diameters of
/// width, or if the line does not come to rest within five degrees.
std::optional<double> drumAngle(const Particles& particles);

struct SurfaceAngle {
    double angle = 0;  ///< to the horizontal [rad]
    double error = 0;  ///< standard error of it [rad]; NaN if it is not known
};

/// The surface that a camera sees through the front glass of a drum, on photographs that are averaged (AveragedView).
/// Its angle is that of the least-squares line y = a + b x through the heights of the columns with |x| < `halfWidth`:
/// atan b.
class DrumFront {
  public:
    /// `halfWidth` of the window and mean `diameter` of the spheres [m]; a pixel is a tenth of it wide, and at least a
    /// thousandth of the window's half. So many photographs are to come, at equal intervals of time.
    DrumFront(double halfWidth, double diameter, int photographs);

    /// A window must be wider than so many mean diameters.
    static constexpr double kLeastDiameters = 5;

    /// One photograph of particles in the frame of the drum (`inDrum`).
    void add(const Particles& particles);

    /// The error is the deviation of the angles of the four quarters of the photographs, in their order, over the root
    /// of four. It is not known from fewer than eight photographs, or if a quarter of them has no angle. No angle if
    /// the window is narrower than five diameters, or if the bed does not reach across it.
    std::optional<SurfaceAngle> angle() const;

    /// Number of the window's columns that show no bed, and of all of them.
    int emptyColumns() const;
    int columns() const { return all_.columns(); }
    int photographs() const { return all_.photographs(); }

  private:
    std::optional<double> angleOf(const AveragedView& view) const;

    double halfWidth_ = 0, diameter_ = 0;
    int photographs_ = 0;
    AveragedView all_;
    std::vector<AveragedView> quarters_;
};

}  // namespace vkdose
