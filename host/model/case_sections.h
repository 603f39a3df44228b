#pragma once
// The tables of a case file, read into a Case. Every key and its default stands in read_powder.cpp, read_apparatus.cpp
// or read_field.cpp.

#include <optional>

#include "host/model/case.h"
#include "host/model/case_reader.h"

namespace vkdose {

enum class Boundaries { Canister, List, None };

// read_powder.cpp
void readParticles(CaseReader& reader, Section& root, Case& c);
void readContact(Section& root, Case& c);
/// The box of the insertion grid: the canister above its coil, or as given. After boundaries and coil.
void readRegion(Section& root, std::optional<Boundaries> kind, Case& c);

// read_apparatus.cpp
/// Nothing when the kind itself is at fault.
std::optional<Boundaries> readBoundaries(CaseReader& reader, Section& root, Case& c);
void readCoil(CaseReader& reader, Section& root, Case& c);
void readSchedule(Section& root, Case& c);
/// Time step and skin as far as the file states them; 0 stands for a value still to be worked out.
void readTime(Section& root, Case& c);
/// True when the file states a domain.
bool readDomain(Section& root, Case& c);

// read_field.cpp
/// After boundaries and sensors. The mean diameter [m] is the kernels' default width; NaN if it is not known.
void readFields(CaseReader& reader, Section& root, double meanDiameter, Case& c);

}  // namespace vkdose
