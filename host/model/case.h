#pragma once
// A validated case: everything a run needs, in SI. `loadCase` is the only way from a TOML file to it.

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/model/case_tree.h"
#include "host/model/element_test.h"
#include "host/model/field.h"
#include "host/model/grid.h"
#include "host/model/particles.h"
#include "host/model/world.h"

namespace vkdose {

/// A sieve, after scaling.
struct SievePoint {
    double radius = 0;  ///< half of its opening [m]
    double finer = 0;   ///< fraction of the powder's volume that passes it
};

/// Sizes of the inserted particles (radii, metres).
struct SizeDistribution {
    enum class Kind { Uniform, Fixed, Normal, Lognormal, Quantiles, Sieve };
    Kind kind = Kind::Fixed;
    double radius = 0;     ///< Fixed: the radius; Normal: the mean; Lognormal: the median
    double deviation = 0;  ///< Normal: standard deviation [m]; Lognormal: of ln(radius) [-]
    double radiusMin = 0;  ///< Uniform: bounds; the others: truncation (draws outside are drawn again)
    double radiusMax = 0;
    double r10 = 0, r50 = 0, r90 = 0;  ///< Quantiles (by volume): radii of the spheres
    std::vector<SievePoint> sieve;     ///< Sieve: from fine to coarse, from 0 to 1
    double scaleUp = 1;                ///< size of a sphere over that of a grain; all other members are of spheres
};

/// The origin of the particles: drawn and put on a grid, or listed in a CSV.
struct Filling {
    double mass = 0;  ///< target [kg]; 0 with an explicit list
    SizeDistribution size;
    std::optional<Particles> list;
    double gridGap = kGridGap;  ///< play between the largest spheres of the grid, as a fraction of their diameter
    Box region;                 ///< of the grid, open upwards in a canister (high.y infinite); unused with a list
    /// To which the settled powder fills its vessel, over the lowest point of it [m]: `mass` follows.
    std::optional<double> height;
    /// The bodies that it is inside of, places in World::bodies. Empty: it takes all of the region.
    std::vector<std::size_t> vessel;
    std::shared_ptr<const std::vector<std::uint64_t>> sites;  ///< of the grid those in the vessel; null without one
};

/// A powder beside that of [particles].
struct Powder {
    std::string name;  ///< of its columns
    int material = 0;  ///< World::materials; of no other powder, and of no wall or body
    Filling filling;   ///< without a list: that of Case::filling holds the particles of all powders
};

/// Powder that is added while the run goes on: spheres of the sizes of its powder, on a grid over the powder that is
/// there. Without a time, a dose or a mark it waits for an order.
struct Refill {
    std::string name;
    std::size_t table = 0;               ///< its [[refill]]; one with `times` gives as many refills
    bool again = false;                  ///< it comes after the one before it, which is of the same table
    int material = kFirstPowder;         ///< of its powder
    double mass = 0;                     ///< target [kg]
    std::optional<double> time;          ///< it is added at the first reading of the sensors that is not earlier [s]
    std::optional<int> beforeDose;       ///< it is added before this dose begins
    std::optional<double> below;         ///< it is added when the powder that is watched falls below this mass [kg]
    std::optional<std::size_t> watched;  ///< the region whose content that is; else all powder that is not dosed

    /// The case adds it; else it waits for an order.
    bool planned() const { return time || beforeDose || below; }
};

/// The rules that end a run. The first one that is met ends it.
struct StopRule {
    /// Paper: experiments stop when the cumulative mass changes by no more than `threshold` over `doses` consecutive
    /// doses; simulations when it does not change at all (threshold 0).
    enum class Kind { None, Experiment, Simulation };
    Kind kind = Kind::Experiment;
    double threshold = 0.15e-3;  ///< [kg]
    int doses = 3;
    int maxDoses = std::numeric_limits<int>::max();
    double endTime = std::numeric_limits<double>::infinity();  ///< simulated time, settling included [s]
};

/// A part of a dose to a mass, with a speed of its own.
struct DoseStage {
    double speed = 0;  ///< conveying speed >= 0 [rad/s]
    double until = 0;  ///< fraction of the target at which it ends
};

struct Schedule {
    double settleTime = 0;           ///< [s]; with `untilRest` the longest
    bool untilRest = false;          ///< the settling ends as soon as the bed rests
    double restSpeedRatio = 0.01;    ///< speed of a bed at rest, over that of a fall from the fill's height [-]
    double settleGravityFactor = 1;  ///< gravity while the powder settles, over World::gravity [-]
    double rotateTime = 0;  ///< t_d, ramps included [s]; 0: no doses, the run is the settling; to a mass: the longest
    double restTime = 0;    ///< [s]
    double coilSpeed = 0;   ///< conveying speed >= 0 [rad/s]; with stages that after the last one
    double targetMass = 0;  ///< the coil is told to stop once a dose has as much [kg]; 0: it turns for `rotateTime`
    std::vector<DoseStage> stages;  ///< by rising `until`
    double rampTime = 0;            ///< every change of the coil's speed takes so long [s]
    double reverseTurns = 0;        ///< by which the coil turns back after each rotation, at `coilSpeed`
    double maxTorque = std::numeric_limits<double>::infinity();  ///< of the drive, mean over a sensor interval [N m]
    bool torqueEndsRun = false;                                  ///< a larger one ends the run, not only the rotation
    StopRule stop;

