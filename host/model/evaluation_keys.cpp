// The keys of what is taken from the powder: fields while the run goes on, element tests when it is over.
#include "host/model/case_keys.h"
#include "host/model/element_test.h"

namespace vkdose {
namespace {

using namespace key;

constexpr Key kField[] = {
    word("preset", "grid height-profile mid-plane outlet", "grid",
         "sets box and cells; `\"grid\"` is the whole canister in three directions"),
    text("name", told("the preset's; of grids `field-1`, ..."), "of its files: letters, digits, `-` and `_`")
        .following("preset"),
    text("powder", told("all"), "name of a powder, where there are several: the field is that of its particles alone"),
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
    text("name", told("the kind"), "of its figures: letters, digits, `-` and `_`").following("kind"),
    vector("at", kMetre, {0, 0, 0},
           "`angle_of_repose`, `bulk_density`: a point of the upright axis, at the height of the foot or floor"),
    word("view", ElementTest::kViews, "bulk",
         "`angle_of_repose`, `drum_angle`: how the surface is looked at. `\"bulk\"`: all of the powder counts; "
         "`\"side\"`, of a heap: as photographs of its outline show it; `\"front\"`, of a drum: as the mean of "
         "photographs through its glass shows it"),
    number("window_mm", kMillimetre, kPositive, told("required with `view = \"front\"`"),
           "`drum_angle`: the line is fitted to the surface less than this to the left and to the right of the drum's "
           "axis"),
    number("radius_mm", kMillimetre, kPositive, kRequired,
           "`bulk_density`: inner radius of the round container; `shear`: of the cell"),
    number("time_s", kSecond, kNonNegative, told("the end of the run"),
           "`angle_of_repose`, `bulk_density`: the frame nearest to it is looked at"),
    text("body", kRequired,
         "`drum_angle`: the body that turns as the drum; `compression`: the piston; `shear`: the lid, which "
         "turns, swings, follows a table or moves freely along a line, and behind it, separated by blanks, what is "
         "fixed to it"),
    number("area_mm2", {1e6, "mm2"}, kPositive, kRequired, "`compression`: cross-section of the bed"),
    number("height_mm", kMillimetre, kPositive, kRequired,
           "`compression`: from the floor of the bed to the piston's face before it moves"),
    vector("axis", kPlain, {0, 1, 0}, "`compression`: direction from the floor to the piston"),
    number("inner_radius_mm", kMillimetre, kNonNegative, 0.0, "`shear`: of the inner wall of a ring; 0: a full cell"),
    text("region", kRequired,
         "`discharge`: the region into which the powder runs; `content`: the region with the powder"),
    number("hole_mm", kMillimetre, kPositive, told("no constant"),
           "`discharge`: diameter of the round hole, for the constant of Beverloo's law; it takes `bulk_density` too"),
    other("from_s", kRequired,
          "`drum_angle`: the frames from this time on count; `discharge`, `content`: rate or mean are taken from this "
          "time on; `shear`: for each point of the yield locus the time from which load and torque are averaged"),
    other("pre_shear_from_s", told("no pre-shear"),
          "`shear`: for each point the time from which the steady flow before it is averaged; the point is then the "
          "largest shear stress of its own time"),
    other("pre_shear_to_s", told("required with `pre_shear_from_s`"), "`shear`: the times until which they count"),
    other("to_s", told("required by `shear`; else the end of the run"), "the times until which they count"),
};

constexpr KeyTable kTables[] = {
    {"field[]", kField, "A field to take while the run goes on, a table for each."},
    {"measure[]", kMeasure,
     "An element test: a figure of the powder that is taken when the run is over, a table for each. Every kind takes "
     "those of these keys that name it:"},
};

}  // namespace

std::span<const KeyTable> evaluationKeys() {
    return kTables;
}

}  // namespace vkdose
