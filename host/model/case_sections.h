#pragma once
// The tables of a case file, read into a Case. Every key is read in read_powder.cpp, read_apparatus.cpp,
// read_bodies.cpp or read_field.cpp.

#include <optional>

#include "host/model/case.h"
#include "host/model/case_reader.h"

namespace vkdose {

enum class Boundaries { Canister, List, None };

// read_powder.cpp
void readParticles(CaseReader& reader, Section& root, Case& c);
void readContact(CaseReader& reader, Section& root, Case& c);
/// Reads the box of the insertion grid. By default it is the canister above its coil. Call after readBoundaries and
/// readCoil.
void readRegion(Section& root, std::optional<Boundaries> kind, Case& c);

// read_apparatus.cpp
/// Reads the boundaries. Returns nothing if their kind itself is at fault.
std::optional<Boundaries> readBoundaries(CaseReader& reader, Section& root, Case& c);
void readCoil(CaseReader& reader, Section& root, Case& c);
void readSchedule(Section& root, Case& c);
/// Reads time step and skin if the file states them; 0 stands for a value that is computed later.
void readTime(CaseReader& reader, Section& root, Case& c);
/// True when the file states a domain.
bool readDomain(Section& root, Case& c);

// read_bodies.cpp
/// Reads the bodies. The largest radius [m] is the reach of a mesh; NaN if it is not known. Call after the particles.
void readBodies(CaseReader& reader, Section& root, double largestRadius, Case& c);
/// The angle of the drive is that of the coil, which may turn in the negative sense. A body's own turn is positive
/// about its axis while powder is dosed. Call after readBodies and readCoil.
void alignWithDrive(Case& c);

// read_field.cpp
/// Reads the fields. Call after boundaries and sensors. The mean diameter [m] is the default width of the kernels; NaN
/// if it is not known.
void readFields(CaseReader& reader, Section& root, double meanDiameter, Case& c);

}  // namespace vkdose