    double fastestSpeed() const;  ///< of all stages and of `coilSpeed` [rad/s]
    double reverseTime() const;   ///< of turning back, ramps included [s]
    /// Whether every dose turns for the same time at one speed.
    bool isPlain() const;
};

/// Dimensions of the canister, kept beside the surfaces made from them for predictions and messages [m].
struct Canister {
    double length = 0;  ///< L, along z
    double width = 0;   ///< W, along x; also the trough's diameter
    double height = 0;  ///< H, from the lowest point of the floor
    double outletDiameter = 0;
    double throatLength = 0;
    bool flatFloor = false;
    bool lid = false;  ///< closed at the top, or above the fill if the loose grid is higher than the top
};

/// Where a sphere touches two things in one and the same place (shared_places.h).
struct SharedPlace {
    /// Bodies by their index; a wall by the number of bodies and its index. The first is a body, below the second.
    std::size_t first = 0, second = 0;
    bool area = false;  ///< the two coincide around the place too; else along a seam, or in a point
    Vec3 centre{0};     ///< of a sphere that touches both [m]
};

/// No window of the mass rate is shorter than so many sensor intervals: the mass is known at the ends of these only.
inline constexpr int kFewestRateIntervals = 5;

/// The time between two checkpoints, with which a run can go on after an interruption. 0: not by this clock.
struct CheckpointInterval {
    double wall = 300;     ///< of wall time [s]
    double simulated = 0;  ///< of simulated time [s]
};

/// Which frames of a run are stored.
struct FrameStorage {
    double interval = 0;    ///< [s], a whole number of sensor intervals after loading; 0: none
    bool contacts = false;  ///< store the contacts as well, not only their effect on each particle
    bool states = false;    ///< store the state of the run with each frame, for other runs to begin with
};

struct Case {
    std::string name;
    std::string reason;
    std::uint64_t seed = 1;
    World world;
    ContactLaw settlingLaw;                 ///< of the contacts while the powder settles
    ContactLaw dosingLaw;                   ///< from the first dose on
    std::optional<double> stepsPerContact;  ///< least number of time steps in the fastest mode (stability.h), if stated
    double softened = 1;                    ///< by which factor both laws are softer than the file's parameters
    std::optional<Canister> canister;       ///< absent for free boundaries
    Filling filling;                        ///< of the first powder; a list holds the particles of all
    std::vector<Powder> furtherPowders;
    bool mixed = false;  ///< all powders start at random places of one grid, in the region of the first
    std::vector<Refill> refills;
    Schedule schedule;
    double sensorInterval = 0;  ///< [s], a whole number of steps after loading
    double rateWindow = 0;      ///< of the mass rate over time [s]; 0: as the drive tells (mass_rate.h)
    CheckpointInterval checkpoint;
    FrameStorage frames;
    std::vector<FieldSensor> fields;        ///< taken while the run goes on
    std::vector<SharedPlace> sharedPlaces;  ///< for the smallest sphere
    std::vector<ElementTest> measures;      ///< figures of the powder, taken when the run is over
    double bulkDensity = 471;               ///< rho_b for the closed form [kg/m3]; an estimate if it is measured
    bool bulkDensityMeasured = false;       ///< once the bed has settled, its own density is rho_b
    /// Values that follow from others that the file gives in their place, in words: "contact: damping = 0.02 kg/s from
    /// restitution = 0.5 of slow impacts".
    std::vector<std::string> derivations;
    /// What was mended in the mesh of a body: its number and the words for it.
    std::vector<std::pair<std::size_t, std::string>> mendedMeshes;
    /// What single precision changes most of the answers of a user's law. Absent without such a law.
    std::optional<LawRounding> lawRounding;
    std::string resolved;                      ///< the case as TOML with every default and --set applied
    std::string given;                         ///< as TOML, `base` and --set in it, without what follows from it
    std::vector<std::filesystem::path> files;  ///< read for this case: the case file, its bases, the particle list

