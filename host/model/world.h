#pragma once
// The world that a backend simulates, free of file formats: walls, coil, bodies, time step. Built from a Case by
// model/case.h, or by hand in tests.

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "geometry/coil.h"
#include "host/core/vec.h"
#include "host/model/material.h"
#include "host/model/particles.h"
#include "host/model/region.h"
#include "host/model/rigid_body.h"
#include "host/model/wall.h"

namespace vkdose {

/// Axis-aligned box outside which a particle counts as lost.
struct Box {
    Vec3 low{-1.0};
    Vec3 high{1.0};
};

/// A way [m] without whole periods, so that it is the shortest. Directions of period 0 do not repeat.
inline Vec3 shortest(Vec3 way, const Vec3& period) {
    for (int d = 0; d < 3; ++d)
        if (period[d] > 0) way[d] -= period[d] * std::round(way[d] / period[d]);
    return way;
}

/// The ways from a place to its images, one period away or none in each direction, but for the place itself [m].
std::vector<Vec3> imageShifts(const Vec3& period);

/// Overlap over smaller radius above which a run stops, unless the case gives another limit. The contact laws here are
/// not made for larger overlaps.
inline constexpr double kMaxOverlapRatio = 0.2;

/// One member: a canister (or any set of walls and bodies) and its powder. It leaves out the two things that change
/// from phase to phase of a run: the coil's speed, and the law of the contacts, which may be another while the powder
/// settles.
struct World {
    /// Contact history is kept per (particle, wall). A front wall is the last one, so that walls that end at it come
    /// before it. It takes over contacts from them, and they take over contacts from it.
    std::vector<Wall> walls;
    bool wallLoads = false;  ///< backends tell what the particles do to each wall, as they do for bodies
    std::optional<geometry::Coil> coil;
    std::vector<RigidBody> bodies;  ///< beside walls and coil; at most kMaxBodies
    bool coilSurfaceMoves = true;   ///< contacts see the velocity of the coil's surface; false: they see it at rest
    bool coilWireCurved = false;    ///< a* counts the wire's radius; false: the wire is as flat as a wall
    Vec3 gravity{0, -9.81, 0};
    double timeStep = 0;  ///< [s]
    double skin = 0;      ///< extra reach of the neighbour list [m]
    double maxOverlapRatio = kMaxOverlapRatio;
    bool energyBook = false;  ///< keep the energy book (Sensors::energy)
    Box domain;
    /// Length of the domain in directions that repeat, else 0; at most two repeat [m]. A particle that leaves the
    /// domain at one end comes in at the other. Bodies and walls are as they are drawn: they are to repeat by
    /// themselves.
    Vec3 period{0};
    /// A particle is in the throat if its centre is past throatZ. It is dosed if its centre is past outletZ or in a
    /// region that deletes. Infinite: no throat, no such plane.
    double throatZ = std::numeric_limits<double>::infinity();
    double outletZ = std::numeric_limits<double>::infinity();
    std::vector<CountRegion> regions;  ///< at most kMaxRegions
    /// Particles, walls and bodies name theirs by its index; at most kMostMaterials.
    std::vector<Material> materials{{"particle", true, 0}, {"wall", false, 0}, {"coil", false, 0}};

    std::vector<std::string> properties;  ///< names of what a user's law gives each particle

    /// Of a powder's particles [kg/m3].
    double density(int material = kFirstPowder) const { return materials.at(std::size_t(material)).density; }
    double& density(int material = kFirstPowder) { return materials.at(std::size_t(material)).density; }
    bool repeats() const { return period != Vec3(0); }
    /// A way between two places of the domain, by the shortest image [m].
    Vec3 shortest(const Vec3& way) const { return vkdose::shortest(way, period); }
    bool doses(const Vec3& x) const {
        for (const CountRegion& region : regions)
            if (region.deletes && region.holds(x)) return true;
        return x.z > outletZ;
    }
};

/// A world together with a single contact law that holds from beginning to end, as in tests and benchmarks.
struct RuledWorld : World {
    ContactLaw law;
};

/// Of particle i [kg].
inline double massOf(const World& world, const Particles& particles, std::size_t i) {
    return sphereMass(world.density(particles.material[i]), particles.radius[i]);
}

/// Where particle i would be if no direction repeated [m].
inline Vec3 unfolded(const World& world, const Particles& particles, std::size_t i) {
    return particles.gone.empty() ? particles.position[i]
                                  : particles.position[i] + Vec3(particles.gone[i]) * world.period;
}

/// The powders, ascending.
std::vector<int> powdersOf(const World& world);
/// The pairs of materials whose contacts can occur: of two powders, and of a powder with a wall, a body or the coil.
/// Ascending by the powder, then by the other; a pair of two powders is there once.
std::vector<MaterialPair> occurringPairs(const World& world);

/// The longest reach of any contact that can occur, of spheres no larger than `largest` [m], also with walls.
double longestReach(const World& world, const ContactLaw& law, double largest);
/// What a backend says of a law whose contacts reach farther than those of the law that was loaded.
inline constexpr const char* kReachesFarther = "the new law of the contacts reaches farther than the loaded one";
/// Throws std::logic_error if the law has no parameters for a material of the world, if a particle is of no powder of
/// it, or if there are more materials than a backend holds: whoever made them has not checked them.
void checkMaterials(const World& world, const ContactLaw& law, const Particles& particles);
/// Name of a pair in messages: "particle-wall", ...
std::string nameOf(const World& world, MaterialPair pair);

/// The name of World::coil among the bodies.
inline constexpr const char* kCoilName = "coil";
/// All that moves or may move: World::bodies, and behind them the coil, which the drive turns.
std::vector<RigidBody> allBodies(const World& world);
/// The names of all whose loads a backend tells: of allBodies, in their order, then of the walls if World::wallLoads.
std::vector<std::string> loadNames(const World& world);

/// Most turns of the coil that one sphere may touch at once: a backend keeps contact history for as many places of a
/// body.
inline constexpr int kMaxCoilTouches = 4;

}  // namespace vkdose
