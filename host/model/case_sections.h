#pragma once
// What each table of a case says. A reader takes what it needs of other tables and returns what its own says, so that
// none can be called too early. readCase calls them all, and resolveCase works out what follows. Faults go to the
// CaseReader.

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "host/model/case.h"
#include "host/model/case_reader.h"
#include "host/model/particle_list.h"

namespace vkdose {

// ---- read_powder.cpp, read_materials.cpp, read_sieve.cpp ------------------------------------------------------------

/// What tables tell beside their values, as Case::files and Case::derivations have it.
struct Told {
    std::vector<std::filesystem::path> files;
    std::vector<std::string> derivations;
};

/// The tables [[material]], by the index of their material.
using MaterialTables = std::map<int, Section*>;

/// [particles], [[powder]] and [[material]], but for the places where the powders start.
struct PowdersRead {
    std::vector<Material> materials = World{}.materials;
    MaterialTables tables;
    Filling filling;
    std::vector<Powder> further;
    bool mixed = false;
    Told told;

    /// Names and materials, in the order of the file.
    std::vector<ListedPowder> named() const;
};
PowdersRead readPowders(CaseReader& reader, Section& root);

/// Reads the size distribution of a table [particles.size] or [powder.size].
SizeDistribution readSize(CaseReader& reader, Section& section, Told& told);
/// Reads the table of a sieve analysis into `size.sieve`, which stays empty after a fault. `size.scaleUp` is read
/// already. A file that it reads is added to `files`.
void readSieve(CaseReader& reader, Section& section, SizeDistribution& size, std::vector<std::filesystem::path>& files);
/// The number distribution that such a table makes, in words.
std::string sieveDerivation(const SizeDistribution& size);

// ---- read_apparatus.cpp ---------------------------------------------------------------------------------------------

enum class Boundaries { Canister, List, None };

/// `boundaries` and the tables of the walls.
struct WallsRead {
    std::optional<Boundaries> kind;  ///< none: it is at fault itself
    std::optional<Canister> canister;
    std::vector<Wall> walls;
    double throatZ = kInfinity, outletZ = kInfinity;  ///< as in World [m]
};
WallsRead readBoundaries(CaseReader& reader, Section& root, const std::vector<Material>& materials);

struct CoilRead {
    std::optional<geometry::Coil> coil;
    bool surfaceMoves = true, wireCurved = false;  ///< World::coilSurfaceMoves, World::coilWireCurved
    double speed = 0;                              ///< Schedule::coilSpeed [rad/s]
};
CoilRead readCoil(CaseReader& reader, Section& root, const std::optional<Canister>& canister);

/// A direction from the file as a unit vector; a zero vector is a fault.
Vec3 readDirection(CaseReader& reader, Section& section, const char* key);

// ---- read_bodies.cpp, read_motion.cpp -------------------------------------------------------------------------------

struct BodiesRead {
    std::vector<RigidBody> bodies;
    std::vector<std::pair<std::size_t, std::string>> mended;  ///< Case::mendedMeshes
    std::vector<std::filesystem::path> files;
};
/// `meshReach` [m] is that for which meshes are made (MeshSurface). Without it no meshes are made, only looked at.
BodiesRead readBodies(CaseReader& reader, Section& root, const std::vector<Material>& materials,
                      std::optional<double> meshReach);
/// The angle of the drive is that of the coil, which may turn in the negative sense. A body's own turn is positive
/// about its axis while powder is dosed.
void alignWithDrive(const std::optional<geometry::Coil>& coil, std::vector<RigidBody>& bodies);
/// Reads the motion of a body whose shape and place are known.
void readMotion(CaseReader& reader, Section& body, RigidBody& made);

// ---- read_regions.cpp -----------------------------------------------------------------------------------------------

std::vector<CountRegion> readRegions(CaseReader& reader, Section& root, const std::vector<RigidBody>& bodies);

// ---- read_contact.cpp, read_luding.cpp, read_elastic.cpp ------------------------------------------------------------

/// Gives the tables that readContact reads their place in the resolved case, before those of the apparatus.
void placeContact(CaseReader& reader, Section& root, const World& world);
/// Reads contacts and the adhesion of settling into a case whose powders, walls and coil are known: parameters may
/// follow from the weight of the bed.
void readContact(CaseReader& reader, Section& root, const MaterialTables& tables, Case& c);

// ---- read_powder.cpp ------------------------------------------------------------------------------------------------

/// Where the powders start.
struct StartRead {
    Box region;                       ///< Filling::region of the first powder
    std::vector<std::size_t> vessel;  ///< Filling::vessel
    std::vector<Box> further;         ///< the regions of the further powders; empty: they are in that of the first
};
/// By default a canister is filled above its coil, or above the bodies that follow the drive and so stand in its place.
StartRead readStart(CaseReader& reader, Section& root, const PowdersRead& powders, const WallsRead& walls,
                    const std::optional<geometry::Coil>& coil, const std::vector<RigidBody>& bodies);

// ---- read_schedule.cpp ----------------------------------------------------------------------------------------------

/// [settle] (its time), [dose], [stop], [sensors], [frames], [checkpoint]: members of Case and World.
struct ScheduleRead {
    Schedule schedule;
    double sensorInterval = 0, rateWindow = 0;  ///< [s]
    bool energyBook = false, wallLoads = false;
    FrameStorage frames;
    CheckpointInterval checkpoint;
};
ScheduleRead readSchedule(CaseReader& reader, Section& root, const WallsRead& walls, const CoilRead& coil,
                          const std::vector<RigidBody>& bodies);

/// [time]. What the file does not state, or leaves to the program, is not there.
struct TimeRead {
    std::optional<double> step, skin;       ///< [s], [m]
    std::optional<double> stepsPerContact;  ///< Case::stepsPerContact
};
TimeRead readTime(CaseReader& reader, Section& root);

struct DomainRead {
    Box box;
    Vec3 period{0};  ///< World::period
};
/// None if the file states no domain.
std::optional<DomainRead> readDomain(Section& root);

// ---- read_refills.cpp, read_field.cpp, read_measure.cpp -------------------------------------------------------------

std::vector<Refill> readRefills(CaseReader& reader, Section& root, const PowdersRead& powders,
                                const std::vector<CountRegion>& regions, const Schedule& schedule);

/// The mean diameter [m] is the default width of the kernels. Without it, after a fault, there is no default.
std::vector<FieldSensor> readFields(CaseReader& reader, Section& root, const std::vector<ListedPowder>& powders,
                                    const std::optional<Canister>& canister, double sensorInterval,
                                    std::optional<double> meanDiameter);

/// Gravity, bodies and regions of `world` are known.
std::vector<ElementTest> readMeasures(CaseReader& reader, Section& root, const World& world,
                                      const FrameStorage& frames);

// ---- read_case.cpp, resolve_case.cpp --------------------------------------------------------------------------------

/// A case as its file says it. What the file leaves open is not yet in `c`: time step, skin, domain, lid, shared
/// places.
struct CaseRead {
    Case c;
    TimeRead time;
    std::optional<DomainRead> domain;
};
/// Reads all tables. After a fault the values are unspecified.
CaseRead readCase(CaseReader& reader, const std::filesystem::path& file);
/// Works out what follows from a case without faults, and checks it. Throws CaseError.
Case resolveCase(CaseReader& reader, CaseRead read);
/// The largest distance from a centre at which a backend asks for a mesh: within the skin and the longest reach of a
/// contact [m]. The factor covers the rounding of a skin that is read back. Without `skin` it is the usual one.
double meshReach(const Case& c, std::optional<double> skin, double contactReach);

// ---- read_names.cpp -------------------------------------------------------------------------------------------------

/// Reads the name of a body, region, refill or measure (`kind`), which may stand before the name of a column: at most
/// 60 letters, digits, - and _. It is a fault if `names`, to which it is added, holds it already. Without `standard`
/// the name is required.
std::string readName(CaseReader& reader, Section& section, const std::string& kind, std::set<std::string>& names,
                     std::optional<std::string> standard = std::nullopt);
/// The place of the name among the bodies. A fault of the key at `path` if it is not there.
std::optional<std::size_t> placeOfBody(CaseReader& reader, const std::string& path, const std::string& name,
                                       const std::vector<RigidBody>& bodies);
/// Place among the regions of the one that the key `region` names; the first after a fault.
std::size_t readRegionName(CaseReader& reader, Section& section, const std::vector<CountRegion>& regions);
/// Index of the material of a wall or body that the key `material` of its table names; `usual` if the table does not
/// have it.
int readMaterialName(CaseReader& reader, Section& section, const std::vector<Material>& materials, int usual);
/// The material of the powder that the key `powder` names, if the table has the key.
std::optional<int> readPowderName(CaseReader& reader, Section& section, const std::vector<ListedPowder>& powders);

}  // namespace vkdose
