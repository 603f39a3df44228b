// The keys of the powder: its mass, its sizes and where it starts.
#include "host/model/case_keys.h"
#include "host/model/grid.h"

namespace vkdose {
namespace {

using namespace key;

constexpr Key kParticles[] = {
    number("density", kKilogramPerCubicMetre, kPositive, kRequired, "of the particles themselves, not of the bed"),
    number("mass_g", kGram, kPositive, told("this, `fill_height_mm` or `list`"),
           "mass of the fill, of the first powder where there are several; it is met as closely as one particle allows")
        .replacing("list fill_height_mm"),
    number("fill_height_mm", kMillimetre, kPositive, told("in place of `mass_g`"),
           "height over the lowest point of the vessel `inside`, along +y, up to which the settled powder fills it: "
           "`mass_g` is `bulk_density` times the room of the vessel below")
        .replacing("list mass_g"),
    text("material", "powder",
         "name of what the powder is made of, where there are [several](#several-powders-and-materials): letters, "
         "digits and `_`. It names the powder too"),
    boolean("mixed", false,
            "whether all powders start mixed, at random places of one grid in the region of the first. `false`: each "
            "on a grid of its own"),
    text("list", told("none"),
         "a CSV of particles to start from in place of a fill; the path is relative to the case file")
        .replacing("mass_g fill_height_mm size region grid_gap drop_mm inside"),
    text("inside", told("none"),
         "names of `[[body]]`, separated by blanks, which are the vessel that the powder starts in: the grid fills the "
         "box "
         "around them in the largest room that is clear of bodies. In place of `[particles.region]`, "
         "which may bound it. Not in a canister"),
    number(
        "grid_gap", kPlain, kPositive, kGridGap,
        "free way between the largest spheres of the grid that the fill starts from, in their diameters. The larger it "
        "is, the looser and the more irregular is the start, and the longer the fall"),
    number("drop_mm", kMillimetre, kNonNegative, 0.0,
           "height of the grid's lowest spheres over the coil and what follows the drive, or over the floor's axis "
           "without them; "
           "in a canister only"),
};

/// Of the kinds whose radii are those of the powder.
constexpr Key kScaleUp = number("scale_up", kPlain, kPositive, 1.0,
                                "size of a simulated sphere over that of a grain: all radii are of grains");

constexpr Key kUniform[] = {
    word("distribution", "uniform fixed normal lognormal quantiles sieve", kRequired, "the kind of distribution")
        .replacing("*"),
    kScaleUp,
    number("radius_min_mm", kMillimetre, kPositive, kRequired, "smallest radius"),
    number("radius_max_mm", kMillimetre, kPositive, kRequired, "largest radius"),
};
constexpr Key kFixed[] = {
    kScaleUp,
    number("radius_mm", kMillimetre, kPositive, kRequired, "radius of every sphere"),
};
constexpr Key kNormal[] = {
    kScaleUp,
    number("radius_mean_mm", kMillimetre, kPositive, kRequired, "mean radius before the bounds cut"),
    number("radius_deviation_mm", kMillimetre, kPositive, kRequired, "standard deviation of the radius"),
    number("radius_min_mm", kMillimetre, kPositive, told("mean - 2 deviations, at least mean/10"), "smallest radius"),
    number("radius_max_mm", kMillimetre, kPositive, told("mean + 2 deviations"), "largest radius"),
};
constexpr Key kLognormal[] = {
    kScaleUp,
    number("radius_median_mm", kMillimetre, kPositive, kRequired, "median radius before the bounds cut"),
    number("log_deviation", kPlain, kPositive, kRequired, "standard deviation of ln r"),
    number("radius_min_mm", kMillimetre, kPositive, told("median · exp(-2 `log_deviation`)"), "smallest radius"),
    number("radius_max_mm", kMillimetre, kPositive, told("median · exp(2 `log_deviation`)"), "largest radius"),
};
constexpr Key kQuantiles[] = {
    number("scale_up", kPlain, kPositive, 1.0, "size of a simulated sphere over that of a grain of the powder"),
    number("d10_um", kMicrometre, kPositive, kRequired, "**diameter** below which 10 % of the powder's volume lies"),
    number("d50_um", kMicrometre, kPositive, kRequired, "diameter below which half of the volume lies"),
    number("d90_um", kMicrometre, kPositive, kRequired, "diameter below which 90 % of the volume lies"),
    number("radius_min_mm", kMillimetre, kPositive, told("where the line through the quantiles reaches 0"),
           "smallest radius, after `scale_up`"),
    number("radius_max_mm", kMillimetre, kPositive, told("where the line through the quantiles reaches 1"),
           "largest radius, after `scale_up`"),
};

constexpr Key kSieve[] = {
    number("scale_up", kPlain, kPositive, 1.0, "size of a simulated sphere over that of a grain of the powder"),
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

constexpr Key kPowder[] = {
    text("name", kRequired, "of the powder, in columns and pictures: letters, digits and `_`"),
    text("material", told("`name`"), "name of what it is made of, in the names of pairs and in `[[material]]`"),
    number("density", kKilogramPerCubicMetre, kPositive, told("that of its `[[material]]`"),
           "of the particles themselves"),
    number("mass_g", kGram, kPositive, told("required without `particles.list`"),
           "mass of the fill; it is met as closely as one particle allows"),
};

constexpr Key kMaterial[] = {
    text("name", kRequired, "letters, digits and `_`; not `wall` and `coil`, which `[contact]` knows"),
    number("density", kKilogramPerCubicMetre, kPositive, told("none"),
           "if a powder is made of it and does not state its own"),
    number("youngs_modulus", {1, "Pa"}, kPositive, told("required unless `luding`"), "E"),
    number("poisson_ratio", kPlain, kNonNegative, told("required unless `luding`"), "ν; at most 0.5"),
};

constexpr std::int64_t kMostRefills = 1000;

constexpr Key kRefill[] = {
    text("name", kRequired, "of the refill, in messages and for `add_powder`: letters, digits, `-` and `_`"),
    text("powder", told("the first"), "name of the powder that is added, where there are several"),
    number("mass_g", kGram, kPositive, kRequired, "mass of the powder; it is met as closely as one particle allows"),
    number("time_s", kSecond, kPositive, told("none"),
           "simulated time, settling included: it is added at the first sensor interval that ends no earlier")
        .replacing("before_dose below_g region"),
    integer("before_dose", 1, kMostDoses, told("none"), "it is added when this dose is about to begin")
        .replacing("time_s below_g region every_s times"),
    number("below_g", kGram, kPositive, told("none"),
           "it is added when the powder that is watched falls below this mass, after it was above: a hopper's lower "
           "mark. Looked at with each reading of the sensors")
        .replacing("time_s before_dose every_s"),
    text("region", told("all powder that is not dosed"), "a `[[region]]` that counts: its content is what is watched"),
    number("every_s", kSecond, kPositive, told("none"),
           "with `time_s`: the next one comes so much later, as from an inlet"),
    integer("times", 1, kMostRefills, 1,
            "how often it is added, with `every_s` or `below_g`. There are then as many refills, named NAME-1 and so "
            "on"),
};

constexpr KeyTable kTables[] = {
    {"particles", kParticles, ""},
    {"particles.size powder[].size", kUniform, "Radii spread evenly, `distribution = \"uniform\"`:"},
    {"particles.size powder[].size", kFixed, "One radius, `\"fixed\"`:"},
    {"particles.size powder[].size", kNormal, "Normal radii, `\"normal\"`. A draw outside the bounds is drawn again:"},
    {"particles.size powder[].size", kLognormal,
     "Lognormal radii, `\"lognormal\"`. A draw outside the bounds is drawn again:"},
    {"particles.size powder[].size", kQuantiles, "Measured quantiles of the volume, `\"quantiles\"`:"},
    {"particles.size powder[].size", kSieve,
     "A sieve analysis, `\"sieve\"`. Between two sieves the mass is spread evenly over the logarithm of the size:"},
    {"particles.region powder[].region", kRegion,
     "The box to fill, where `boundaries` is `\"list\"` or `\"none\"`. In a canister the grid of each further powder "
     "stands on the one before."},
    {"powder[]", kPowder, "A further powder, a table for each; the first one is that of `[particles]`."},
    {"material[]", kMaterial,
     "What further powders, bodies and walls are made of. Under `luding` only bodies and walls need it; else every one "
     "does, for its moduli. Those of the first powder, of the walls and of the coil stand in `[contact]`, "
     "`[contact.wall]` and `[contact.coil]`."},
    {"refill[]", kRefill,
     "Powder that is added while the run goes on, a table for each. Its spheres have the sizes of its powder. "
     "They begin at rest on a grid like that of the fill, over the powder that is there. Without `time_s`, "
     "`before_dose` and `below_g` it waits until a program says `add_powder`."},
};

}  // namespace

std::span<const KeyTable> powderKeys() {
    return kTables;
}

}  // namespace vkdose
