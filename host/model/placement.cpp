// Checks particles at the start: where they are, what they touch and how they move.
#include <fmt/format.h>

#include <algorithm>

#include "host/model/checks.h"
#include "host/model/clearance.h"
#include "host/model/overlaps.h"

namespace vkdose {
namespace {

/// Reports up to a handful of faults of one kind, then says how many more there are.
class Few {
  public:
    Few(CaseReader& reader, std::string path) : reader_(reader), path_(std::move(path)) {}
    void add(std::string problem, std::string remedy) {
        if (++count_ <= kShown) reader_.fault(path_, std::move(problem), std::move(remedy));
    }
    ~Few() {
        if (count_ > kShown)
            reader_.fault(path_, fmt::format("{} more particles like this", count_ - kShown), "correct them as well");
    }
    Few(const Few&) = delete;
    Few& operator=(const Few&) = delete;

  private:
    static constexpr int kShown = 5;
    CaseReader& reader_;
    std::string path_;
    int count_ = 0;
};

std::string named(const Particles& p, std::size_t i) {
    const Vec3 x = p.position[i] * 1e3;
    return fmt::format("particle {} at ({:.4g}, {:.4g}, {:.4g}) mm", i, x.x, x.y, x.z);
}

void checkDomain(CaseReader& reader, const Case& c, const Particles& p, const std::string& path) {
    Few faults(reader, path);
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Vec3 x = p.position[i];
        const Vec3 beyond = 1e-5 * c.world.period;  // a device takes a particle back into the domain some steps later
        const bool inside = glm::all(glm::greaterThanEqual(x, c.world.domain.low - beyond)) &&
                            glm::all(glm::lessThanEqual(x, c.world.domain.high + beyond));
        if (!inside)
            faults.add(named(p, i) + " is outside the domain", "move it or widen [domain]");
        else if (x.z > c.world.outletZ)
            faults.add(named(p, i) + " is past the outlet", "place it in the canister");
        else if (c.world.doses(x))
            faults.add(named(p, i) + " is in a region that deletes", "place it outside, or set deletes = false");
    }
}

/// The cure for a grid of particles that a body stands in.
std::string freePlace(const Case& c) {
    return c.canister ? "move the body, or let the fill start above it by particles.drop_mm"
                      : "move the body, or give a [particles.region] that is free of it";
}

/// Checks the overlap with the walls and the coil. Particles on the grid must not overlap at all. Listed ones may a
/// little, because a list may be a settled bed.
void checkWalls(CaseReader& reader, const Case& c, const Particles& p, const std::string& path, double allowed) {
    Few faults(reader, path);
    const Clearance around(c.world);
    for (std::size_t i = 0; i < p.size(); ++i) {
        const auto [distance, what] = around.nearest(p.position[i], p.radius[i]);
        const double overlap = p.radius[i] - distance;
        // The bed that a run left lies around the coil as it stood at the run's end.
        const char* turn = c.filling.list && what == "the coil"
                               ? "; if a run left this bed, turn the coil to where it stood: add the coil_angle_rad of "
                                 "the run's summary.json, in degrees, to coil.start_angle_deg"
                               : "";
        if (overlap > allowed * p.radius[i])
            faults.add(fmt::format("{} overlaps {} by {:.3g} of its radius", named(p, i), what, overlap / p.radius[i]),
                       c.filling.list ? fmt::format("keep the overlap below {}{}", allowed, turn) : freePlace(c));
    }
}

/// Checks the way of a particle in one step: a particle that passes another within one step never touches it.
void checkMotion(CaseReader& reader, const Case& c, const Particles& p, const std::string& path) {
    Few faults(reader, path);
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (glm::length(p.velocity[i]) * c.world.timeStep > p.radius[i])
            faults.add(named(p, i) + " moves by more than its radius in a time step", "give its velocity in m/s");
        if (glm::length(p.spin[i]) * c.world.timeStep > 1)
            faults.add(named(p, i) + " turns by more than a radian in a time step", "give its spin in rad/s");
    }
}

/// Overlaps among the particles of more than `allowed` of the smaller radius.
void checkPairs(CaseReader& reader, const World& world, const Particles& p, const std::string& path, double allowed,
                const std::string& remedy) {
    Few faults(reader, path);
    forEachOverlap(world, p, [&](std::size_t i, std::size_t j, double ratio) {
        if (ratio > allowed)
            faults.add(fmt::format("{} overlaps particle {} by {:.3g} of the smaller radius", named(p, std::min(i, j)),
                                   std::max(i, j), ratio),
                       remedy);
    });
}

}  // namespace

void checkPlacement(CaseReader& reader, const Case& c, const Particles& particles) {
    const std::string path = c.filling.list ? "particles.list" : c.canister ? "particles.mass_g" : "particles.region";
    checkDomain(reader, c, particles, path);
    checkWalls(reader, c, particles, path, c.filling.list ? kMaxOverlapRatio : 0.0);
    if (c.filling.list) {
        checkMotion(reader, c, particles, path);
        checkPairs(reader, c.world, particles, path, kMaxOverlapRatio,
                   fmt::format("keep the overlap below {}", kMaxOverlapRatio));
    } else if (!c.canister && !c.mixed && !c.furtherPowders.empty()) {
        // A grid keeps its particles apart and at rest; those of two powders may stand in one place.
        checkPairs(reader, c.world, particles, "powder[0].region", 0, "give each powder a region of its own");
    }
}

}  // namespace vkdose
