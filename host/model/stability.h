#pragma once
// The fastest motions that the explicit time step must resolve. Contacts oscillate along the normal, in sliding,
// rolling and torsion. Each mode is a spring on an effective mass. The numbers are bounds for the smallest particle
// against the largest.

#include <optional>
#include <string>
#include <vector>

#include "host/model/world.h"

namespace vkdose {

struct Case;

/// Reduced mass of two spheres of radii a and b [m], b = infinity for a wall [kg].
double reducedMass(double density, double a, double b);

struct ContactMode {
    std::string name;     ///< "particle-wall rolling"
    double duration = 0;  ///< half a period without damping, pi sqrt(m/k) [s]
    double decay = 0;     ///< damping rate gamma/m [1/s]
};

/// Name of a class in messages: "particle-particle", ...
std::string className(ContactClass c);

/// The classes that can occur in `world`: walls only with surfaces, the coil only with a coil.
std::vector<ContactClass> contactClasses(const World& world);

/// Every mode of every class in `used`, for particles no smaller than `smallest` [m]. A law whose stiffness grows with
/// the overlap counts at the largest overlap that the run allows, `maxOverlapRatio` of the smaller radius.
std::vector<ContactMode> contactModes(const ContactLaw& law, double density, double smallest,
                                      const std::vector<ContactClass>& used, double maxOverlapRatio = kMaxOverlapRatio);

/// The parameters of a class at that overlap, as linear springs and dashpots between the spheres a and b [m], b =
/// infinity for a wall (normal_law.h).
ContactParameters stiffest(const ContactParameters& p, double density, double a, double b, double maxOverlapRatio);

/// The modes of a case under both of its laws: damping may be stronger while the powder settles.
std::vector<ContactMode> modesOf(const Case& c, double smallest);

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
