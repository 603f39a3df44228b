// The keys of what the powder touches: canister and walls, the coil, motions of bodies; and where powder is dosed.
#include "host/model/body_shapes.h"
#include "host/model/case_keys.h"

namespace vkdose {
namespace {

using namespace key;

constexpr Key kCanister[] = {
    number("length_mm", kMillimetre, kPositive, kRequired, "along the coil, from the rear wall to the front wall"),
    number("width_mm", kMillimetre, kPositive, kRequired, "inside width, which is also the diameter of the trough"),
    number("height_mm", kMillimetre, kPositive, kRequired, "from the lowest point of the floor"),
    word("floor", "trough flat", "trough",
         "`\"trough\"`: a half-cylinder around the coil's axis; `\"flat\"`: a plane half a width below the axis"),
    number("outlet_diameter_mm", kMillimetre, kPositive, kRequired,
           "of the hole in the front wall and of the throat behind it; at most `width_mm`"),
    number("throat_length_mm", kMillimetre, kPositive, kRequired, "powder that passes the throat's end is dosed"),
    text("material", told("that of the walls"), "name of a `[[material]]` that its walls are made of"),
    boolean("lid", false,
            "closes the canister at its height, or above the grid that the fill starts from where that reaches higher. "
            "Without a lid a sphere that the coil pinches and flings out is lost, which ends the run"),
};

constexpr Key kPlane[] = {
    text("name", told("`plane-` and its number among the planes, from 0"),
         "under which its loads are told, if `sensors.wall_loads` asks for them"),
    vector("point", kMetre, kRequired, "a point of the plane"),
    vector("normal", kPlain, kRequired, "points to the side of the particles; of any length but zero"),
    text("material", told("that of the walls"), "name of a `[[material]]` that it is made of"),
};
constexpr Key kCylinder[] = {
    text("name", told("`cylinder-` and its number among the cylinders, from 0"), "as of a plane"),
    vector("base", kMetre, kRequired, "centre of the first end; of an endless one any point of the axis"),
    vector("axis", kPlain, kRequired, "direction of the axis; of any length but zero"),
    number("radius_mm", kMillimetre, kPositive, kRequired, "inner radius if the particles are inside, else outer"),
    number("length_mm", kMillimetre, kPositive, told("endless"), "the cylinder is open at both ends"),
    boolean("inside", true, "whether the particles are inside"),
    text("material", told("that of the walls"), "name of a `[[material]]` that it is made of"),
};

constexpr Key kCoil[] = {
    number("length_mm", kMillimetre, kPositive, kRequired, "along the axis; as a rule canister and throat together"),
    number("turns", kPlain, kPositive, told("this or `pitch_mm`"), "number of turns over the whole length")
        .replacing("pitch_mm"),
    number("pitch_mm", kMillimetre, kPositive, told("this or `turns`"), "length of one turn").replacing("turns"),
    number("wire_diameter_mm", kMillimetre, kPositive, kRequired, "thickness of the wire"),
    number("radius_mm", kMillimetre, kPositive, told("this or `clearance_mm`"),
           "from the axis to the wire's centre line")
        .replacing("clearance_mm"),
    number("clearance_mm", kMillimetre, kPositive, told("this or `radius_mm`"),
           "gap between the wire and the narrower of trough and hole")
        .replacing("radius_mm"),
    number("z_start_mm", kMillimetre, Bound::Any, 0.0, "where the coil begins"),
    number("start_angle_deg", kDegree, Bound::Any, 0.0, "of the wire's beginning, from +x towards +y"),
    word("hand", "right left", "right", "hand of the helix"),
    number("speed_rpm", kRpm, kNonNegative, kRequired, "speed during a dose, in the sense that conveys towards +z"),
    boolean(
        "surface_velocity", true,
        "whether damping, friction and rolling resistance at the coil see its surface move. `false`: they see it at "
        "rest, though the coil turns"),
    boolean(
        "wire_curvature", false,
        "whether the reduced size a* of a contact with the coil counts the wire's curvature, as that of a sphere of "
        "its thickness. `false`: the wire is as flat as a wall"),
};

constexpr Key kMotion[] = {
    word("kind", "turn swing shake slide table free hinge", kRequired,
         "`turn`: about an axis at a speed; `swing`: to and fro about it; `shake`: to and fro along it; `slide`: along "
         "a line; `table`: as a file says; `free`: as gravity and forces say, those of the particles among them; "
         "`hinge`: about an axis, as their torques say")
        .replacing("*"),
    word("follows", "time drive", "time",
         "`\"time\"`: the body moves by itself; `\"drive\"`: it turns while powder is dosed, with the coil's speed or "
         "with `dose.speed_rpm`"),
    vector("axis", kPlain, {0, 0, 1}, "direction of the axis"),
    vector("through", kMetre, {0, 0, 0}, "a point of the axis"),
    number("speed_rpm", kRpm, Bound::Any, told("required; `hinge`: 0"),
           "`turn` by time: speed about the axis, negative the other way; `hinge`: at its start"),
    number("turns_per_turn", kPlain, Bound::Any, 1.0, "`turn` by the drive: its turns for one of the drive"),
    integer("pockets", 1, kMostPockets, told("none"),
            "`turn`: of a wheel, or whatever repeats itself so often in a turn. The mass of each is told: a "
            "[cycle](../host/analysis/README.md#mass-by-cycle) is a pocket then. It changes no bit of the run"),
    number("amplitude_deg", kDegree, kPositive, kRequired, "`swing`: to each side"),
    number("amplitude_mm", kMillimetre, kPositive, kRequired, "`shake`: to each side"),
    number("frequency_hz", {1, "1/s"}, kPositive, kRequired, "`swing`, `shake`: how often to and fro in a second"),
    number("phase_deg", kDegree, Bound::Any, 0.0, "`swing`, `shake`: of the sine at the start"),
    vector("velocity", {1, "m/s"}, told("required; `free`: [0, 0, 0]"), "`slide`: of the body; `free`: at its start"),
    number("mass_g", kGram, kPositive, told("required; `hinge`: none"),
           "`free`: of the body, whatever its form; `hinge`: for its weight, which acts at `centre`"),
    vector("centre", kMetre, told("required with `mass_g`"), "`hinge`: centre of its mass, at the start, in the world"),
    number("inertia_g_mm2", {1e9, "g mm2"}, kPositive, kRequired, "`hinge`: moment of inertia about the axis"),
    number("torque_mNm", {1e3, "mN m"}, Bound::Any, 0.0,
           "`hinge`: a torque on the body about the axis, positive by the right hand"),
    number("damping_mNm_s", {1e3, "mN m s"}, kNonNegative, 0.0,
           "`hinge`: this by its rate in rad/s is a torque against it"),
    number("lowest_deg", kDegree, Bound::Any, told("none"), "`hinge`: a stop; its turn, from its start, goes no lower"),
    number("highest_deg", kDegree, Bound::Any, told("none"), "`hinge`: likewise, and no higher"),
    vector("along", kPlain, told("anywhere"), "`free`: the direction of the line on which it is guided, either way"),
    number("force_N", {1, "N"}, Bound::Any, 0.0, "`free` with `along`: a force on the body in that direction"),
    number("damping_kg_s", {1, "kg/s"}, kNonNegative, 0.0, "`free`: this by its velocity is a force against it"),
    number("lowest_mm", kMillimetre, Bound::Any, told("none"),
           "`free` with `along`: a stop; its way along that direction, from its start, goes no lower"),
    number("highest_mm", kMillimetre, Bound::Any, told("none"), "`free` with `along`: likewise, and no higher"),
    text("file", told("required by `table`"),
         "`table`: a CSV with the columns `time_s`, and `angle_deg`, `x`, `y`, `z` (m) or some of them. `free` with "
         "`along`: in place of `force_N`, a CSV with `time_s`, and `force_N` along the line, `angle_deg` about it, or "
         "both. `hinge`: in place of `torque_mNm`, a CSV with `time_s` and `torque_mNm`"),
    number("from_s", kSecond, kNonNegative, 0.0,
           "by time, or `free`, `hinge`: the body stands until then, and its table begins then"),
    number("to_s", kSecond, kPositive, told("for ever"), "by time: and from then on"),
    text("during", told("at all times"),
         "by time: the phases in which the body moves, separated by blanks: `settle`, `rotate`, `reverse`, `rest`. In "
         "all others it stands, and the time of its motion with it. In place of `from_s` and `to_s`. `free`, "
         "`hinge`: the phases in which force, torque and turn act, and the time of the table goes on"),
    boolean("anew", false,
            "`table` with `during`: it starts anew when the first of these phases begins, once it has come to its end. "
            "Its last row must be the place of its first, or whole turns from it"),
};

constexpr Key kCountRegion[] = {
    text("name", kRequired, "of the region, in messages and tables: letters, digits, `-` and `_`"),
    word("kind", "beyond box", kRequired, "`beyond`: all that lies beyond a plane; `box`: all in a box").replacing("*"),
    boolean("deletes", true, "a sphere whose centre comes into it is dosed; `false`: it is counted and goes on"),
    text("moves_with", told("it rests"),
         "name of a `[[body]]` that carries it: it is given where the body starts; it needs `deletes = false`"),
    vector("point", kMetre, kRequired, "`beyond`: of the plane"),
    vector("normal", kPlain, kRequired, "`beyond`: points away from the powder, to the side that counts"),
    vector("low", kMetre, kRequired, "`box`: its low corner"),
    vector("high", kMetre, kRequired, "`box`: its high corner"),
};

}  // namespace

std::span<const KeyTable> apparatusKeys() {
    static const KeyTable kTables[] = {
        {"canister", kCanister, ""},
        {"plane[]", kPlane, "A wall without end, for `boundaries = \"list\"`."},
        {"cylinder[]", kCylinder, "A round wall, for `boundaries = \"list\"`."},
        {"coil", kCoil,
         "A round wire on a helix, closed by round caps, turns as a rigid body. Without this table there is no coil."},
        {"body[]", bodyKeys(),
         "A body of your own: a mesh, or an exact shape. It has a place, and may move. Keys for all bodies:"},
        {"body[]", bodyMeshKeys(), "A mesh from a CAD program, `shape = \"mesh\"`:"},
        {"body[]", bodyShapeKeys(), "The other shapes take those of these keys that name them:"},
        {"body[].motion", kMotion,
         "How the body moves; without this table it rests. Axes and points stand in the frame of the case."},
        {"region[]", kCountRegion,
         "Where powder is dosed or counted, a table for each. Without a region that deletes, powder is dosed behind "
         "the "
         "throat of a canister, and nowhere else."},
    };
    return kTables;
}

}  // namespace vkdose
