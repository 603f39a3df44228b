#pragma once
// The world that a backend simulates, free of file formats: surfaces, coil, time step. Built from a Case by
// model/case.h, or by hand in tests.

#include <limits>
#include <optional>
#include <vector>

#include "geometry/coil.h"
#include "geometry/surface.h"
#include "host/core/vec.h"
#include "host/model/material.h"

namespace vkdose {

/// Axis-aligned box outside which a particle counts as lost.
struct Box {
    Vec3 low{-1.0};
    Vec3 high{1.0};
};

/// Overlap over smaller radius above which a run stops unless the case says otherwise: no contact law here was made
/// for more.
inline constexpr double kMaxOverlapRatio = 0.2;

/// One member: a canister (or any set of surfaces) and its powder, without what changes from phase to phase of a run:
/// the law of its contacts, which may be another while the powder settles, and the coil's speed.
struct World {
    /// Contact history is kept per (particle, surface). Walls that end at a front wall come before it, which is the
    /// last: it takes over their contacts, and they its.
    std::vector<geometry::Surface> surfaces;
    std::optional<geometry::Coil> coil;
    Vec3 gravity{0, -9.81, 0};
    double density = 0;   ///< of the particles [kg/m3]
    double timeStep = 0;  ///< [s]
    double skin = 0;      ///< extra reach of the neighbour list [m]
    double maxOverlapRatio = kMaxOverlapRatio;
    bool energyBook = false;  ///< keep the energy book (Sensors::energy)
    Box domain;
    /// A particle whose centre passes throatZ is in the throat, past outletZ it is dosed. Infinite: no outlet.
    double throatZ = std::numeric_limits<double>::infinity();
    double outletZ = std::numeric_limits<double>::infinity();
};

/// A world with the one law that holds in it from beginning to end, as in tests and benchmarks.
struct RuledWorld : World {
    ContactLaw law;
};

/// Turns of the coil one sphere may touch at once: the slots a backend keeps contact history for.
inline constexpr int kMaxCoilTouches = 4;

}  // namespace vkdose
