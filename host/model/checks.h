#pragma once
// Finds faults in the relation of several keys, which no single key shows. NaN stands for a value whose key is already
// reported. Comparisons are false for NaN, so that the key is not reported again.

#include <string>

#include "host/model/case.h"
#include "host/model/case_reader.h"
#include "host/model/stability.h"

namespace vkdose {

/// Skin of a case that states none, in mean radii.
inline constexpr double kUsualSkin = 0.6;

/// Checks the relations between the fields of a case that has just been read.
void checkFields(CaseReader& reader, const Case& c);

/// Checks the time step against the fastest contact motion of the smallest spheres.
void checkTimeStep(CaseReader& reader, const Case& c, const PowderSizes& sizes);

/// Checks whether a sphere of this radius [m] can touch too many turns of the coil.
void checkTouches(CaseReader& reader, const Case& c, double largestRadius);

// fill_checks.cpp
/// Finds the sites of the grid that are in the vessel, if the fill has one, and the mass that fills it to a height.
void findVessel(CaseReader& reader, Section& particles, Case& c);
/// Checks whether the largest sphere passes the outlet, the mass fits the canister, and the grid fits its region.
void checkFilling(CaseReader& reader, const Case& c, double largestRadius);

/// Checks whether each refill holds a particle.
void checkRefills(CaseReader& reader, const Case& c, const Insertion& filled);

// period_checks.cpp
/// Checks whether a domain that repeats is long enough, and whether walls, coil and bodies repeat with it.
void checkPeriod(CaseReader& reader, const Case& c, const SizeRange& radii);

// scales.cpp
/// Checks for numbers that do not go together: masses beyond single precision, a way in one step so long that contacts
/// are skipped, durations that are not a valid number of steps.
void checkScales(CaseReader& reader, const Case& c, const SizeRange& radii);
/// Checks whether positions in the whole domain are exact enough for the smallest sphere. A fault names the key `path`.
void checkExtent(CaseReader& reader, const Case& c, double smallestRadius, const std::string& path);

/// Checks whether two surfaces coincide, or nearly so, in a place where a sphere of this radius [m] can be.
void checkSurfaces(CaseReader& reader, const Case& c, double radius);

/// Checks whether a body at rest coincides over an area with another one, or with a wall, where a sphere can be.
void checkBodies(CaseReader& reader, const Case& c);

// rows.cpp
/// Checks whether the neighbours of each particle at the start, within reach and skin, fit a row.
void checkRows(CaseReader& reader, const Case& c, const Particles& particles, const SizeRange& radii);

// placement.cpp
/// Checks the particles against the domain, the surfaces, the coil and one another, and their motion against the time
/// step.
void checkPlacement(CaseReader& reader, const Case& c, const Particles& particles);

}  // namespace vkdose
