#pragma once
// Faults between the keys of a case, which no single key shows. Comparisons are false for NaN, which stands for a
// value whose key is already reported.

#include <limits>
#include <string>

#include "host/model/case.h"
#include "host/model/case_reader.h"

namespace vkdose {

/// Skin of a case that states none, in mean radii.
inline constexpr double kUsualSkin = 0.6;

/// Radii of the particles to come [m].
struct SizeRange {
    double smallest = std::numeric_limits<double>::infinity();
    double largest = 0;
    double mean = 0;
};

/// Relations between the fields of a freshly read case.
void checkFields(CaseReader& reader, const Case& c);

/// The time step against the fastest contact motion of the smallest sphere (radius in metres).
void checkTimeStep(CaseReader& reader, const Case& c, double smallestRadius);

/// Whether the largest sphere passes the outlet, the mass fits the canister, and the grid its region.
void checkFilling(CaseReader& reader, const Case& c, double largestRadius);

/// Whether a sphere of this radius [m] can touch too many turns of the coil.
void checkTouches(CaseReader& reader, const Case& c, double largestRadius);

// scales.cpp
/// Numbers that do not go together: masses beyond single precision, a way in one step that skips contacts, durations
/// that are no number of steps.
void checkScales(CaseReader& reader, const Case& c, const SizeRange& radii);
/// Whether positions in the whole domain are exact enough for the smallest sphere; `path` is to blame.
void checkExtent(CaseReader& reader, const Case& c, double smallestRadius, const std::string& path);

/// Whether two surfaces coincide, or nearly so, where a sphere of this radius [m] can be.
void checkSurfaces(CaseReader& reader, const Case& c, double radius);

// rows.cpp
/// Whether everybody's neighbours at the start, within reach and skin, fit a row of the neighbour list.
void checkRows(CaseReader& reader, const Case& c, const Particles& particles, const SizeRange& radii);

/// Particles against the domain, the surfaces, the coil and one another; their motion against the time step.
void checkPlacement(CaseReader& reader, const Case& c, const Particles& particles);

}  // namespace vkdose
