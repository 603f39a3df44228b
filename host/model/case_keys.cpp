#include "host/model/case_keys.h"

#include "host/model/case.h"
#include "host/model/grid.h"

namespace vkdose {
namespace {

using namespace key;

constexpr Unit kDensity{1, "kg/m3"};
constexpr Unit kMillinewtonMetre{1e3, "mN m"};
constexpr Bound kPositive = Bound::Positive;
constexpr Bound kNonNegative = Bound::NonNegative;
constexpr std::int64_t kAnyCount = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kMostDoses = 1'000'000'000;
/// Ratio of the sliding (or rolling) stiffness to the normal one with which sliding (or rolling) oscillates as fast as
/// the normal direction (paper).
constexpr double kTwoSevenths = 0.286;

constexpr Key kTop[] = {
    text("base", told("none"), "another case to start from; the path is relative to this file"),
    text("name", told("name of the file"),
         "name of the case and of its default output folder: at most 200 visible characters, no slash, no blank at "
         "either end"),
    text("reason", "", "why the case exists; it is printed"),
    text("accepted_warnings", "",
         "names of warnings of `vkdose check`, separated by blanks, that are expected here and not told by a run"),
    integer("seed", 0, kAnyCount, 1, "sets sizes and positions: the same seed gives the same particles"),
    vector("gravity", {1, "m/s2"}, {0, -9.81, 0}, "acceleration of gravity"),
    number("bulk_density", kDensity, kPositive, 471.0,
           "of the settled powder; only the closed form of the mass per dose uses it. `\"measure\"`: that of this "
           "run's own "
           "bed when it has settled; until then, and if the bed is too small, 0.46 of the particles' density")
        .orElse("measure")
        .replacing("derived"),
    text("derived", told("none"),
         "how `vkdose` came to `bulk_density`; the resolved case has it, and nothing else reads it"),
    word("boundaries", "canister list none", "canister",
         "`\"canister\"`: the walls of `[canister]`; `\"list\"`: each `[[plane]]` and `[[cylinder]]`; `\"none\"`: no "
         "walls")
        .replacing("canister plane cylinder"),
};

constexpr Key kParticles[] = {
    number("density", kDensity, kPositive, kRequired, "of the particles themselves, not of the bed"),
    number("mass_g", kGram, kPositive, told("required without `list`"),
           "mass of the fill; it is met as closely as one particle allows")
        .replacing("list"),
    text("list", told("none"),
         "a CSV of particles to start from in place of a fill; the path is relative to the case file")
        .replacing("mass_g size region grid_gap drop_mm"),
    number(
        "grid_gap", kPlain, kPositive, kGridGap,
        "free way between the largest spheres of the grid that the fill starts from, in their diameters. The larger it "
        "is, the looser and the more irregular is the start, and the longer the fall"),
    number("drop_mm", kMillimetre, kNonNegative, 0.0,
           "height of the grid's lowest spheres over the coil and what follows the drive, or over the floor's axis "
           "without them; "
           "in a canister only"),
};

constexpr Key kUniform[] = {
    word("distribution", "uniform fixed normal lognormal quantiles sieve", kRequired, "the kind of distribution")
        .replacing("*"),
    number("radius_min_mm", kMillimetre, kPositive, kRequired, "smallest radius"),
    number("radius_max_mm", kMillimetre, kPositive, kRequired, "largest radius"),
};
constexpr Key kFixed[] = {
    number("radius_mm", kMillimetre, kPositive, kRequired, "radius of every sphere"),
};
constexpr Key kNormal[] = {
    number("radius_mean_mm", kMillimetre, kPositive, kRequired, "mean radius before the bounds cut"),
    number("radius_deviation_mm", kMillimetre, kPositive, kRequired, "standard deviation of the radius"),
    number("radius_min_mm", kMillimetre, kPositive, told("mean - 2 deviations, at least mean/10"), "smallest radius"),
    number("radius_max_mm", kMillimetre, kPositive, told("mean + 2 deviations"), "largest radius"),
};
constexpr Key kLognormal[] = {
    number("radius_median_mm", kMillimetre, kPositive, kRequired, "median radius before the bounds cut"),
    number("log_deviation", kPlain, kPositive, kRequired, "standard deviation of ln r"),
    number("radius_min_mm", kMillimetre, kPositive, told("median · exp(-2 `log_deviation`)"), "smallest radius"),
    number("radius_max_mm", kMillimetre, kPositive, told("median · exp(2 `log_deviation`)"), "largest radius"),
};
constexpr Key kQuantiles[] = {
    number("scale_up", kPlain, kPositive, 1.0, "size of a simulated meso-particle over that of a grain of the powder"),
    number("d10_um", kMicrometre, kPositive, kRequired, "**diameter** below which 10 % of the powder's volume lies"),
    number("d50_um", kMicrometre, kPositive, kRequired, "diameter below which half of the volume lies"),
    number("d90_um", kMicrometre, kPositive, kRequired, "diameter below which 90 % of the volume lies"),
    number("radius_min_mm", kMillimetre, kPositive, told("where the line through the quantiles reaches 0"),
           "smallest radius, after `scale_up`"),
    number("radius_max_mm", kMillimetre, kPositive, told("where the line through the quantiles reaches 1"),
           "largest radius, after `scale_up`"),
};

constexpr Key kSieve[] = {
    number("scale_up", kPlain, kPositive, 1.0, "size of a simulated meso-particle over that of a grain of the powder"),
    other(
        "openings_um", told("this or `sieves`"),
        "openings of the sieves in µm, from fine to coarse or the other way. The first of the fine end is the diameter "
        "of the finest grains, which the pan holds; the coarsest lets all of the powder pass")
        .replacing("sieves derived"),
    other("passing_percent", told("this or `retained`"),
          "percent of the mass that passes each; 0 at the finest, 100 at the coarsest")
        .replacing("retained sieves derived"),
    other("retained", told("this or `passing_percent`"),
          "mass that lies on each, in any unit; that of the pan at the finest, 0 at the coarsest")
        .replacing("passing_percent sieves derived"),
    text("sieves", told("in place of the table here"),
         "a CSV with the columns `opening_um` and `passing_percent` or `retained`; the path is relative to the case "
         "file")
        .replacing("openings_um passing_percent retained derived"),
    number("radius_min_mm", kMillimetre, kPositive, told("of the finest grains"), "smallest radius, after `scale_up`"),
    number("radius_max_mm", kMillimetre, kPositive, told("of the coarsest sieve"), "largest radius, after `scale_up`"),
    text("derived", told("none"), "the number distribution that the spheres are drawn from; the resolved case has it"),
};

constexpr Key kRegion[] = {
    vector("low", kMetre, kRequired, "lower corner of the box that is filled"),
    vector("high", kMetre, kRequired, "upper corner"),
};

constexpr Key kContactAlone[] = {
    word("coulomb_limit", "luding absolute", "luding", "the force that friction is a fraction of"),
    word("rolling_lever", "full half", "full", "the lever of rolling and torsion"),
    number(
        "max_overlap_ratio", kPlain, kPositive, kMaxOverlapRatio,
        "overlap over smaller radius at which the run stops; at most 2. Particles pinched between coil and wall need "
        "more than the default (the paper's cases say 1)"),
    number("soften", kPlain, kPositive, 1.0,
           "s, at least 1: similar softer spheres. k is divided by s, γ by √s, φ_f multiplied by s, in every class. "
           "Forces of a bed at rest stay, overlaps grow as s, and the time step of `\"auto\"` as √s. The resolved case "
           "states the softer values and `soften = 1`"),
};
constexpr Key kContactClass[] = {
    number("k", {1, "N/m"}, kPositive, told("this or one of the next two"),
           "k̂₂, the largest stiffness of unloading; all other stiffnesses are ratios to it")
        .replacing("contact_duration_s overlap_under_bed derived"),
    number("contact_duration_s", kSecond, kPositive, told("in place of `k`"),
           "k so that a contact on k₁ lasts so long, damping counted: the first column of `vkdose check`")
        .replacing("k overlap_under_bed derived"),
    number(
        "overlap_under_bed", kPlain, kPositive, told("in place of `k`"),
        "k so that the largest overlap under the bed's weight is this fraction of the mean radius. It is that of mean "
        "spheres at the floor in a chain of force, which bears 5 times the mean. Needs `[canister]`")
        .replacing("k contact_duration_s derived"),
    number("k1_over_k", kPlain, kPositive, kRequired, "k₁/k, stiffness of plastic loading; at most 1")
        .replacing("derived"),
    number("kc_over_k", kPlain, kNonNegative, told("this or `bond_number`"), "k_c/k, adhesion, during the doses")
        .replacing("bond_number bond_load derived"),
    number("bond_number", kPlain, kNonNegative, told("in place of `kc_over_k`"),
           "k_c so that the strongest pull of a contact is so many weights of a mean sphere")
        .replacing("kc_over_k derived"),
    word("bond_load", "limit bed", "limit",
         "the load after which the contact pulls so: `\"limit\"`: one beyond the plastic limit, after which it pulls "
         "as strongly as it ever can; `\"bed\"`: the mean force at the floor under the bed's weight"),
    number("plasticity_depth", kPlain, kNonNegative, told("required if k₁ < k"),
           "φ_f, the overlap relative to the radius at which k₂ reaches k")
        .replacing("derived"),
    number("damping", {1, "kg/s"}, kNonNegative, told("this or `restitution`"),
           "γ, of the normal direction; a dashpot, not a restitution")
        .replacing("restitution restitution_speed derived"),
    number("restitution", kPlain, kNonNegative, told("in place of `damping`"),
           "γ so that a head-on impact rebounds with this share of its speed; above 0 and at most 1")
        .replacing("damping derived"),
    number("restitution_speed", {1, "m/s"}, kNonNegative, 0.0,
           "speed of the impact with that `restitution`. 0: the limit of slow impacts, in which damping alone takes "
           "energy. Above: plasticity and adhesion count too"),
    text("derived", told("none"),
         "how `vkdose` came to values of this table; the resolved case has it, and nothing else reads it"),
    number("friction", kPlain, kNonNegative, kRequired, "μ, a coefficient, not an angle"),
    number("kt_over_k", kPlain, kPositive, kTwoSevenths, "k_t/k, stiffness of sliding"),
    number("damping_t_ratio", kPlain, kNonNegative, kTwoSevenths, "γ_t/γ, damping of sliding"),
    number("rolling_friction", kPlain, kNonNegative, 0.0, "μ_r; 0 switches rolling resistance off"),
    number("kr_over_k", kPlain, kPositive, kTwoSevenths, "k_r/k, stiffness of rolling"),
    number("damping_r_ratio", kPlain, kNonNegative, kTwoSevenths, "γ_r/γ, damping of rolling"),
    number("torsion_friction", kPlain, kNonNegative, 0.0, "μ_to; 0 switches torsion resistance off"),
    number("kto_over_k", kPlain, kPositive, kTwoSevenths, "k_to/k, stiffness of torsion"),
    number("damping_to_ratio", kPlain, kNonNegative, kTwoSevenths, "γ_to/γ, damping of torsion"),
};

constexpr Key kCanister[] = {
    number("length_mm", kMillimetre, kPositive, kRequired, "along the coil, from the rear wall to the front wall"),
    number("width_mm", kMillimetre, kPositive, kRequired, "inside width, which is also the diameter of the trough"),
    number("height_mm", kMillimetre, kPositive, kRequired, "from the lowest point of the floor"),
    word("floor", "trough flat", "trough",
         "`\"trough\"`: a half-cylinder around the coil's axis; `\"flat\"`: a plane half a width below the axis"),
    number("outlet_diameter_mm", kMillimetre, kPositive, kRequired,
           "of the hole in the front wall and of the throat behind it; at most `width_mm`"),
    number("throat_length_mm", kMillimetre, kPositive, kRequired, "powder that passes the throat's end is dosed"),
    boolean("lid", false,
            "closes the canister at its height, or above the grid that the fill starts from where that reaches higher. "
            "Without a lid a sphere that the coil pinches and flings out is lost, which ends the run"),
};

constexpr Key kPlane[] = {
    vector("point", kMetre, kRequired, "a point of the plane"),
    vector("normal", kPlain, kRequired, "points to the side of the particles; of any length but zero"),
};
constexpr Key kCylinder[] = {
    vector("base", kMetre, kRequired, "centre of the first end; of an endless one any point of the axis"),
    vector("axis", kPlain, kRequired, "direction of the axis; of any length but zero"),
    number("radius_mm", kMillimetre, kPositive, kRequired, "inner radius if the particles are inside, else outer"),
    number("length_mm", kMillimetre, kPositive, told("endless"), "the cylinder is open at both ends"),
    boolean("inside", true, "whether the particles are inside"),
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

constexpr Key kBody[] = {
    text("name", kRequired, "of the body, in messages and tables: letters, digits, `-` and `_`"),
    word("shape", "mesh plane box ball cylinder cone disc trough wire screw", "mesh",
         "in the body's own frame: a plane through the origin; a box or a ball about it; all others around the z axis, "
         "from z = 0 on")
        .replacing("*"),
    word("contact", "wall coil", "wall",
         "whose contact parameters it has: those of `[contact.wall]` or `[contact.coil]`"),
    vector("at", kMetre, {0, 0, 0}, "where the origin of its frame is at the start"),
    vector("rotation_axis", kPlain, {0, 0, 1}, "direction of the axis about which its frame is turned at the start"),
    number("rotation_deg", kDegree, Bound::Any, 0.0, "the angle of that turn"),
};
constexpr Key kBodyMesh[] = {
    text("mesh", kRequired, "an STL, OBJ or PLY file; the path is relative to the case file"),
    text("unit", kRequired, "of the lengths in the file: `\"m\"`, `\"cm\"`, `\"mm\"`, `\"um\"`, `\"inch\"`"),
};
constexpr Key kBodyShape[] = {
    vector("normal", kPlain, {0, 1, 0}, "`plane`: points to the side of the particles"),
    vector("size_mm", kMillimetre, kRequired, "`box`: its three edges"),
    boolean("inside", false, "`box`: whether it is a room with the particles inside"),
    number("radius_mm", kMillimetre, kPositive, kRequired,
           "`ball`, `cylinder`, `disc`, `screw`: outer radius; `cone`: radius at z = 0; `wire`: of its centre line"),
    number("end_radius_mm", kMillimetre, kNonNegative, kRequired, "`cone`: radius at its other end"),
    number("hole_radius_mm", kMillimetre, kNonNegative, 0.0, "`disc`: of the hole in its middle"),
    number("length_mm", kMillimetre, kPositive, kRequired, "`cylinder`, `cone`, `wire`, `screw`: along z"),
    boolean("ends", false, "`cylinder`: whether a disc closes each end"),
    number("width_mm", kMillimetre, kPositive, kRequired, "`trough`: between its sides; it has no ends"),
    number("pitch_mm", kMillimetre, kPositive, kRequired, "`wire`, `screw`: length of one turn"),
    number("pitch_end_mm", kMillimetre, kPositive, told("`pitch_mm`"), "`screw`: at its end; it changes evenly"),
    number("wire_diameter_mm", kMillimetre, kPositive, kRequired, "`wire`: its thickness"),
    number("shaft_radius_mm", kMillimetre, kPositive, kRequired, "`screw`: of the shaft that carries the blade"),
    number("thickness_mm", kMillimetre, kPositive, kRequired, "`screw`: of the blade, along z"),
    word("hand", "right left", "right", "`wire`, `screw`: hand of the helix"),
};
constexpr Key kMotion[] = {
    word("kind", "turn swing shake slide table", kRequired,
         "`turn`: about an axis at a speed; `swing`: to and fro about it; `shake`: to and fro along it; `slide`: along "
         "a "
         "line; `table`: as a file says")
        .replacing("*"),
    word("follows", "time drive", "time",
         "`\"time\"`: the body moves by itself; `\"drive\"`: it turns while powder is dosed, with the coil's speed or "
         "with `dose.speed_rpm`"),
    vector("axis", kPlain, {0, 0, 1}, "direction of the axis"),
    vector("through", kMetre, {0, 0, 0}, "a point of the axis"),
    number("speed_rpm", kRpm, Bound::Any, kRequired, "`turn` by time: speed about the axis, negative the other way"),
    number("turns_per_turn", kPlain, Bound::Any, 1.0, "`turn` by the drive: its turns for one of the drive"),
    number("amplitude_deg", kDegree, kPositive, kRequired, "`swing`: to each side"),
    number("amplitude_mm", kMillimetre, kPositive, kRequired, "`shake`: to each side"),
    number("frequency_hz", {1, "1/s"}, kPositive, kRequired, "`swing`, `shake`: how often to and fro in a second"),
    number("phase_deg", kDegree, Bound::Any, 0.0, "`swing`, `shake`: of the sine at the start"),
    vector("velocity", {1, "m/s"}, kRequired, "`slide`: of the body"),
    text("file", kRequired,
         "`table`: a CSV with the columns `time_s`, and `angle_deg`, `x`, `y`, `z` (m) or some of them"),
    number("from_s", kSecond, kNonNegative, 0.0, "by time: the body stands until then"),
    number("to_s", kSecond, kPositive, told("for ever"), "by time: and from then on"),
};

constexpr Key kCountRegion[] = {
    text("name", kRequired, "of the region, in messages and tables: letters, digits, `-` and `_`"),
    word("kind", "beyond box", kRequired, "`beyond`: all that lies beyond a plane; `box`: all in a box").replacing("*"),
    boolean("deletes", true, "a sphere whose centre comes into it is dosed; `false`: it is counted and goes on"),
    vector("point", kMetre, kRequired, "`beyond`: of the plane"),
    vector("normal", kPlain, kRequired, "`beyond`: points away from the powder, to the side that counts"),
    vector("low", kMetre, kRequired, "`box`: its low corner"),
    vector("high", kMetre, kRequired, "`box`: its high corner"),
};

constexpr Key kSettle[] = {
    number("time_s", kSecond, kNonNegative, 0.0,
           "duration of settling, with the coil at rest; with `until_rest` the longest one"),
    boolean("until_rest", false,
            "settling ends as soon as the bed rests. A run whose bed still moves after `time_s` goes on and tells it"),
    number(
        "rest_speed_ratio", kPlain, kPositive, 0.01,
        "a bed rests when the root mean square speed of its spheres has stayed below this fraction of v for the time "
        "that the fall takes. v is the speed after a fall from the top of the fill to its bottom"),
    number("kc_over_k", kPlain, kNonNegative, told("that of `[contact]`"),
           "adhesion while settling; a weaker one makes the bed homogeneous"),
    number("wall_kc_over_k", kPlain, kNonNegative, told("the wall's own, or `kc_over_k` above"),
           "adhesion between particle and wall while settling"),
    number("coil_kc_over_k", kPlain, kNonNegative, told("the coil's own, or the wall's above"),
           "adhesion between particle and coil while settling"),
    number("damping_factor", kPlain, kPositive, 1.0,
           "γ of the normal direction while settling over that of `[contact]`. More of it makes the impacts of the "
           "filling shallower, and may need a shorter time step"),
};
constexpr Key kDose[] = {
    number("rotate_s", kSecond, kNonNegative, 0.0,
           "time the coil turns in a dose, ramps included; 0: no doses, the run is the settling")
        .replacing("mass_g max_rotate_s stage"),
    number("mass_g", kGram, kPositive, told("none"),
           "target of a dose: the coil is told to stop at the first sensor interval that finds as much dosed. In place "
           "of `rotate_s`")
        .replacing("rotate_s"),
    number("max_rotate_s", kSecond, kPositive, told("required with `mass_g`"),
           "the longest time that the coil turns for `mass_g`, ramps included"),
    number("ramp_s", kSecond, kNonNegative, 0.0,
           "time of each change of the coil's speed, from 0 and to 0 too; in 32 steps"),
    number("reverse_turns", kPlain, kNonNegative, 0.0,
           "turns that the coil makes backwards after each rotation, at `coil.speed_rpm`"),
    number("max_torque_mNm", kMillinewtonMetre, kPositive, told("none"),
           "largest torque of the drive either way, mean over a sensor interval while the coil conveys"),
    word("at_max_torque", "dose run", "dose",
         "what a larger torque ends: the rotation of the `\"dose\"`, or the `\"run\"`"),
    number("rest_s", kSecond, kNonNegative, 0.0, "rest after each rotation, part of the dose"),
    number("speed_rpm", kRpm, kNonNegative, told("required if bodies follow the drive and there is no coil"),
           "speed of the drive that bodies follow, where there is no coil"),
};
constexpr Key kStage[] = {
    number("speed_rpm", kRpm, kNonNegative, kRequired, "speed of the coil in this stage"),
    number("until", kPlain, kPositive, kRequired, "fraction of `mass_g` at which the stage ends; at most 1"),
};
constexpr Key kStop[] = {
    word("rule", "none experiment simulation", told("`\"experiment\"`; without doses `\"none\"`"),
         "`\"experiment\"`: the last `doses` doses together gave no more than `threshold_g`; `\"simulation\"`: they "
         "gave "
         "nothing; `\"none\"`: `max_doses` or `end_time_s` is required")
        .replacing("threshold_g doses"),
    number("threshold_g", kGram, kNonNegative, 0.15, "for `\"experiment\"`"),
    integer("doses", 1, kMostDoses, 3, "for `\"experiment\"` and `\"simulation\"`"),
    integer("max_doses", 1, kMostDoses, told("none"), "the run ends after so many doses"),
    number("end_time_s", kSecond, kPositive, told("none"), "the run ends at this simulated time; settling counts"),
};
constexpr Key kTime[] = {
    number("step_s", kSecond, kPositive, told("`\"auto\"`"),
           "time step. `\"auto\"`: 1/8 of the stiffest normal contact, 1/6 of any other, half of the fastest damping "
           "time, whichever is least, cut to three digits")
        .orElse("auto")
        .replacing("steps_per_contact"),
    number(
        "steps_per_contact", kPlain, kPositive,
        told("8 in a normal contact and 6 in any other; of a stated `step_s` 5"),
        "least number of time steps in half a period of the fastest motion of a contact: normal, sliding, rolling or "
        "torsion. `\"auto\"` takes as many, a stated `step_s` with fewer is refused. At least 4")
        .replacing("step_s"),
    number("skin_mm", kMillimetre, kPositive, told("0.6 of the mean radius"),
           "extra reach of the neighbour rows: larger means longer rows that are rebuilt less often"),
};
constexpr Key kSensors[] = {
    number("interval_s", kSecond, kPositive, 0.01, "between two lines of the time series; rounded to whole steps"),
    boolean("energy", false,
            "keeps the energy ledger. The motion stays the same to the last bit; a step costs half as much again"),
};
constexpr Key kFrames[] = {
    number("interval_s", kSecond, kNonNegative, 0.0,
           "between two frames; rounded to whole sensor intervals and no shorter than one; 0: no frames. It changes no "
           "bit of the run"),
    boolean("contacts", false, "stores the contacts as well"),
    boolean("states", false,
            "stores the whole state of the run with each frame, from which `vkdose run --from DIR --at TIME` begins; a "
            "member of a study stores none"),
};
constexpr Key kCheckpoint[] = {
    number("wall_s", kSecond, kNonNegative, CheckpointInterval{}.wall,
           "wall time between two checkpoints; 0: none by the clock"),
    number("time_s", kSecond, kNonNegative, CheckpointInterval{}.simulated,
           "simulated time between two checkpoints; 0: none by simulated time"),
};
constexpr Key kDomain[] = {
    vector("low", kMetre, told("canister and fill with a margin; without a canister the particles, and as much again"),
           "lower corner of the box outside of which a particle is lost, which ends the run"),
    vector("high", kMetre, told("likewise"), "upper corner"),
};

constexpr Key kField[] = {
    word("preset", "grid height-profile mid-plane outlet", "grid",
         "sets box and cells; `\"grid\"` is the whole canister in three directions"),
    text("name", told("the preset's; of grids `field-1`, ..."), "of its files: letters, digits, `-` and `_`"),
    word("kernel", "gaussian lucy", "gaussian", "`\"gaussian\"` is cut at three widths; `\"lucy\"` ends at its width"),
    number("width_mm", kMillimetre, kPositive, told("mean diameter; Lucy: two"), "width of the kernel"),
    boolean("average", false, "the mean of all sensor intervals since the field before, in place of the instant"),
    boolean("stress", false, "adds contact and kinetic stress, granular temperature and coordination"),
    vector("low", kMetre, told("the preset's; required without a canister"), "lower corner of the grid"),
    vector("high", kMetre, told("the preset's; required without a canister"), "upper corner"),
    vector("cells", kPlain, told("as wide as the kernel, Lucy half; 1 where the preset does not resolve"),
           "along x, y and z. A direction with one cell is averaged over. At most 10⁶ in all"),
    number("interval_s", kSecond, kPositive, told("`sensors.interval_s`; of maps ten of them"),
           "between two fields that are kept; rounded to whole sensor intervals"),
    number("initial_height_mm", kMillimetre, kNonNegative, 0.0,
           "`\"height-profile\"` only: h_ini; 0: as the density of the bed tells"),
};

constexpr Key kMeasure[] = {
    word("kind", ElementTest::kKinds, kRequired, "the element test").replacing("*"),
    text("name", told("the kind"), "of its figures: letters, digits, `-` and `_`"),
    vector("at", kMetre, {0, 0, 0},
           "`angle_of_repose`, `bulk_density`: a point of the upright axis, at the height of the foot or floor"),
    number("radius_mm", kMillimetre, kPositive, kRequired,
           "`bulk_density`: inner radius of the round container; `shear`: of the cell"),
    number("time_s", kSecond, kNonNegative, told("the end of the run"),
           "`angle_of_repose`, `bulk_density`: the frame nearest to it is looked at"),
    text("body", kRequired,
         "`drum_angle`: the body that turns as the drum; `compression`: the piston; `shear`: the lid, and behind "
         "it, separated by blanks, what is fixed to it"),
    number("area_mm2", {1e6, "mm2"}, kPositive, kRequired, "`compression`: cross-section of the bed"),
    number("height_mm", kMillimetre, kPositive, kRequired,
           "`compression`: from the floor of the bed to the piston's face before it moves"),
    vector("axis", kPlain, {0, 1, 0}, "`compression`: direction from the floor to the piston"),
    number("inner_radius_mm", kMillimetre, kNonNegative, 0.0, "`shear`: of the inner wall of a ring; 0: a full cell"),
    text("region", kRequired, "`discharge`: the region into which the powder runs"),
    number("hole_mm", kMillimetre, kPositive, told("no constant"),
           "`discharge`: diameter of the round hole, for the constant of Beverloo's law; it takes `bulk_density` too"),
    other("from_s", kRequired,
          "`drum_angle`: the frames from this time on count; `discharge`: the rate is taken from this time on; "
          "`shear`: for each point of the yield locus the time "
          "from which load and torque are averaged"),
    other("to_s", told("required by `shear`; else the end of the run"), "the times until which they count"),
};

constexpr KeyTable kTables[] = {
    {"", kTop, ""},
    {"particles", kParticles, ""},
    {"particles.size", kUniform, "Radii spread evenly, `distribution = \"uniform\"`:"},
    {"particles.size", kFixed, "One radius, `\"fixed\"`:"},
    {"particles.size", kNormal, "Normal radii, `\"normal\"`. A draw outside the bounds is drawn again:"},
    {"particles.size", kLognormal, "Lognormal radii, `\"lognormal\"`. A draw outside the bounds is drawn again:"},
    {"particles.size", kQuantiles, "Measured quantiles of the volume, `\"quantiles\"`:"},
    {"particles.size", kSieve,
     "A sieve analysis, `\"sieve\"`. Between two sieves the mass is spread evenly over the logarithm of the size:"},
    {"particles.region", kRegion, "The box to fill, where `boundaries` is `\"list\"` or `\"none\"`."},
    {"contact contact.wall contact.coil", kContactClass,
     "`[contact]` holds the parameters between particles. `[contact.wall]` replaces single ones for the walls,\n"
     "`[contact.coil]` for the coil. The coil takes what it does not state from the wall, and the wall from "
     "`[contact]`. What is given in place of `k`, `kc_over_k` or `damping` holds for two spheres of the mean radius; "
     "at\n"
     "a wall and at the coil for one such sphere. It is inherited as it is given: with one `restitution` each class "
     "gets\n"
     "the damping that its own mass needs."},
    {"contact", kContactAlone, "These hold for all contacts."},
    {"canister", kCanister, ""},
    {"plane[]", kPlane, "A wall without end, for `boundaries = \"list\"`."},
    {"cylinder[]", kCylinder, "A round wall, for `boundaries = \"list\"`."},
    {"coil", kCoil,
     "A round wire on a helix, closed by round caps, turns as a rigid body. Without this table there is no coil."},
    {"body[]", kBody,
     "A body of your own: a mesh, or an exact shape. It has a place, and may move. Keys for all bodies:"},
    {"body[]", kBodyMesh, "A mesh from a CAD program, `shape = \"mesh\"`:"},
    {"body[]", kBodyShape, "The other shapes take those of these keys that name them:"},
    {"body[].motion", kMotion,
     "How the body moves; without this table it rests. Axes and points stand in the frame of the case."},
    {"region[]", kCountRegion,
     "Where powder is dosed or counted, a table for each. Without a region that deletes, powder is dosed behind the "
     "throat of a canister, and nowhere else."},
    {"settle", kSettle, "The run begins with the coil at rest."},
    {"dose", kDose, "Then the coil turns and rests, dose after dose."},
    {"dose.stage[]", kStage,
     "Coarse stages of a dose to a mass, by rising `until`. After the last one the coil turns at `coil.speed_rpm`."},
    {"stop", kStop, "A run ends when one of these conditions holds, or when the canister is empty."},
    {"time", kTime, ""},
    {"sensors", kSensors, ""},
    {"frames", kFrames, ""},
    {"checkpoint", kCheckpoint, ""},
    {"domain", kDomain, ""},
    {"field[]", kField, "A field to take while the run goes on, a table for each."},
    {"measure[]", kMeasure,
     "An element test: a figure of the powder that is taken when the run is over, a table for each. Every kind takes "
     "those of these keys that name it:"},
};

}  // namespace

std::span<const KeyTable> caseKeys() {
    return kTables;
}

}  // namespace vkdose
