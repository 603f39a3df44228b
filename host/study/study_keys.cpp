#include "host/study/study_keys.h"

#include "host/study/study.h"

namespace vkdose {
namespace {

using namespace key;

constexpr Key kTop[] = {
    text("name", told("name of the file"), "name of the study, for the report"),
    text("reason", "", "why the study exists; the report shows it"),
    text("base", kRequired, "the case that is varied; the path is relative to the study's folder"),
    other(
        "seeds", told("the base case's seed"),
        "a list of different whole numbers ≥ 0, or how many: `3` stands for `[1, 2, 3]`. Every point is run with every "
        "seed"),
};

constexpr Key kSet[] = {
    other("\"TABLE.KEY\"", told("the base case's value"), "any key of a case file, for every member"),
};

constexpr Key kAxis[] = {
    text("key", told("this or `keys`"), "the key that varies, with its table: `\"contact.friction\"`"),
    other("keys", told("this or `key`"), "keys that vary together"),
    other("values", told("this, a range, a box or a table"), "the values; with `keys` a row of values for each point"),
    number("from", kPlain, Bound::Any, told("this or `values`"), "first value of a range"),
    number("to", kPlain, Bound::Any, told("with `from`"), "last value of the range"),
    integer("steps", 2, std::int64_t(kMostMembers), told("with `from`"), "number of values, both ends included"),
    other("low", told("this or `values`"), "lower bound of a box; with `keys` a list, one for each"),
    other("high", told("with `low`"), "upper bound"),
    integer(
        "points", 1, std::int64_t(kMostMembers), told("with `low`; of a table all rows"),
        "number of points: so many of the Halton sequence in the box, which fill it evenly, or the first rows of the "
        "table"),
    text("table", told("in place of `key` or `keys`"),
         "a CSV with a column for each key, named by it, and a row for each point; the path is relative to the study's "
         "folder"),
};

constexpr Key kCalibrate[] = {
    word("method", "grid surrogate", "grid", "how the parameters are searched for"),
    number("target_g_per_dose", kGram, Bound::Positive, told("required without `measured`"),
           "measured mass per dose, β"),
    number("tolerance_g", kGram, Bound::Positive, told("required without `measured`; with it the slope's error"),
           "standard error of the target"),
    text("measured", told("none"),
         "a balance's CSV with the columns `dose` (1, 2, ...) and `mass_g` or `cumulative_g`, in place of a target: β "
         "is the slope until 80 % of all is out"),
    text("along", "contact.kc_over_k", "grid: the axis to interpolate along"),
    integer("confirming_seeds", 2, 100, 3,
            "new seeds with which the chosen point runs; only these runs say whether a target is met"),
    integer("max_runs", 3, 500, 30,
            "surrogate: points at most, each run with every seed; a confirmation that missed counts as one"),
    integer("first_points", 3, 500, told("two for each parameter, and one"),
            "surrogate: points spread over the bounds with which the search begins. More of them, such as ten for each "
            "parameter, tell the distribution of the parameters that fit more sharply"),
};

constexpr Key kDesign[] = {
    integer("max_runs", 3, 500, 30, "points at most, each run with every seed"),
    integer("confirming_seeds", 2, 100, 3,
            "new seeds with which the points of the front run; the front that is told is that of these runs"),
};

constexpr Key kGoal[] = {
    text("figure", kRequired, "a figure of a run, as that of a target"),
    word("wish", "none largest smallest", "none", "what is wished of it"),
    number("at_least", kPlain, Bound::Any, told("none"), "least value that a design may have, in the figure's unit"),
    number("at_most", kPlain, Bound::Any, told("none"), "largest value that a design may have"),
    text("base", told("the study's `base`"), "the case whose run gives the figure, as that of a target"),
};

constexpr Key kParameter[] = {
    text("key", kRequired, "a key of the base case with a number for a value"),
    number("low", kPlain, Bound::Any, kRequired, "lower bound, in the unit of the key"),
    number("high", kPlain, Bound::Any, kRequired, "upper bound"),
};

constexpr Key kTarget[] = {
    text(
        "figure", kRequired,
        "`\"mass_per_dose_g\"`, a figure of the doses (`\"dose.mean_kg\"`, `\"dose.rsd\"`, `\"dose.left_kg\"`: what is "
        "left in the canister), of the mass rate (`\"rate.steady_kg_s\"`) or of the cycles (`\"cycle.steady_kg\"`), or "
        "the name of a "
        "`[[measure]]` (`\"heap.angle_deg\"`) or a body, wall (`\"coil.largest_torque_Nm\"`) or region "
        "(`\"hopper.largest_content_kg\"`) and its figure, named as in "
        "`summary.json`"),
    number("value", kPlain, Bound::Any, kRequired, "measured, in the unit of the figure"),
    number("uncertainty", kPlain, Bound::Positive, kRequired, "standard error of the value"),
    number("weight", kPlain, Bound::Positive, 1.0, "of the square of its misfit"),
    text("base", told("the study's `base`"),
         "the case whose run gives the figure; every point runs each of these cases"),
};

constexpr KeyTable kTables[] = {
    {"", kTop, ""},
    {"set", kSet, "Values of every member, laid over the base case."},
    {"axis[]", kAxis, "One direction of the grid of members, a table for each. Members are all combinations."},
    {"calibrate", kCalibrate, "For `vkdose calibrate` only."},
    {"calibrate.target[]", kTarget,
     "What is to be met together, for `method = \"surrogate\"`: up to eight figures in place of `target_g_per_dose`, "
     "`tolerance_g` and `measured`."},
    {"design", kDesign, "For `vkdose design` only."},
    {"design.goal[]", kGoal,
     "What a design is judged by: up to eight figures, at least one of which is wished to be the largest or the "
     "smallest."},
    {"calibrate.parameter[] design.parameter[]", kParameter,
     "One to four free parameters, for `method = \"surrogate\"` and for a design."},
};

}  // namespace

std::span<const KeyTable> studyKeys() {
    return kTables;
}

}  // namespace vkdose
