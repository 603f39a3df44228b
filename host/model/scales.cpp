// Whether the numbers of a case go together: what a device keeps in single precision, and what may happen in one step.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "host/model/checks.h"
#include "host/model/powders.h"

namespace vkdose {
namespace {

/// Masses and moments of inertia outside these are not normal single-precision numbers, with room for a factor or two.
constexpr double kSmallestFloat = 1e-36;
constexpr double kLargestFloat = 1e36;
/// Largest distance over radius. A position is kept to 48 bits. At this distance it is still known to 1e-7 of the
/// radius, the accuracy that an overlap needs.
constexpr double kFarthestOverRadius = 1e7;
/// Longest way in one step, in units of the smallest radius. On a longer way a particle could pass another without
/// touching it.
constexpr double kLongestWay = 0.1;
/// Widest skin. It gives more neighbours than any row holds, but does not yet pair every particle with every other.
constexpr double kWidestSkin = 100;
constexpr double kMostSteps = 1e15;
/// A coil flatter than this is a disc. The search for its closest point would go through as many turns as the square of
/// this ratio.
constexpr double kFlattestCoil = 100;

std::string sizeKey(const PowderOf& p, const char* bound) {
    if (p.filling.list) return "particles.list";
    if (p.filling.size.kind == SizeDistribution::Kind::Fixed) return p.path + ".size.radius_mm";
    return fmt::format("{}.size.radius_{}_mm", p.path, bound);
}

void checkMasses(CaseReader& reader, const Case& c) {
    const PowderSizes sizes = powderSizes(c);
    for (const PowderOf& p : powdersOf(c)) {
        const SizeRange& radii = sizes[std::size_t(p.material)];
        const double density = c.world.density(p.material);
        const auto inertia = [&](double r) { return 0.4 * sphereMass(density, r) * r * r; };
        if (inertia(radii.smallest) < kSmallestFloat)
            reader.fault(sizeKey(p, "min"),
                         fmt::format("a sphere of {:.3g} mm is too light to compute", radii.smallest * 1e3),
                         "give larger spheres, or fewer and larger ones in their place");
        if (inertia(radii.largest) > kLargestFloat)
            reader.fault(sizeKey(p, "max"),
                         fmt::format("a sphere of {:.3g} mm is too heavy to compute", radii.largest * 1e3),
                         "give smaller spheres");
    }
}

void checkSteps(CaseReader& reader, const Case& c) {
    const Schedule& s = c.schedule;
    const std::array<std::pair<const char*, double>, 5> durations{
        {{"settle.time_s", s.settleTime},
         {s.targetMass > 0 ? "dose.max_rotate_s" : "dose.rotate_s", s.rotateTime},
         {"dose.ramp_s", s.rampTime},
         {"dose.rest_s", s.restTime},
         {"stop.end_time_s", s.stop.endTime}}};
    for (const auto& [key, duration] : durations) {
        const double steps = std::round(duration / c.world.timeStep);
        if (duration > 0 && steps < 1)
            reader.fault(key, "is shorter than half a time step",
                         fmt::format("give 0 or at least {:.4g} s", c.world.timeStep));
        if (std::isfinite(duration) && steps > kMostSteps)
            reader.fault(key, fmt::format("is more than {:.0e} time steps of {:.3g} s", kMostSteps, c.world.timeStep),
                         "give a shorter time, or contacts with a longer time step");
    }
    const double back = s.reverseTime(), turnsPerStep = s.coilSpeed * c.world.timeStep / (2 * kPi);
    if (back > 0 && std::round(back / c.world.timeStep) < 1)
        reader.fault("dose.reverse_turns", "takes less than half a time step",
                     fmt::format("give 0 or at least {:.4g}", turnsPerStep));
    if (std::isfinite(back) && back / c.world.timeStep > kMostSteps)
        reader.fault("dose.reverse_turns",
                     fmt::format("takes more than {:.0e} time steps of {:.3g} s", kMostSteps, c.world.timeStep),
                     "give fewer turns, or contacts with a longer time step");
}

/// Spheres as large as a head make the time step so long that everything else seems wrong; a list has them if its
/// lengths are in mm.
bool largeSpheresTold(CaseReader& reader, const Case& c, double largest) {
    constexpr double kLarge = 0.1, kStrongest = 100;  // [m], [m/s2]
    const double g = std::max(glm::length(c.world.gravity), glm::length(c.settlingGravity()));
    const double dt = c.world.timeStep;
    if (largest < kLarge || g > kStrongest || g * dt * dt <= kLongestWay * largest) return false;
    const PowderOf first = powdersOf(c).front();
    reader.fault(
        sizeKey(first, "max"),
        fmt::format("has spheres of radius {:.4g} mm, for which a time step is {:.3g} s long", largest * 1e3, dt),
        first.filling.list ? "give radii and places in m: a list is in metres" : "give smaller spheres");
    return true;
}

void checkWays(CaseReader& reader, const Case& c, double smallest) {
    const double dt = c.world.timeStep;
    const double longest = kLongestWay * smallest;
    if (std::max(glm::length(c.world.gravity), glm::length(c.settlingGravity())) * dt * dt > longest)
        reader.fault("gravity", "moves the smallest sphere by more than a tenth of its radius in a time step",
                     "give gravity in m/s2, or a shorter time.step_s");
    if (!c.world.coil) return;
    const double fastest = c.schedule.fastestSpeed();
    const double rim = fastest * (c.world.coil->radius + c.world.coil->wireRadius);
    if (rim * dt > longest)
        reader.fault(fastest > c.schedule.coilSpeed ? "dose.stage" : "coil.speed_rpm",
                     "moves the wire by more than a tenth of the smallest radius in a time step",
                     fmt::format("give at most {:.3g} rpm, or a shorter time.step_s",
                                 fastest * kRpm.perSI * longest / (rim * dt)));
}

}  // namespace

void checkScales(CaseReader& reader, const Case& c, const SizeRange& radii) {
    checkMasses(reader, c);
    if (largeSpheresTold(reader, c, radii.largest)) return;
    checkSteps(reader, c);
    checkWays(reader, c, radii.smallest);
    if (c.world.skin > kWidestSkin * radii.largest)
        reader.fault("time.skin_mm", "makes every particle a neighbour of hundreds of thousands",
                     fmt::format("give about {:.3g}, a tenth of the radius", 0.1 * radii.largest * 1e3));
    if (c.world.coil && c.world.coil->radius > kFlattestCoil * c.world.coil->pitch)
        reader.fault("coil", fmt::format("is wider than {:.0f} times its pitch", kFlattestCoil),
                     "give fewer turns or a smaller radius");
}

void checkExtent(CaseReader& reader, const Case& c, double smallest, const std::string& path) {
    const Box& box = c.world.domain;
    const double farthest = kFarthestOverRadius * smallest;
    double reach = 0;
    for (const Vec3& corner : {box.low, box.high})
        for (glm::length_t axis = 0; axis < 3; ++axis) reach = std::max(reach, std::abs(corner[axis]));
    if (reach > farthest)
        reader.fault(path,
                     fmt::format("reaches {:.3g} m from the origin, where a sphere of {:.3g} mm is lost in rounding",
                                 reach, smallest * 1e3),
                     fmt::format("stay within {:.3g} m", farthest));
}

}  // namespace vkdose
