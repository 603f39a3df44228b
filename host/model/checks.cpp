#include "host/model/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "geometry/coincidence.h"
#include "host/core/millimetres.h"
#include "host/model/contact_pairs.h"
#include "host/model/powders.h"
#include "host/model/size_distribution.h"
#include "host/model/stability.h"

namespace vkdose {
namespace {

void checkContact(CaseReader& reader, const Case& c) {
    std::set<std::string> told;  // an inherited fault is reported once, where the value is written
    for (const MaterialPair pair : statedPairs(c.world)) {
        const ContactParameters& p = c.dosingLaw.of(pair);
        const std::string path = contactPath(reader, c.world, pair);
        const std::string ratio = fmt::format("{}", p.k1 / p.k2Max);
        if (p.k1 > p.k2Max && told.insert(ratio).second)
            reader.fault(path + ".k1_over_k", "the plastic stiffness exceeds the elastic one",
                         "give a ratio > 0 and <= 1 (the paper's table prints the inverse, 5 for 0.2)");
        if (p.k1 < p.k2Max && p.plasticityDepth == 0 && told.insert(ratio + " without a depth").second)
            reader.fault(path + ".plasticity_depth", "is zero, which leaves k2 undefined while k1 < k",
                         "give a fraction > 0 of the radius, e.g. 0.05, or k1_over_k = 1");
    }
}

/// Checks the limit of the overlap. At an overlap of twice the smaller radius, two equal spheres are in the same place.
void checkOverlapLimit(CaseReader& reader, const Case& c) {
    if (c.world.maxOverlapRatio > 2)
        reader.fault("contact.max_overlap_ratio", "lets spheres pass through each other", "give at most 2");
}

void checkSize(CaseReader& reader, const std::string& table, const SizeDistribution& s) {
    using Kind = SizeDistribution::Kind;
    const std::string smallest = table + ".size.radius_min_mm";
    const bool bounded = s.kind != Kind::Fixed;
    if (bounded && s.radiusMin > s.radiusMax)
        reader.fault(smallest, "exceeds radius_max_mm", fmt::format("give at most {:.6g} mm", mm(s.radiusMax)));
    if (s.kind == Kind::Quantiles && (s.r10 >= s.r50 || s.r50 >= s.r90)) {
        reader.fault(table + ".size.d50_um", "the quantiles do not increase", "give d10_um < d50_um < d90_um");
        return;
    }
    const bool ofPowder = s.kind == Kind::Quantiles || (s.kind == Kind::Sieve && !s.sieve.empty());
    if (ofPowder && s.radiusMin <= s.radiusMax && finerVolume(s, s.radiusMax) - finerVolume(s, s.radiusMin) <= 0)
        reader.fault(smallest, "the bounds leave nothing of the scaled powder",
                     fmt::format("keep them between {:.4g} and {:.4g} mm", mm(finestRadius(s)), mm(coarsestRadius(s))));
    const bool drawnAgain = s.kind == Kind::Normal || s.kind == Kind::Lognormal;
    if (drawnAgain && s.radiusMin <= s.radiusMax && acceptance(s) < 0.01)
        reader.fault(smallest, fmt::format("the bounds keep only {:.2g} of the draws", acceptance(s)),
                     "move them nearer to the middle of the distribution");
}

void checkCanister(CaseReader& reader, const Case& c) {
    const Canister& can = *c.canister;
    if (can.outletDiameter > can.width)
        reader.fault("canister.outlet_diameter_mm", "the hole is wider than the canister",
                     fmt::format("give at most width_mm = {:.6g}", mm(can.width)));
    if (can.height <= can.width / 2)
        reader.fault("canister.height_mm", "the canister ends below the coil's axis",
                     fmt::format("give more than width_mm / 2 = {:.6g}", mm(can.width / 2)));
}

/// The key that sets the coil's radius in this case.
const char* radiusKey(CaseReader& reader) {
    return reader.root().table("coil").has("clearance_mm") ? "coil.clearance_mm" : "coil.radius_mm";
}

/// Checks the coil's radius against the thickness of its wire and against the walls around it. Returns false if the
/// wire cannot be wound there at all.
bool checkCoilRadius(CaseReader& reader, const Case& c) {
    const geometry::Coil& coil = *c.world.coil;
    const bool byClearance = c.canister && reader.root().table("coil").has("clearance_mm");
    double room = std::numeric_limits<double>::infinity();
    const char* around = "";
    if (c.canister) {
        const Canister& can = *c.canister;
        // A coil that ends before the front wall need not pass the hole. A clearance counts from the hole even then.
        const bool inHole = (byClearance || coil.zStart + coil.length > can.length) && can.outletDiameter < can.width;
        around = inHole ? "outlet" : "trough";
        room = (inHole ? can.outletDiameter : can.width) / 2;
    }
    const double outer = coil.radius + coil.wireRadius;
    // The message offers a wider hole too, because the hole may be the wrong value.
    const std::string orWider = std::string_view(around) == "outlet"
                                    ? fmt::format(", or an outlet_diameter_mm of at least {:.6g}", mm(2 * outer))
                                    : "";
    if (2 * coil.wireRadius >= room)
        reader.fault("coil.wire_diameter_mm",
                     fmt::format("so thick a wire cannot be wound in the {}, {:.6g} mm wide", around, mm(2 * room)),
                     fmt::format("give less than {:.6g}{}", mm(room), orWider));
    else if (outer > room)
        reader.fault(
            radiusKey(reader),
            fmt::format("the coil reaches {:.6g} mm from its axis, the {} only {:.6g} mm", mm(outer), around, mm(room)),
            fmt::format("give a radius_mm of at most {:.6g}{}", mm(room - coil.wireRadius), orWider));
    else if (coil.radius <= coil.wireRadius)
        reader.fault(radiusKey(reader),
                     fmt::format("the wire ({:.6g} mm thick) fills the coil", mm(2 * coil.wireRadius)),
                     byClearance ? fmt::format("give a clearance_mm below {:.6g}", mm(room - 2 * coil.wireRadius))
                                 : fmt::format("give a radius_mm above {:.6g}", mm(coil.wireRadius)));
    return 2 * coil.wireRadius < room;
}

void checkCoil(CaseReader& reader, const Case& c) {
    const geometry::Coil& coil = *c.world.coil;
    if (!checkCoilRadius(reader, c)) return;  // a wire that is far too thick is reported only once
    if (coil.pitch <= 2 * coil.wireRadius)
        reader.fault(
            reader.root().table("coil").has("pitch_mm") ? "coil.pitch_mm" : "coil.turns",
            fmt::format("the turns overlap: pitch {:.6g} mm, wire {:.6g} mm", mm(coil.pitch), mm(2 * coil.wireRadius)),
            fmt::format("wind fewer than {:.4g} turns", coil.length / (2 * coil.wireRadius)));
}

void checkStages(CaseReader& reader, const Schedule& s) {
    double before = 0;
    for (std::size_t k = 0; k < s.stages.size(); ++k) {
        const std::string key = fmt::format("dose.stage[{}].until", k);
        if (s.stages[k].until > 1)
            reader.fault(key, "is beyond the target", "give a fraction of mass_g, at most 1");
        else if (s.stages[k].until <= before)
            reader.fault(key, fmt::format("does not come after {:.6g}, where the stage before it ends", before),
                         "list the stages by rising fractions");
        before = s.stages[k].until;
    }
}

void checkDoses(CaseReader& reader, const Case& c) {
    const Schedule& s = c.schedule;
    const bool doses = s.rotateTime > 0;
    if (s.targetMass > fillOf(c).mass)
        reader.fault("dose.mass_g", fmt::format("is more than the fill of {:.4g} g", fillOf(c).mass * 1e3),
                     "give less, or fill in more");
    if (!s.stages.empty() && s.targetMass == 0 && !reader.root().table("dose").has("mass_g"))
        reader.fault("dose.stage", "the stages are fractions of a mass that is not given",
                     "give dose.mass_g and dose.max_rotate_s");
    checkStages(reader, s);
    if (doses && 2 * s.rampTime > s.rotateTime)
        reader.fault("dose.ramp_s", "the coil has no time to speed up and to slow down again",
                     fmt::format("give at most half of {}, {:.6g} s", s.targetMass > 0 ? "max_rotate_s" : "rotate_s",
                                 s.rotateTime / 2));
    if (std::isfinite(s.maxTorque) && !c.world.coil && !followsDrive(c.world.bodies))
        reader.fault("dose.max_torque_mNm", "there is no coil, and no body follows the drive", "remove it");
    if (s.rotateTime == 0 && s.reverseTurns > 0)
        reader.fault("dose.reverse_turns", "there is no dose to turn back after", "give rotate_s > 0");
    if (doses && s.reverseTurns > 0 && s.coilSpeed == 0)
        reader.fault("dose.reverse_turns", "a coil that stands cannot turn back", "give coil.speed_rpm > 0");
    else if (doses && s.reverseTurns > 0 && s.reverseTime() < 2 * s.rampTime)
        reader.fault("dose.reverse_turns", "the coil cannot turn so little with these ramps",
                     fmt::format("give at least {:.3g}, or a shorter ramp_s", s.rampTime * s.coilSpeed / (2 * kPi)));
}

void checkSchedule(CaseReader& reader, const Case& c) {
    const Schedule& s = c.schedule;
    checkDoses(reader, c);
    if (s.rotateTime > 0 && !c.world.coil && !movesInDoses(c.world.bodies))
        reader.fault(s.targetMass > 0 ? "dose.mass_g" : "dose.rotate_s", "there is no coil to turn",
                     "add [coil], or a [[body]] with motion.follows = \"drive\" or motion.during = \"rotate\", or set "
                     "rotate_s = 0");
    if (s.rotateTime == 0 && s.restTime > 0)
        reader.fault("dose.rest_s", "there is no dose to rest after", "give rotate_s > 0, or settle.time_s instead");
    if (s.rotateTime == 0 && s.settleTime == 0)
        reader.fault("settle.time_s", "there is nothing to run", "give settle.time_s or dose.rotate_s > 0");
    if (s.untilRest && s.settleTime == 0)
        reader.fault("settle.until_rest", "there is no time to come to rest in",
                     "give settle.time_s, the longest time that settling may take");
    if (s.untilRest && glm::length(c.world.gravity) == 0)
        reader.fault("settle.until_rest", "nothing falls without gravity", "give gravity, or until_rest = false");
    if (s.restSpeedRatio >= 1)
        reader.fault("settle.rest_speed_ratio", "calls a falling powder a bed at rest", "give about 0.01");
    if (s.rotateTime > 0 && s.stop.kind == StopRule::Kind::None && s.stop.maxDoses == std::numeric_limits<int>::max() &&
        std::isinf(s.stop.endTime))
        reader.fault("stop.rule", "the run would never end", "give max_doses or end_time_s, or another rule");
    if (s.rotateTime == 0 && s.stop.kind != StopRule::Kind::None)
        reader.fault("stop.rule", "there are no doses to judge", "give dose.rotate_s > 0, or rule = \"none\"");
    if (c.frames.interval > 0 && c.frames.interval < c.sensorInterval)
        reader.fault("frames.interval_s", "is shorter than sensors.interval_s; frames are taken where sensors are read",
                     fmt::format("give 0, at least {:.6g}, or a shorter sensors.interval_s", c.sensorInterval));
    const double shortest = kFewestRateIntervals * c.sensorInterval;
    if (c.rateWindow > 0 && c.rateWindow < shortest * (1 - 1e-9))  // the interval is rounded to whole steps
        reader.fault("sensors.rate_window_s", fmt::format("is shorter than {} sensor intervals", kFewestRateIntervals),
                     fmt::format("give at least {:.6g}, or a shorter sensors.interval_s", shortest));
}

void checkBox(CaseReader& reader, const std::string& path, const Box& box) {
    if (box.low.x >= box.high.x || box.low.y >= box.high.y || box.low.z >= box.high.z)
        reader.fault(path, "low is not below high in every coordinate",
                     "give the lower corner as low, the upper as high");
}

/// The key that makes a surface. Surfaces that a file lists come in the order of the file, planes first.
std::string surfaceKey(const Case& c, std::size_t surface) {
    if (c.canister) return "canister";
    const auto isPlane = [](const Wall& w) { return std::holds_alternative<geometry::Plane>(w.shape); };
    const auto& all = c.world.walls;
    const auto planes = static_cast<std::size_t>(std::count_if(all.begin(), all.end(), isPlane));
    return surface < planes ? fmt::format("plane[{}].point", surface)
                            : fmt::format("cylinder[{}].base", surface - planes);
}

}  // namespace

void checkFields(CaseReader& reader, const Case& c) {
    checkContact(reader, c);
    checkOverlapLimit(reader, c);
    if (!c.filling.list)
        for (const PowderOf& p : powdersOf(c)) checkSize(reader, p.path, p.filling.size);
    if (c.canister) checkCanister(reader, c);
    if (c.world.coil) checkCoil(reader, c);
    checkSchedule(reader, c);
    checkBox(reader, "domain", c.world.domain);
    if (!c.filling.list) checkBox(reader, "particles.region", c.filling.region);
    if (c.filling.list || c.canister || c.mixed) return;
    for (std::size_t k = 0; k < c.furtherPowders.size(); ++k)
        checkBox(reader, fmt::format("powder[{}].region", k), c.furtherPowders[k].filling.region);
}

void checkSurfaces(CaseReader& reader, const Case& c, double radius) {
    const Box& room = c.world.domain;
    const auto found = geometry::findCoincidence(shapesOf(c.world.walls), radius, room.low, room.high);
    if (!found) return;
    const std::string first = surfaceKey(c, found->first), second = surfaceKey(c, found->second);
    const Vec3 at = found->centre * 1e3;
    reader.fault(second,
                 fmt::format("coincides with {} for a sphere at ({:.4g}, {:.4g}, {:.4g}) mm, which would have two "
                             "contacts with one wall",
                             first, at.x, at.y, at.z),
                 "remove one of the two, or move it by more than a fiftieth of the smallest radius");
}

void checkBodies(CaseReader& reader, const Case& c) {
    const std::size_t bodies = c.world.bodies.size();
    for (const SharedPlace& place : c.sharedPlaces) {
        const bool wall = place.second >= bodies;
        // Of bodies that move, `vkdose check` warns: what lies behind a lid that moves is no place for powder.
        if (!place.area || !c.world.bodies[place.first].rests()) continue;
        const Vec3 at = place.centre * 1e3;
        reader.fault(
            fmt::format("body[{}].at", wall ? place.first : place.second),
            fmt::format("body \"{}\" coincides with {} for a sphere at ({:.4g}, {:.4g}, {:.4g}) mm, which would "
                        "have two contacts with one wall",
                        c.world.bodies[wall ? place.first : place.second].name,
                        wall ? surfaceKey(c, place.second - bodies)
                             : fmt::format("body \"{}\"", c.world.bodies[place.first].name),
                        at.x, at.y, at.z),
            wall ? "remove one of the two, or move it by more than a fiftieth of the smallest radius"
                 : "join the two in one mesh, remove one, or move it by more than a fiftieth of the smallest "
                   "radius");
        return;
    }
}

void checkTimeStep(CaseReader& reader, const Case& c, const PowderSizes& sizes) {
    const double dt = c.world.timeStep;
    const auto modes = modesOf(c, sizes);
    const std::string automatic =
        fmt::format("give at most {:.3g} s, or \"auto\"", automaticTimeStep(modes, c.stepsPerContact));
    const double longest = c.stepsPerContact ? 1 / *c.stepsPerContact : kUnstableFraction;
    const ContactMode* stiffest = nullptr;
    const ContactMode* damped = nullptr;
    for (const ContactMode& mode : modes) {
        if (stiffest == nullptr || mode.duration < stiffest->duration) stiffest = &mode;
        if (damped == nullptr || mode.decay > damped->decay) damped = &mode;
    }
    if (stiffest == nullptr) return;  // no contact, no limit
    if (dt > longest * stiffest->duration)
        reader.fault("time.step_s",
                     fmt::format("the time step {:.4g} s is {}: the stiffest contact ({}) lasts {:.4g} s", dt,
                                 dt > kUnstableFraction * stiffest->duration
                                     ? "unstable"
                                     : fmt::format("more than 1/{:.4g} of it", *c.stepsPerContact),
                                 stiffest->name, stiffest->duration),
                     automatic);
    else if (dt * damped->decay > 1)
        reader.fault("time.step_s",
                     fmt::format("the time step {:.4g} s is unstable: damping ({}) acts within {:.4g} s", dt,
                                 damped->name, 1 / damped->decay),
                     automatic);
    if (c.sensorInterval > 1e9 * dt)
        reader.fault("sensors.interval_s", fmt::format("is more than 1e9 time steps of {:.3g} s", dt),
                     "give a shorter interval, or contacts with a longer time step");
}

void checkTouches(CaseReader& reader, const Case& c, double largestRadius) {
    if (!c.world.coil) return;
    const int touches = geometry::maxTouches(*c.world.coil, largestRadius);
    if (touches > kMaxCoilTouches)
        reader.fault(reader.root().table("coil").has("pitch_mm") ? "coil.pitch_mm" : "coil.turns",
                     fmt::format("a sphere of {:.4g} mm could touch {} turns at once", mm(largestRadius), touches),
                     fmt::format("wind the coil wider or use smaller spheres: {} turns are followed", kMaxCoilTouches));
}

}  // namespace vkdose
