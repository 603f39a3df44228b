#pragma once
// What single keys cannot tell: faults between fields of a case. Comparisons are false for NaN, which stands for a
// value whose key is already reported.

#include "host/model/case.h"
#include "host/model/case_reader.h"

namespace vkdose {

/// Relations between the fields of a freshly read case.
void checkFields(CaseReader& reader, const Case& c);

/// The time step against the fastest contact motion of the smallest sphere (radius in metres).
void checkTimeStep(CaseReader& reader, const Case& c, double smallestRadius);

/// Whether the mass fits the canister, and the grid its region; whether the coil can be touched by too many turns.
void checkFilling(CaseReader& reader, const Case& c, double largestRadius);

/// Particles against the domain, the surfaces, the coil and one another.
void checkPlacement(CaseReader& reader, const Case& c, const Particles& particles);

}  // namespace vkdose
