#pragma once
// Coarse-grained fields: the requests to a backend, and its answers.
//
// A particle is smeared out over the points of a grid (the centres of its cells) by a kernel W of the distance:
//
//   density rho(r) = sum_i m_i W_i(r),  W_i(r) = w(|r - x_i|) / (sum over points r' of w(|r' - x_i|) dV).
//
// Each kernel is normalised over the points of the grid. The integral over the grid (the sum of rho dV) is therefore
// the mass of the particles in it, to rounding. This holds for any coarseness of the grid, and also where a face of the
// grid cuts the kernel: if the face is a wall, nothing is smeared through it. A particle counts wholly if its centre is
// in the grid, and not at all if its centre is outside. A direction with a single cell is not resolved: there the field
// is the mean over the grid's extent.
//
// Sources: I. Goldhirsch, Stress, stress asymmetry and couple stress: from discrete particles to continuous fields,
// Granular Matter 12 (2010) 239-252; with the paper's Gaussian kernel or Lucy's polynomial. The contact stress of one
// of several materials: D. Tunuguntla, A. Thornton, T. Weinhart, From discrete elements to continuum fields: extension
// to bidisperse systems, Computational Particle Mechanics 3 (2016) 349-365.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/core/vec.h"
#include "host/law/user_law.h"

namespace vkdose {

/// Cells of a box. A point is in the middle of each cell. Points are numbered along x first, then y, then z.
struct FieldGrid {
    Vec3 low{0}, high{0};  ///< corners [m]
    std::array<std::uint32_t, 3> cells{1, 1, 1};

    std::size_t points() const { return std::size_t(cells[0]) * cells[1] * cells[2]; }
    Vec3 cell() const { return (high - low) / Vec3(cells[0], cells[1], cells[2]); }  ///< size [m]
    double cellVolume() const { return cell().x * cell().y * cell().z; }             ///< [m3]
    bool resolved(int direction) const { return cells[std::size_t(direction)] > 1; }
    int resolvedDirections() const { return int(resolved(0)) + int(resolved(1)) + int(resolved(2)); }
    Vec3 point(std::size_t index) const;  ///< [m]
};

enum class Kernel {
    Gaussian,  ///< exp(-r2/2w2), cut at three widths, where it has fallen to 1.1 %
    Lucy       ///< (1 + 3 r/w) (1 - r/w)^3 within the width, 0 beyond; smooth to its second derivative
};

struct FieldRequest {
    FieldGrid grid;
    Kernel kernel = Kernel::Gaussian;
    double width = 0;            ///< w [m]
    bool contactStress = false;  ///< also compute the contact stress, the most expensive of the fields
    /// Only particles of this material count; those of others may still touch them. The contact stress is then of the
    /// parts of the branches that lie in particles of this material. Those of all materials add up to that of all.
    std::optional<int> material;

    double reach() const { return kernel == Kernel::Gaussian ? 3 * width : width; }  ///< of the kernel [m]
    /// The kernel at a distance [m], without its norm: 1 at distance 0.
    double shape(double distance) const;
    /// Points that one kernel may reach.
    double pointsInReach() const;
};

inline constexpr std::size_t kMostFieldPoints = 1'000'000;
/// Most points in reach of one kernel. Software devices would end a loop over more points too early, and no width needs
/// a grid so fine.
inline constexpr double kMostPointsInReach = 60'000;

/// The fault of a request, with its remedy. Returns nothing if the request can be met.
std::optional<std::string> faultOf(const FieldRequest& request);

/// The fields at one point. All are densities that add up, so that they can be averaged over time. Velocity,
/// temperature and coordination do not add up; they are quotients of these densities.
struct FieldPoint {
    double density = 0;  ///< of mass [kg/m3]
    Vec3 momentum{0};    ///< [kg/m2 s]; half-step velocities
    double number = 0;   ///< of particles [1/m3]
    double touches = 0;  ///< of touching neighbours; both particles of a pair count each other [1/m3]
    /// sum_i m_i v'_i v'_i W_i with v' = v_i - V(r): xx, yy, zz, yz, zx, xy [Pa]. Pressure is positive.
    std::array<double, 6> kineticStress{};
    /// sum over contacts of f_a l_b times the mean of W along l, row a, column b [Pa]. The branch l leads from the
    /// centre of the other particle, or from the wall, to the particle on which f acts. Pressure is positive. Zero if
    /// the contact stress was not asked for.
    std::array<Vec3, 3> contactStress{Vec3(0), Vec3(0), Vec3(0)};
    /// Each of the properties that a user's law gives particles, times their density of mass [unit kg/m3]. Zero without
    /// properties.
    std::array<double, kMostLawProperties> properties{};

    Vec3 velocity() const;                 ///< V = momentum / density [m/s]; NaN where there is no mass
    double temperature() const;            ///< granular: a third of v'.v' weighed with the mass [m2/s2]; NaN likewise
    double coordination() const;           ///< neighbours that touch a particle, mean [-]; NaN likewise
    double property(std::size_t k) const;  ///< mean over the mass [unit]; NaN likewise

    /// The fields of a point as a list of numbers, for sums, records and files.
    static constexpr std::size_t kNumbers = 21 + kMostLawProperties;
    std::array<double, kNumbers> numbers() const;
    static FieldPoint of(const double* numbers);
};

using FieldPoints = std::vector<FieldPoint>;  ///< as FieldGrid counts points

/// Nodes and weights of the quadrature along a branch, Gauss-Legendre on [0, 1]. The kernel's mean along a branch l is
/// off by less than 2e-5 of its peak for Gaussians up to l = 2 w, by less than 1e-2 up to 4 w (a test holds it to
/// this).
inline constexpr std::array<double, 4> kBranchNodes{0.06943184420297371, 0.33000947820757187, 0.66999052179242813,
                                                    0.93056815579702629};
inline constexpr std::array<double, 4> kBranchShares{0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                                     0.17392742256872693};

/// A field that a run takes while it goes on.
struct FieldSensor {
    enum class Preset { None, HeightProfile, MidPlane, Outlet };
    std::string name;  ///< of its file
    Preset preset = Preset::None;
    FieldRequest request;
    double interval = 0;   ///< time between two fields that are kept, rounded to whole sensor intervals [s]
    bool average = false;  ///< keep the mean of all sensor intervals since the last field, not the instant
    bool stress = false;   ///< keep stresses, temperature and coordination as well
    /// Height of the bed when dosing begins, for HeightProfile [m]; 0: found from the density.
    double initialHeight = 0;
};

}  // namespace vkdose
