#pragma once
// The tables of a case file, read into a Case. Every key is read in read_powder.cpp, read_materials.cpp,
// read_sieve.cpp, read_contact.cpp, read_apparatus.cpp, read_bodies.cpp, read_motion.cpp, read_regions.cpp,
// read_field.cpp or read_measure.cpp; names and what refers to them in read_names.cpp.

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "host/model/case.h"
#include "host/model/case_reader.h"

namespace vkdose {

enum class Boundaries { Canister, List, None };

// read_powder.cpp
/// Reads the size distribution of a table [particles.size] or [powder.size].
SizeDistribution readSize(CaseReader& reader, Section& section, Case& c);
void readParticles(CaseReader& reader, Section& root, Case& c);
/// Reads the box of the insertion grid. By default it is the canister above its coil. Call after readBoundaries,
/// readCoil and readBodies.
void readRegion(CaseReader& reader, Section& root, std::optional<Boundaries> kind, Case& c);
/// Reads the refills. Call after readParticles and readSchedule.
void readRefills(CaseReader& reader, Section& root, Case& c);
/// Raises the grid of a canister above the bodies that follow the drive and so stand in the place of a coil.
void fillAboveDriven(Section& root, Case& c);

// read_materials.cpp
/// The tables [[material]], by the index of their material.
using MaterialTables = std::map<int, Section*>;
/// Reads [[powder]] and [[material]], and gives the materials their indices. Call after readParticles, before anything
/// else that names a material; readList comes after it.
MaterialTables readMaterials(CaseReader& reader, Section& root, Case& c);
/// Reads the file of particles.list, if the case has one.
void readList(CaseReader& reader, Section& root, Case& c);
/// Index of the material of a wall or body that the key `material` of its table names; `usual` if the table does not
/// have it.
int readMaterialName(CaseReader& reader, Section& section, const Case& c, int usual);
/// Index among World::materials of the powder that the key `powder` names; nothing if the table does not have it.
std::optional<int> readPowderName(CaseReader& reader, Section& section, const Case& c);

// read_sieve.cpp
/// Reads the table of a sieve analysis into `size.sieve`, which stays empty after a fault. `size.scaleUp` is read
/// already. A file that it reads is added to `files`.
void readSieve(CaseReader& reader, Section& section, SizeDistribution& size, std::vector<std::filesystem::path>& files);
/// The number distribution that such a table makes, in words.
std::string sieveDerivation(const SizeDistribution& size);

// read_contact.cpp, read_luding.cpp, read_elastic.cpp
/// Gives the tables that readContact reads their place in the resolved case, before those of the apparatus. Call after
/// readMaterials.
void placeContact(CaseReader& reader, Section& root, const Case& c);
/// Reads contacts and the adhesion of settling. Call after readParticles, readBoundaries and readCoil: parameters may
/// follow from the weight of the bed.
void readContact(CaseReader& reader, Section& root, const MaterialTables& materials, Case& c);

// read_apparatus.cpp
/// A direction from the file as a unit vector; a zero vector is a fault.
Vec3 readDirection(CaseReader& reader, Section& section, const char* key);
/// Reads the boundaries. Returns nothing if their kind itself is at fault.
std::optional<Boundaries> readBoundaries(CaseReader& reader, Section& root, Case& c);
void readCoil(CaseReader& reader, Section& root, Case& c);
void readSchedule(CaseReader& reader, Section& root, Case& c);
/// Reads time step and skin if the file states them; 0 stands for a value that is computed later.
void readTime(CaseReader& reader, Section& root, Case& c);
/// True when the file states a domain.
bool readDomain(Section& root, Case& c);

// read_bodies.cpp
/// Reads the bodies. `meshReach` [m] is that for which meshes are made (MeshSurface); NaN if it is not known. Call
/// after the particles.
void readBodies(CaseReader& reader, Section& root, double meshReach, Case& c);
/// The angle of the drive is that of the coil, which may turn in the negative sense. A body's own turn is positive
/// about its axis while powder is dosed. Call after readBodies and readCoil.
void alignWithDrive(Case& c);

// read_motion.cpp
/// Reads the motion of a body whose shape and place are known.
void readMotion(CaseReader& reader, Section& body, RigidBody& made);

// read_names.cpp
/// Reads the name of a body, region, refill or measure (`kind`), which may stand before the name of a column: at most
/// 60 letters, digits, - and _. It is a fault if `names`, to which it is added, holds it already. Without `standard`
/// the name is required.
std::string readName(CaseReader& reader, Section& section, const std::string& kind, std::set<std::string>& names,
                     std::optional<std::string> standard = std::nullopt);
/// The place of the name among the known ones, which are those of the tables [[kind]]. A fault of the key at `path` if
/// it is not there.
std::optional<std::size_t> placeOf(CaseReader& reader, const std::string& path, const std::string& name,
                                   const std::vector<std::string>& known, const char* kind);
/// The same among World::bodies.
std::optional<std::size_t> placeOfBody(CaseReader& reader, const std::string& path, const std::string& name,
                                       const Case& c);
/// The same for the key `region` among World::regions; the first after a fault.
std::size_t readRegionName(CaseReader& reader, Section& section, const Case& c);

// read_regions.cpp
/// Reads the regions. Call after readBoundaries, whose outlet they may replace, and readBodies.
void readRegions(CaseReader& reader, Section& root, Case& c);

// read_field.cpp
/// Reads the fields. Call after boundaries and sensors. The mean diameter [m] is the default width of the kernels; NaN
/// if it is not known.
void readFields(CaseReader& reader, Section& root, double meanDiameter, Case& c);

// read_measure.cpp
/// Reads the measures. Call after bodies and frames.
void readMeasures(CaseReader& reader, Section& root, Case& c);

}  // namespace vkdose
