#include "host/model/case_keys.h"

#include <vector>

namespace vkdose {
namespace {

using namespace key;

constexpr std::int64_t kAnyCount = std::numeric_limits<std::int64_t>::max();

constexpr Key kTop[] = {
    text("base", told("none"), "another case to start from; the path is relative to this file"),
    text("powder_file", told("none"),
         "[a powder in a file of its own](powders/README.md), relative to this one. It takes the place of the base's "
         "powder: sizes, contacts, how they settle, `time.step_s`. What this file states itself comes on top"),
    text("name", told("name of the file"),
         "name of the case and of its default output folder: at most 200 visible characters, no slash, no blank at "
         "either end"),
    text("reason", "", "why the case exists; it is printed"),
    text("accepted_warnings", "",
         "names of warnings of `vkdose check`, separated by blanks, that are expected here and not told by a run"),
    integer("seed", 0, kAnyCount, 1, "sets sizes and positions: the same seed gives the same particles"),
    vector("gravity", {1, "m/s2"}, {0, -9.81, 0}, "acceleration of gravity"),
    number("bulk_density", kKilogramPerCubicMetre, Bound::Positive, 471.0,
           "of the settled powder, for the closed form and for `fill_height_mm`. `\"measure\"`: that of this "
           "run's own bed when it has settled; until then, and if the bed is too small or still falls (at more than a "
           "tenth of the speed after a fall from its top), 0.46 of the particles' density")
        .orElse("measure")
        .replacing("derived"),
    text("derived", told("none"),
         "how `vkdose` came to `bulk_density`; the resolved case has it, and nothing else reads it"),
    word("boundaries", "canister list none", "canister",
         "`\"canister\"`: the walls of `[canister]`; `\"list\"`: each `[[plane]]` and `[[cylinder]]`; `\"none\"`: no "
         "walls")
        .replacing("canister plane cylinder"),
};

constexpr KeyTable kTopTable{"", kTop, ""};

}  // namespace

std::span<const KeyTable> caseKeys() {
    static const std::vector<KeyTable> all = [] {
        std::vector<KeyTable> tables{kTopTable};
        for (const auto part : {powderKeys(), contactKeys(), apparatusKeys(), runKeys(), evaluationKeys()})
            tables.insert(tables.end(), part.begin(), part.end());
        return tables;
    }();
    return all;
}

}  // namespace vkdose
