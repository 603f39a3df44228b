// The boundaries, the coil, and the tables of time: [settle] (its time), [dose], [stop], [sensors], [frames], [time],
// [domain].
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "host/model/case_sections.h"
#include "host/model/stability.h"

namespace vkdose {
namespace {

// ---- boundaries ---------------------------------------------------------------------------------------------------

/// `material` is that of its walls.
void addCanister(Case& c, int material) {
    const Canister& can = *c.canister;
    const double half = can.width / 2;
    const auto add = [&](const geometry::Surface& shape, const char* name) {
        c.world.walls.emplace_back(shape, name, material);
    };
    // The walls end at the front wall, because beyond it a sphere touches only the throat.
    if (can.flatFloor) {
        add(geometry::Plane{{-half, 0, 0}, {1, 0, 0}, can.length}, "left");
        add(geometry::Plane{{half, 0, 0}, {-1, 0, 0}, can.length}, "right");
        add(geometry::Plane{{0, -half, 0}, {0, 1, 0}, can.length}, "floor");
    } else {
        add(geometry::Trough{half, can.length}, "trough");
    }
    add(geometry::Plane{{0, 0, 0}, {0, 0, 1}}, "rear");
    add(geometry::Front{can.length, can.outletDiameter / 2, can.throatLength}, "front");
    c.world.throatZ = can.length;
    c.world.outletZ = can.length + can.throatLength;
}

void readCanister(CaseReader& reader, Section& root, Case& c) {
    Section& section = root.requiredTable("canister");
    Canister can;
    can.length = section.number("length_mm");
    can.width = section.number("width_mm");
    can.height = section.number("height_mm");
    can.flatFloor = section.choice("floor") == std::size_t{1};
    can.outletDiameter = section.number("outlet_diameter_mm");
    can.throatLength = section.number("throat_length_mm");
    can.lid = section.boolean("lid");
    c.canister = can;
    section.know("material");
    addCanister(c, section.has("material") ? readMaterialName(reader, section, c, kWallMaterial) : kWallMaterial);
}

void readSurfaces(CaseReader& reader, Section& root, Case& c) {
    std::set<std::string> names;
    const auto add = [&](const geometry::Surface& shape, Section& section, const char* kind, std::size_t number) {
        const std::string name = readName(reader, section, kind, names, fmt::format("{}-{}", kind, number));
        c.world.walls.emplace_back(shape, name, readMaterialName(reader, section, c, kWallMaterial));
    };
    std::size_t planes = 0, cylinders = 0;
    for (Section* plane : root.tables("plane")) {
        const Vec3 point = plane->vector("point");
        add(geometry::Plane{point, readDirection(reader, *plane, "normal")}, *plane, "plane", planes++);
    }
    for (Section* tube : root.tables("cylinder")) {
        geometry::Tube shape;
        shape.base = tube->vector("base");
        shape.axis = readDirection(reader, *tube, "axis");
        shape.radius = tube->number("radius_mm");
        if (tube->has("length_mm")) shape.length = tube->number("length_mm");
        tube->know("length_mm");
        shape.inside = tube->boolean("inside");
        add(shape, *tube, "cylinder", cylinders++);
    }
    if (c.world.walls.empty() && !root.has("body") && !reader.faulty())
        reader.fault("boundaries", "the list is empty",
                     "add [[plane]], [[cylinder]] or [[body]], or write boundaries = \"none\"");
}

/// Reports tables that have no use with the chosen boundaries, because they are probably a mistake.
void refuseUnused(CaseReader& reader, Section& root, Boundaries kind) {
    const auto refuse = [&](const char* key, const char* needed) {
        if (!root.has(key)) return;
        root.know(key);
        reader.fault(key, "has no use with these boundaries",
                     fmt::format("write boundaries = \"{}\" or remove it", needed));
    };
    if (kind != Boundaries::Canister) refuse("canister", "canister");
    if (kind != Boundaries::List) refuse("plane", "list");
    if (kind != Boundaries::List) refuse("cylinder", "list");
}

}  // namespace

Vec3 readDirection(CaseReader& reader, Section& section, const char* key) {
    const Vec3 v = section.vector(key);
    const double length = glm::length(v);
    if (length == 0) reader.fault(section.path(key), "has no direction", "give a vector that is not zero");
    return v / length;
}

std::optional<Boundaries> readBoundaries(CaseReader& reader, Section& root, Case& c) {
    const auto index = root.choice("boundaries");
    for (const char* key : {"canister", "plane", "cylinder"})
        if (!index || !root.has(key)) root.know(key);
    if (!index) return std::nullopt;
    const auto kind = static_cast<Boundaries>(*index);
    if (kind == Boundaries::Canister) readCanister(reader, root, c);
    if (kind == Boundaries::List) readSurfaces(reader, root, c);
    refuseUnused(reader, root, kind);
    return kind;
}

namespace {

/// Reads one of two keys, of which exactly one must be given. `which` receives the index of that key.
double readEither(CaseReader& reader, Section& section, const char* first, const char* second, int& which) {
    which = section.has(second) && !section.has(first) ? 1 : 0;
    section.know(first);
    section.know(second);
    if (section.has(first) && section.has(second))
        reader.fault(section.path(second), fmt::format("{} is given too", first), "give one of the two");
    if (!section.has(first) && !section.has(second)) {
        reader.fault(section.path(first), "is missing", fmt::format("give {} or {}", first, second));
        return kNaN;
    }
    return section.number(which == 0 ? first : second);
}

}  // namespace

void readCoil(CaseReader& reader, Section& root, Case& c) {
    if (!root.has("coil")) {
        root.know("coil");
        return;
    }
    Section& section = root.table("coil");
    geometry::Coil coil{};
    int which = 0;
    coil.length = section.number("length_mm");
    const double winding = readEither(reader, section, "turns", "pitch_mm", which);
    coil.pitch = which == 0 ? coil.length / winding : winding;
    coil.wireRadius = section.number("wire_diameter_mm") / 2;
    const double size = readEither(reader, section, "radius_mm", "clearance_mm", which);
    coil.radius = size;
    if (which == 1 && !c.canister)
        reader.fault("coil.clearance_mm", "needs a canister to be measured from", "give radius_mm");
    else if (which == 1)  // between the wire and the narrower of trough and hole
        coil.radius = std::min(c.canister->width, c.canister->outletDiameter) / 2 - size - coil.wireRadius;
    coil.zStart = section.number("z_start_mm");
    coil.startAngle = section.number("start_angle_deg");
    coil.hand = section.choice("hand") == std::size_t{1} ? -1 : 1;
    c.schedule.coilSpeed = section.number("speed_rpm");
    c.world.coilSurfaceMoves = section.boolean("surface_velocity");
    c.world.coilWireCurved = section.boolean("wire_curvature");
    c.world.coil = coil;
}

namespace {

// ---- time ---------------------------------------------------------------------------------------------------------

void readDose(CaseReader& reader, Section& dose, Case& c) {
    Schedule& s = c.schedule;
    for (const char* key : {"rotate_s", "mass_g", "max_rotate_s", "max_torque_mNm"}) dose.know(key);
    const bool toMass = dose.has("mass_g");
    if (!toMass || dose.has("rotate_s")) s.rotateTime = dose.number("rotate_s");
    if (toMass && dose.has("rotate_s"))
        reader.fault(dose.path("rotate_s"), "is a fixed time, but mass_g doses to a mass",
                     "give mass_g and max_rotate_s, or rotate_s alone");
    if (toMass) s.targetMass = dose.number("mass_g");
    if (toMass || dose.has("max_rotate_s")) s.rotateTime = dose.number("max_rotate_s");
    if (!toMass && dose.has("max_rotate_s"))
        reader.fault(dose.path("max_rotate_s"), "has no use without mass_g", "give mass_g, or rotate_s in its place");
    for (Section* stage : dose.tables("stage"))
        s.stages.push_back({stage->number("speed_rpm"), stage->number("until")});
    s.rampTime = dose.number("ramp_s");
    s.reverseTurns = dose.number("reverse_turns");
    if (dose.has("max_torque_mNm")) s.maxTorque = dose.number("max_torque_mNm");
    s.torqueEndsRun = dose.choice("at_max_torque") == std::size_t{1};
    s.restTime = dose.number("rest_s");
    dose.know("speed_rpm");
    if (!c.world.coil && followsDrive(c.world.bodies))
        s.coilSpeed = dose.number("speed_rpm");
    else if (dose.has("speed_rpm"))
        reader.fault(dose.path("speed_rpm"),
                     c.world.coil ? "has no use beside a coil" : "has no use, because no body follows the drive",
                     c.world.coil ? "give coil.speed_rpm alone; bodies that follow the drive go with the coil"
                                  : "leave it out, or let a body follow the drive (follows = \"drive\")");
}

void readStop(Section& root, Case& c) {
    // The threshold is that of a canister's experiment. Other devices fill and deliver in ways of their own.
    const bool canister = c.schedule.rotateTime > 0 && c.canister.has_value();
    Section& section = root.table("stop");
    StopRule stop;
    const auto rule = section.choice("rule", canister ? std::size_t{1} : std::size_t{0});
    if (!rule) {
        section.abandon();
        return;
    }
    stop.kind = static_cast<StopRule::Kind>(*rule);
    stop.threshold = 0;
    if (stop.kind == StopRule::Kind::Experiment) stop.threshold = section.number("threshold_g");
    if (stop.kind != StopRule::Kind::None) stop.doses = static_cast<int>(section.integer("doses"));
    if (section.has("max_doses")) stop.maxDoses = static_cast<int>(section.integer("max_doses"));
    if (section.has("end_time_s")) stop.endTime = section.number("end_time_s");
    section.know("max_doses");
    section.know("end_time_s");
    c.schedule.stop = stop;
}

/// The columns of loads begin with the name of a wall, or of a body.
void checkWallNames(CaseReader& reader, const Case& c) {
    constexpr const char* kLoads = "sensors.wall_loads";
    if (c.world.walls.empty())
        reader.fault(kLoads, "there are no walls", "leave it out; the loads on bodies are always told");
    std::set<std::string> names;
    for (const Wall& wall : c.world.walls) names.insert(wall.name);
    if (c.canister && c.canister->lid) names.insert("lid");
    for (const RigidBody& body : c.world.bodies)
        if (names.contains(body.name))
            reader.fault(kLoads, fmt::format("a wall and a body are both called \"{}\"", body.name),
                         "give the body another name");
    if (c.world.coil && names.contains(kCoilName))
        reader.fault(kLoads, fmt::format("a wall is called \"{}\", which is the name of [coil]", kCoilName),
                     "give the wall another name");
}

}  // namespace

void readSchedule(CaseReader& reader, Section& root, Case& c) {
    Section& settle = root.table("settle");
    c.schedule.settleTime = settle.number("time_s");
    c.schedule.untilRest = settle.boolean("until_rest");
    c.schedule.restSpeedRatio = settle.number("rest_speed_ratio");
    c.schedule.settleGravityFactor = settle.number("gravity_factor");
    readDose(reader, root.table("dose"), c);
    readStop(root, c);
    Section& sensors = root.table("sensors");
    c.sensorInterval = sensors.number("interval_s");
    if (sensors.has("rate_window_s")) c.rateWindow = sensors.number("rate_window_s");
    sensors.know("rate_window_s");
    c.world.energyBook = sensors.boolean("energy");
    c.world.wallLoads = sensors.boolean("wall_loads");
    if (c.world.wallLoads) checkWallNames(reader, c);
    Section& frames = root.table("frames");
    c.frames.interval = frames.number("interval_s");
    c.frames.contacts = frames.boolean("contacts");
    c.frames.states = frames.boolean("states");
    Section& checkpoint = root.table("checkpoint");
    c.checkpoint.wall = checkpoint.number("wall_s");
    c.checkpoint.simulated = checkpoint.number("time_s");
}

void readTime(CaseReader& reader, Section& root, Case& c) {
    Section& time = root.table("time");
    // Before the step that it leads to, as in the resolved case: a case that has both is read to the same text.
    if (time.has("steps_per_contact")) {
        c.stepsPerContact = time.number("steps_per_contact");
        if (c.stepsPerContact < kFewestSteps)
            reader.fault("time.steps_per_contact",
                         "is unstable: a sphere with many contacts moves twice as fast as one",
                         fmt::format("give at least {}", kFewestSteps));
    }
    if (time.isString("step_s"))
        time.onlyWord("step_s");
    else if (time.has("step_s"))
        c.world.timeStep = time.number("step_s");
    if (time.has("skin_mm")) c.world.skin = time.number("skin_mm");
    time.know("step_s");
    time.know("steps_per_contact");
    time.know("skin_mm");
}

bool readDomain(Section& root, Case& c) {
    root.know("domain");
    if (!root.has("domain")) return false;
    Section& domain = root.table("domain");
    c.world.domain = {domain.vector("low"), domain.vector("high")};
    static constexpr const char* kDirections[] = {"", "x", "y", "z", "xy", "xz", "yz"};  // the words of the key
    for (const char* name = kDirections[domain.choice("periodic").value_or(0)]; *name != '\0'; ++name)
        c.world.period[*name - 'x'] = c.world.domain.high[*name - 'x'] - c.world.domain.low[*name - 'x'];
    return true;
}

}  // namespace vkdose
