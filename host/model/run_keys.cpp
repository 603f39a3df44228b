// The keys of the run: settling, doses and the end, time steps, and what is kept how often.
#include "host/model/case.h"
#include "host/model/case_keys.h"

namespace vkdose {
namespace {

using namespace key;

constexpr Unit kMillinewtonMetre{1e3, "mN m"};

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
    number(
        "damping_factor", kPlain, kPositive, 1.0,
        "damping while settling over that of `[contact]`: under `luding` γ of the normal direction, under the elastic "
        "laws all of it. More of it makes the impacts of the filling shallower, and may need a shorter time step"),
    number("gravity_factor", kPlain, kPositive, 1.0,
           "gravity while settling over `gravity`. With less of it the powder falls gently, and contacts remember "
           "shallower impacts; the doses begin under the whole of it"),
    boolean("elastic", false,
            "contacts are springs of stiffness k₁ while settling. They forget the impacts of the filling, so that the "
            "doses begin with the overlaps that the bed's weight presses"),
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
    word("rule", "none experiment simulation", told("`\"experiment\"`; without doses or a canister `\"none\"`"),
         "`\"experiment\"`: the last `doses` doses together gave no more than `threshold_g`; `\"simulation\"`: they "
         "gave nothing. Both count from the first dose that gives powder. If none does, they end a run without "
         "`max_doses` and `end_time_s` after ten times as many doses. `\"none\"`: one of these two is required")
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
    number("rate_window_s", kSecond, kPositive, told("a turn of the drive, or a twentieth of its time"),
           "length of the windows in which the mass rate is told; at least five intervals. It changes no bit of the "
           "run"),
    boolean("energy", false,
            "keeps the energy ledger. The motion stays the same to the last bit; a step costs half as much again"),
    boolean("wall_loads", false,
            "tells the force and the torque on each wall as those on bodies are told: of a canister on `rear`, "
            "`trough` (or `left`, `right`, `floor`), `front` and `lid`. The motion stays the same to the last bit"),
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
           "longest wall time between two checkpoints; a young run makes them more often; 0: none by the clock"),
    number("time_s", kSecond, kNonNegative, CheckpointInterval{}.simulated,
           "simulated time between two checkpoints; 0: none by simulated time"),
};
constexpr Key kDomain[] = {
    vector("low", kMetre, told("canister and fill with a margin; without a canister the particles, and as much again"),
           "lower corner of the box outside of which a particle is lost, which ends the run"),
    vector("high", kMetre, told("likewise"), "upper corner"),
    word("periodic", "none x y z xy xz yz", "none",
         "directions in which the domain repeats: what leaves it at one end comes in at the other, and spheres touch "
         "across the ends. Needs `low` and `high`"),
};

constexpr KeyTable kTables[] = {
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
};

}  // namespace

std::span<const KeyTable> runKeys() {
    return kTables;
}

}  // namespace vkdose
