// The tables of time: [settle] (its time), [dose], [stop], [sensors], [frames], [checkpoint], [time]; and [domain].
#include <fmt/format.h>

#include <set>

#include "host/model/case_sections.h"
#include "host/model/stability.h"

namespace vkdose {
namespace {

void readDose(CaseReader& reader, Section& dose, bool coil, const std::vector<RigidBody>& bodies, Schedule& s) {
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
    if (!coil && followsDrive(bodies))
        s.coilSpeed = dose.number("speed_rpm");
    else if (dose.has("speed_rpm"))
        reader.fault(dose.path("speed_rpm"),
                     coil ? "has no use beside a coil" : "has no use, because no body follows the drive",
                     coil ? "give coil.speed_rpm alone; bodies that follow the drive go with the coil"
                          : "leave it out, or let a body follow the drive (follows = \"drive\")");
}

StopRule readStop(Section& root, bool canister) {
    // The threshold is that of a canister's experiment. Other devices fill and deliver in ways of their own.
    Section& section = root.table("stop");
    StopRule stop;
    const auto rule = section.choice("rule", canister ? std::size_t{1} : std::size_t{0});
    if (!rule) {
        section.abandon();
        return stop;
    }
    stop.kind = static_cast<StopRule::Kind>(*rule);
    stop.threshold = 0;
    if (stop.kind == StopRule::Kind::Experiment) stop.threshold = section.number("threshold_g");
    if (stop.kind != StopRule::Kind::None) stop.doses = static_cast<int>(section.integer("doses"));
    if (section.has("max_doses")) stop.maxDoses = static_cast<int>(section.integer("max_doses"));
    if (section.has("end_time_s")) stop.endTime = section.number("end_time_s");
    section.know("max_doses");
    section.know("end_time_s");
    return stop;
}

/// The columns of loads begin with the name of a wall, or of a body.
void checkWallNames(CaseReader& reader, const WallsRead& walls, bool coil, const std::vector<RigidBody>& bodies) {
    constexpr const char* kLoads = "sensors.wall_loads";
    if (walls.walls.empty())
        reader.fault(kLoads, "there are no walls", "leave it out; the loads on bodies are always told");
    std::set<std::string> names;
    for (const Wall& wall : walls.walls) names.insert(wall.name);
    if (walls.canister && walls.canister->lid) names.insert("lid");
    for (const RigidBody& body : bodies)
        if (names.contains(body.name))
            reader.fault(kLoads, fmt::format("a wall and a body are both called \"{}\"", body.name),
                         "give the body another name");
    if (coil && names.contains(kCoilName))
        reader.fault(kLoads, fmt::format("a wall is called \"{}\", which is the name of [coil]", kCoilName),
                     "give the wall another name");
}

}  // namespace

ScheduleRead readSchedule(CaseReader& reader, Section& root, const WallsRead& walls, const CoilRead& coil,
                          const std::vector<RigidBody>& bodies) {
    ScheduleRead read;
    Schedule& schedule = read.schedule;
    schedule.coilSpeed = coil.speed;
    Section& settle = root.table("settle");
    schedule.settleTime = settle.number("time_s");
    schedule.untilRest = settle.boolean("until_rest");
    schedule.restSpeedRatio = settle.number("rest_speed_ratio");
    schedule.settleGravityFactor = settle.number("gravity_factor");
    readDose(reader, root.table("dose"), coil.coil.has_value(), bodies, schedule);
    schedule.stop = readStop(root, schedule.rotateTime > 0 && walls.canister);
    Section& sensors = root.table("sensors");
    read.sensorInterval = sensors.number("interval_s");
    if (sensors.has("rate_window_s")) read.rateWindow = sensors.number("rate_window_s");
    sensors.know("rate_window_s");
    read.energyBook = sensors.boolean("energy");
    read.wallLoads = sensors.boolean("wall_loads");
    if (read.wallLoads) checkWallNames(reader, walls, coil.coil.has_value(), bodies);
    Section& frames = root.table("frames");
    read.frames.interval = frames.number("interval_s");
    read.frames.contacts = frames.boolean("contacts");
    read.frames.states = frames.boolean("states");
    Section& checkpoint = root.table("checkpoint");
    read.checkpoint.wall = checkpoint.number("wall_s");
    read.checkpoint.simulated = checkpoint.number("time_s");
    return read;
}

TimeRead readTime(CaseReader& reader, Section& root) {
    TimeRead read;
    Section& time = root.table("time");
    // Before the step that it leads to, as in the resolved case: a case that has both is read to the same text.
    if (time.has("steps_per_contact")) {
        read.stepsPerContact = time.number("steps_per_contact");
        if (read.stepsPerContact < kFewestSteps)
            reader.fault("time.steps_per_contact",
                         "is unstable: a sphere with many contacts moves twice as fast as one",
                         fmt::format("give at least {}", kFewestSteps));
    }
    if (time.isString("step_s"))
        time.onlyWord("step_s");
    else if (time.has("step_s"))
        read.step = time.number("step_s");
    if (time.has("skin_mm")) read.skin = time.number("skin_mm");
    time.know("step_s");
    time.know("steps_per_contact");
    time.know("skin_mm");
    return read;
}

std::optional<DomainRead> readDomain(Section& root) {
    root.know("domain");
    if (!root.has("domain")) return std::nullopt;
    Section& domain = root.table("domain");
    DomainRead read{{domain.vector("low"), domain.vector("high")}};
    static constexpr const char* kDirections[] = {"", "x", "y", "z", "xy", "xz", "yz"};  // the words of the key
    for (const char* name = kDirections[domain.choice("periodic").value_or(0)]; *name != '\0'; ++name)
        read.period[*name - 'x'] = read.box.high[*name - 'x'] - read.box.low[*name - 'x'];
    return read;
}

}  // namespace vkdose