    /// Gravity while the powder settles [m/s2].
    Vec3 settlingGravity() const { return schedule.settleGravityFactor * world.gravity; }
    /// The world while the powder settles: a backend is loaded with it.
    World settlingWorld() const {
        World settling = world;
        settling.gravity = settlingGravity();
        return settling;
    }
};

/// Reads, resolves `overrides` ("key.path=value"), checks. Throws CaseError with every fault found.
Case loadCase(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The same with several layers of overrides. Each layer overrides the one before, and each value knows where it was
/// written.
Case loadVariant(const std::filesystem::path& file, std::vector<Node> layers);

/// The same for the text of a case that names no base: `Case::resolved`, `Case::given` or a new one. Messages and paths
/// treat it as the content of `file`.
Case loadResolvedCase(const std::string& text, const std::filesystem::path& file,
                      const std::vector<std::string>& overrides = {});

/// Draws (or copies) the particles of a case: sizes from the distribution until the target mass is met as closely as
/// one particle allows, positions on a grid above the coil without overlap. Same case, same particles.
struct Insertion {
    Particles particles;
    double mass = 0;            ///< of all particles [kg]
    double targetMass = 0;      ///< [kg]
    std::uint64_t redrawn = 0;  ///< draws outside the truncation bounds (Normal, Lognormal)
    double cutBelow = 0;        ///< Quantiles, Sieve: mass fraction of the powder finer than the lower bound [-]
    double cutAbove = 0;        ///< Quantiles, Sieve: mass fraction coarser than the upper bound [-]
    double fillHeight = 0;      ///< top of the grid, or of a list's highest sphere [m, y]

    /// What the fill has of one powder.
    struct Share {
        std::size_t particles = 0;
        double mass = 0, targetMass = 0;  ///< [kg]
    };
    std::vector<Share> powders;  ///< in the order of the case

    /// The powder of a refill. Its particles wait; they stand on the grid as it would be without any powder.
    struct Waiting {
        Particles particles;
        double mass = 0;    ///< [kg]
        double height = 0;  ///< of the grid [m]
    };
    std::vector<Waiting> waiting;  ///< of each refill of the case

    /// Those of the filling, then those of each refill. A backend is loaded with them.
    Particles allParticles() const;
    /// Index of the first particle of a refill.
    std::size_t firstOf(std::size_t refill) const;
};
Insertion insertParticles(const Case& c);
/// How many particles the mass of each powder of a case without a list takes, exactly; those of refills are not among
/// them.
std::vector<std::size_t> drawnParticles(const Case& c);

/// Contact duration of the reduced mass m12 [kg] on stiffness k [N/m]: pi / sqrt(k/m12 - (gamma/(2 m12))^2).
double contactDuration(const ContactParameters& p, double mass, double k);

/// Closed forms and stability figures of a case (paper, sections on the coil and on parameters).
struct Derived {
    struct PairDuration {
        std::string name;  ///< of the pair of materials: "particle-particle", "particle-wall"
        double mean;       ///< two mean particles (or one and the wall) on k1 [s]
        double stiffest;   ///< the smallest on k2Max, undamped (the shorter, so the safe figure) [s]
    };
    std::vector<PairDuration> durations;
    double stiffest = 0;  ///< smallest of all [s]
    double timeStep = 0;  ///< [s]
    std::size_t particles = 0;
    double fillMass = 0;                 ///< inserted [kg]
    double pushVelocity = 0;             ///< V_z = p Omega / 2 pi [m/s]
    double tipVelocity = 0;              ///< V_t = Omega r_c [m/s]
    double massPerTurn = 0;              ///< of the drive: rho_b p pi r_c^2, or that of bodies (conveyors.h) [kg]
    double massPerSecond = 0;            ///< of bodies that turn by themselves, and not by the drive [kg/s]
    bool turnsInRests = false;           ///< these turn for the whole dose; else while it rotates
    std::vector<std::string> conveyors;  ///< the bodies that the closed form counts; none with [coil]
    double massPerDose = 0;  ///< that of its turns, n_t, or of its time; at most the target of a dose to a mass [kg]
    double doses = 0;        ///< m_tot / m_dose
    double steps = 0;        ///< until the predicted last dose plus the stop rule's
    /// Particle-steps until then. Refills at a time or before a dose count from then on; those at a mark, whose time
    /// nobody knows, do not count. What leaves by the closed form counts until then.
    double work = 0;
    bool countsLeaving = true;  ///< false: powder can leave, and nobody knows how much is inside: all of it counts

    /// Whether there is a closed form.
    bool conveys() const { return massPerTurn > 0 || massPerSecond > 0; }
    /// What it carries in a second while it turns, at this speed of the drive [rad/s] [kg/s].
    double rate(double driveSpeed) const { return massPerTurn * driveSpeed / (2 * kPi) + massPerSecond; }
};
Derived derive(const Case& c, const Insertion& filled);

}  // namespace vkdose
