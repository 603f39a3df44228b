#pragma once
// The fastest motions that the explicit time step must resolve. Contacts oscillate along the normal, in sliding,
// rolling and torsion. Each mode is a spring on an effective mass. The numbers are bounds for the smallest particle
// against the largest.

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "host/model/world.h"

namespace vkdose {

struct Case;

/// Reduced mass of two spheres of radii a and b [m], b = infinity for a wall [kg].
double reducedMass(double density, double a, double b);
/// The same of two densities.
double reducedMass(double densityA, double a, double densityB, double b);
/// The same for the two sides of a contact: spheres of their materials, or a sphere and a wall.
double reducedMass(const World& world, MaterialPair pair, double a, double b);

/// Radii of the particles of each material [m]; a material of none has no smallest.
struct SizeRange {
    double smallest = std::numeric_limits<double>::infinity();
    double largest = 0;
    double mean = 0;
    double count = std::numeric_limits<double>::infinity();  ///< of the particles, at most about
};
using PowderSizes = std::vector<SizeRange>;  ///< by the material

/// Those that a case will insert: bounds and mean of its size distributions, or of its list.
PowderSizes powderSizes(const Case& c);
/// Those of particles that there are.
PowderSizes powderSizes(const World& world, const Particles& particles);
/// Of all powders together; the mean is over the powders.
SizeRange overall(const PowderSizes& sizes);

/// The radius of the pair's other side, beside a particle with `size` of its powder: the other powder's, or that of a
/// wall, infinity.
double otherSide(const World& world, MaterialPair pair, const PowderSizes& sizes, double SizeRange::*size);

/// Whether there are spheres for a contact of this pair: a powder may have none, or none left.
bool haveSpheres(const World& world, MaterialPair pair, const PowderSizes& sizes);

struct ContactMode {
    std::string name;     ///< "particle-wall rolling"
    double duration = 0;  ///< half a period without damping, pi sqrt(m/k) [s]
    double decay = 0;     ///< damping rate gamma/m [1/s]
};

/// Every mode of every pair that can occur, for particles no smaller than the smallest of their powder. Powders of no
/// particles are left out. A law whose stiffness grows with the overlap counts at the largest overlap that the world
/// allows. A body that moves freely counts as if the spheres covered it, as densely as they can.
std::vector<ContactMode> contactModes(const World& world, const ContactLaw& law, const PowderSizes& sizes);

/// The parameters of a contact at that overlap, as linear springs and dashpots between the spheres a and b [m], b =
/// infinity for a wall (host/law/law.h). `mass` is the reduced one [kg].
ContactParameters stiffest(const ContactParameters& p, double mass, double a, double b, double maxOverlapRatio);

/// The modes of a case under both of its laws: damping may be stronger while the powder settles.
std::vector<ContactMode> modesOf(const Case& c, const PowderSizes& sizes);

/// A time step must not exceed this fraction of a mode's duration, unless the case asks for fewer steps in it
/// (stability of a single contact alone would allow 2/pi of it).
inline constexpr double kUnstableFraction = 1.0 / 5;

/// The fewest steps in the duration of the fastest mode that a case may ask for. A sphere with twelve contacts moves
/// twice as fast as one with a single contact, and is stable with more than pi steps.
inline constexpr double kFewestSteps = 4;

/// Time step for `step_s = "auto"`: 1/`stepsPerContact` of the fastest mode, and half of a damping time. Without a
/// number of steps 1/8 of the stiffest normal mode and 1/6 of any other.
double automaticTimeStep(const std::vector<ContactMode>& modes, std::optional<double> stepsPerContact = {});

}  // namespace vkdose
