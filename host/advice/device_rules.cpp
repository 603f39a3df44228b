// Warnings about the canister and the coil.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/advice/rules.h"
#include "host/core/key.h"
#include "host/core/millimetres.h"

namespace vkdose {
namespace {

/// A gap that holds fewer spheres than this side by side is easily bridged.
constexpr double kSpheresInTurn = 1.5;
/// The same for the outlet, by mean and by largest sphere. Arches of round grains stand over holes of up to some four
/// or five of their diameters.
constexpr double kSpheresInOutlet = 4;
constexpr double kLargestInOutlet = 2.5;
/// A limit below this ends a run in which a sphere is wedged between wire and wall.
constexpr double kWedgedOverlap = 0.5;

/// Angles of repose [degrees]: hardly any powder without adhesion is steeper; free-flowing ones are about so steep.
constexpr double kSteepest = 45, kUsualSlope = 30;
/// Strongest pull over weight of a sphere above which adhesion holds powder in an open throat. With 5 a sixteenth of
/// the fill of cases/devices/bulk-sugar.toml ran out while it settled, with 50 nothing of tiny-drug.toml.
constexpr double kHeldByBond = 10;

double coilEnd(const Subject& s) {
    return s.c.world.coil->zStart + s.c.world.coil->length;
}

}  // namespace

Found hugeCanister(const Subject& s) {
    if (!s.c.canister) return {};
    constexpr double kHuge = 5;  // [m]; meshes that are longer are refused (read_bodies.cpp)
    const Canister& can = *s.c.canister;
    const std::pair<const char*, double> sizes[] = {
        {"canister.length_mm", can.length}, {"canister.width_mm", can.width}, {"canister.height_mm", can.height}};
    for (const auto& [key, size] : sizes)
        if (size > kHuge)
            return Finding{key, fmt::format("the canister is {:.3g} m large; lengths are given in mm", size),
                           fmt::format("give {:.4g} if it is {:.4g} mm, which is probably meant", size, size)};
    return {};
}

Found narrowTurns(const Subject& s) {
    const double gap = s.f.coilGap;
    const double needed = std::max(2 * s.f.largest, kSpheresInTurn * 2 * s.f.mean);
    if (!s.doses() || !(gap < needed)) return {};
    const double pitch = s.c.world.coil->pitch + needed - gap;
    return Finding{s.given("coil.pitch_mm", "coil.turns"),
                   fmt::format("the turns leave a gap of {:.3g} mm, {:.2g} mean spheres or {:.2g} of the largest side "
                               "by side, so that powder can hardly enter the coil",
                               mm(gap), gap / (2 * s.f.mean), gap / (2 * s.f.largest)),
                   fmt::format("give a pitch of at least {:.3g} mm, a thinner wire or smaller spheres", mm(pitch))};
}

Found pinchedSpheres(const Subject& s) {
    const double gap = s.f.coilClearance;
    if (!s.doses() || !(gap < 2 * s.f.largest) || s.c.world.maxOverlapRatio >= kWedgedOverlap) return {};
    const bool all = gap <= 2 * s.f.smallest;
    return Finding{
        "contact.max_overlap_ratio",
        fmt::format(
            "between coil and wall are {:.3g} mm, where {} can be wedged; that takes overlaps deeper "
            "than {:.3g} of the radius, which end the run",
            mm(gap),
            all ? fmt::format("every sphere (diameter {:.3g} to {:.3g} mm)", mm(2 * s.f.smallest), mm(2 * s.f.largest))
                : fmt::format("spheres of more than that (diameter up to {:.3g} mm)", mm(2 * s.f.largest)),
            s.c.world.maxOverlapRatio),
        fmt::format("give 1, as the paper's cases do, or a clearance above {:.3g} mm", mm(2 * s.f.largest))};
}

Found shortCoil(const Subject& s) {
    if (!s.doses() || !s.c.canister || coilEnd(s) >= s.c.canister->length) return {};
    const double missing = s.c.canister->length - coilEnd(s);
    return Finding{
        "coil.length_mm",
        fmt::format("the coil ends {:.3g} mm before the front wall, so that powder is pushed and not carried "
                    "out; the closed form of the dose does not hold",
                    mm(missing)),
        fmt::format("give {:.4g} to reach the front wall, {:.4g} to reach the end of the throat",
                    mm(s.c.world.coil->length + missing),
                    mm(s.c.world.coil->length + missing + s.c.canister->throatLength))};
}

Found lateCoil(const Subject& s) {
    if (!s.doses() || !s.c.canister) return {};
    const double start = s.c.world.coil->zStart;
    const double length = s.c.canister->length;
    if (start >= length)
        return Finding{"coil.z_start_mm",
                       fmt::format("the coil begins {:.3g} mm from the rear wall, beyond the front wall at {:.3g} mm, "
                                   "and moves no powder of the canister",
                                   mm(start), mm(length)),
                       "give 0, at the rear wall"};
    if (start <= 0.25 * length) return {};
    return Finding{"coil.z_start_mm",
                   fmt::format("the coil begins {:.3g} mm from the rear wall of a canister of {:.3g} mm; the powder "
                               "behind it stays there",
                               mm(start), mm(length)),
                   "give 0, at the rear wall"};
}

Found coilThroughRear(const Subject& s) {
    if (!s.c.world.coil || !s.c.canister || s.c.world.coil->zStart >= -s.c.world.coil->wireRadius) return {};
    return Finding{
        "coil.z_start_mm",
        fmt::format("the coil begins {:.3g} mm behind the rear wall; only what is in front of it moves powder",
                    mm(-s.c.world.coil->zStart)),
        "give 0, at the rear wall"};
}

Found coilAtRest(const Subject& s) {
    if (!s.doses() || s.c.schedule.coilSpeed > 0) return {};
    return Finding{"coil.speed_rpm", "the coil does not turn during the doses", "give its speed in turns a minute"};
}

Found coilTooFast(const Subject& s) {
    if (!s.doses()) return {};
    const double omega = s.c.schedule.coilSpeed, down = glm::length(s.c.world.gravity);
    const double froude = omega * omega * s.c.world.coil->radius / down;
    if (!(froude > 1)) return {};
    return Finding{
        "coil.speed_rpm",
        fmt::format("the wire's centripetal acceleration is {:.2g} times gravity, so that it flings the "
                    "powder",
                    froude),
        fmt::format("stay below {:.3g} rpm; the key is in turns a minute", omega / std::sqrt(froude) * kRpm.perSI)};
}

Found narrowOutlet(const Subject& s) {
    if (!s.c.canister || s.c.schedule.rotateTime == 0) return {};
    const double hole = s.c.canister->outletDiameter;
    const double needed = std::max(kSpheresInOutlet * 2 * s.f.mean, kLargestInOutlet * 2 * s.f.largest);
    if (hole >= needed) return {};
    return Finding{
        "canister.outlet_diameter_mm",
        fmt::format("the outlet is {:.2g} mean spheres or {:.2g} of the largest wide; arches of spheres close "
                    "so narrow a hole",
                    hole / (2 * s.f.mean), hole / (2 * s.f.largest)),
        fmt::format("give at least {:.3g}, or spheres {:.2g} times smaller", mm(needed), needed / hole)};
}

Found openThroat(const Subject& s) {
    // The blade of a screw closes the throat, as nothing of cases/devices/auger-milk.toml ran out while it settled.
    if (!s.c.canister || !s.doses() || !(s.f.bondLargest <= kHeldByBond)) return {};
    const Canister& can = *s.c.canister;
    const double slope = std::atan2(can.outletDiameter, can.throatLength) * 180 / kPi;
    if (!(slope > kSteepest)) return {};
    return Finding{
        "canister.throat_length_mm",
        fmt::format("powder that hardly sticks (Bond number at most {:.2g}) runs out through the throat by itself, at "
                    "rest and beside what the coil conveys: from the hole's top to the throat's end the "
                    "slope is {:.2g} degrees, steeper than such powder lies",
                    s.f.bondLargest, slope),
        fmt::format("give a throat of {:.3g} or more, which the first turns fill, a narrower outlet, or expect it",
                    mm(can.outletDiameter / std::tan(kUsualSlope * kPi / 180)))};
}

Found emptyThroat(const Subject& s) {
    if (!s.doses() || !s.c.canister || s.c.schedule.targetMass > 0) return {};
    const double throat = s.c.canister->throatLength, pitch = s.c.world.coil->pitch;
    const double turns = s.c.schedule.coilSpeed * s.c.schedule.rotateTime / (2 * kPi);
    if (!(turns > 0) || turns * pitch >= 0.5 * throat) return {};
    return Finding{
        "canister.throat_length_mm",
        fmt::format("the throat is empty at first, and a dose of {:.2g} turn{} pushes the powder by {:.3g} mm; "
                    "the first {:.0f} doses fill the throat and give little",
                    turns, fmt::format("{:.2g}", turns) == "1" ? "" : "s", mm(turns * pitch),
                    std::ceil(throat / (turns * pitch)) - 1),
        fmt::format("leave these doses out of the mean, turn at least {:.2g} s, or give a shorter throat",
                    s.c.schedule.rotateTime * throat / (turns * pitch))};
}

Found bareCoil(const Subject& s) {
    if (!s.doses() || !(s.f.bedTop < 0)) return {};
    return Finding{"particles.mass_g",
                   fmt::format("the settled powder stands {:.3g} mm below the coil's axis, so that no turn fills; the "
                               "closed form of the dose takes them for full",
                               mm(-s.f.bedTop)),
                   "give more mass, or expect less than the closed form"};
}

Found tightDomain(const Subject& s) {
    if (!s.c.canister) return {};
    const Canister& can = *s.c.canister;
    const Vec3 low{-can.width / 2, -can.width / 2, 0};
    const Vec3 high{can.width / 2, s.f.bedTop, can.length + can.throatLength};
    const Box& domain = s.c.world.domain;
    if (!glm::any(glm::lessThan(low, domain.low)) && !glm::any(glm::greaterThan(high, domain.high))) return {};
    return Finding{"domain",
                   "is smaller than the canister with its powder; a sphere that leaves it is lost, which ends the run",
                   "leave [domain] out, or let it reach beyond the walls and the throat"};
}

}  // namespace vkdose
