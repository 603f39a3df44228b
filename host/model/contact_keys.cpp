// The keys of the contacts.
#include <fmt/format.h>

#include <set>
#include <vector>

#include "host/law/law_keys.h"
#include "host/model/case_keys.h"
#include "host/model/world.h"

namespace vkdose {
namespace {

using namespace key;

/// The words of the laws, separated by blanks, and what each is.
const std::string& wordsOfLaws() {
    static const std::string kWords = [] {
        std::string words;
        for (const Law* law : laws()) words += fmt::format("{}{}", words.empty() ? "" : " ", law->word());
        return words;
    }();
    return kWords;
}

const std::string& meaningOfLaws() {
    static const std::string kMeaning = [] {
        std::string meaning = "the law of the normal force. ";
        for (const Law* law : laws()) meaning += fmt::format("`\"{}\"`: {}. ", law->word(), law->meaning());
        return meaning +
               "`\"NAME.glsl\"`: [a law of your own](laws/README.md), the path of its file relative to this one";
    }();
    return kMeaning;
}

constexpr Key kContactAlone[] = {
    text("law_text", told("none"), "the text of a law of your own; the resolved case has it, so that it needs no file"),
    text("law_hash", told("none"), "its hash; a text that was changed is refused"),
    word("rolling_lever", "full half", "full",
         "the lever of rolling and torsion: the couple is at most μ_r f_n times the lever. A published μ_r of LIGGGHTS "
         "belongs to `\"half\"`, one of MercuryDPM to `\"full\"` ([why]"
         "(../host/backend/reference/physics.md#rolling))"),
    number(
        "max_overlap_ratio", kPlain, kPositive, kMaxOverlapRatio,
        "overlap over smaller radius at which the run stops; at most 2. Particles pinched between coil and wall need "
        "more than the default (the paper's cases say 1)"),
    number("soften", kPlain, kPositive, 1.0,
           "s, at least 1: similar softer spheres. k is divided by s, γ by √s, φ_f multiplied by s, in every class. "
           "Forces of a bed at rest stay, overlaps grow as s, and the time step of `\"auto\"` as √s. The resolved case "
           "states the softer values and `soften = 1`"),
    word("scaling", "none stress", "none",
         "whose the parameters are where `scale_up` makes spheres of s times the size of grains. `\"none\"`: the "
         "spheres'. `\"stress\"`: the grains'. The contacts of the spheres then [bear the same stress at the same "
         "strain](#larger-spheres): k and `surface_energy` are multiplied by s, γ and `pull_off_force` by s². Moduli, "
         "ratios and coefficients of friction stay"),
};
constexpr Key kContactClass[] = {
    text("derived", told("none"),
         "how `vkdose` came to values of this table; the resolved case has it, and nothing else reads it"),
    number("friction", kPlain, kNonNegative, kRequired, "μ, a coefficient, not an angle"),
    word("coulomb_limit", "luding absolute", "luding",
         "the force that friction is a fraction of, in sliding, rolling and torsion"),
    number("rolling_friction", kPlain, kNonNegative, 0.0, "μ_r; 0 switches rolling resistance off"),
    number(
        "kr_over_k", kPlain, kPositive, kTwoSevenths,
        "k_r/k, stiffness of rolling; unless the law is `luding` the ratio to the stiffness 2 E* a of a contact of the "
        "radius a, and so for torsion and for both dampings"),
    number("damping_r_ratio", kPlain, kNonNegative, kTwoSevenths, "γ_r/γ, damping of rolling"),
    number("torsion_friction", kPlain, kNonNegative, 0.0, "μ_to; 0 switches torsion resistance off"),
    number("kto_over_k", kPlain, kPositive, kTwoSevenths, "k_to/k, stiffness of torsion"),
    number("damping_to_ratio", kPlain, kNonNegative, kTwoSevenths, "γ_to/γ, damping of torsion"),
};

constexpr Key kPairAlone[] = {
    number("settling_kc_over_k", kPlain, kNonNegative,
           told("that of `[settle]` for two powders, the walls or the coil, if it gives one; else `kc_over_k`"),
           "k_c/k while the powder settles"),
};

constexpr Key kLawProperties[] = {
    other("\"NAME\"", told("required of the first powder"), "a number, in the unit that the law says"),
};

constexpr Key kLawParameters[] = {
    other("\"NAME\"", told("required"), "a number, in the unit that the law says"),
};

/// The keys of each law, each once, and those that all laws have.
std::span<const Key> classKeys() {
    static const std::vector<Key> kKeys = [] {
        std::vector<Key> keys;
        std::set<std::string_view> known;
        for (const Law* law : laws())
            for (const LawKey& own : law->keys())
                if (known.insert(own.key.name).second) keys.push_back(own.key);
        keys.insert(keys.end(), std::begin(kContactClass), std::end(kContactClass));
        return keys;
    }();
    return kKeys;
}

std::span<const Key> aloneKeys() {
    static const std::vector<Key> kKeys = [] {
        std::vector<Key> keys{
            word("law", wordsOfLaws(), laws().front()->word(), meaningOfLaws()).orEndingIn(".glsl").replacing("*")};
        keys.insert(keys.end(), std::begin(kContactAlone), std::end(kContactAlone));
        return keys;
    }();
    return kKeys;
}

}  // namespace

std::span<const KeyTable> contactKeys() {
    static const KeyTable kTables[] = {
        {"contact contact.wall contact.coil contact.A-B", classKeys(),
         "`[contact]` holds the parameters between particles. `[contact.wall]` replaces single ones for the walls,\n"
         "`[contact.coil]` for the coil. The coil takes what it does not state from the wall, and the wall from "
         "`[contact]`. What is given in place of `k`, `kc_over_k` or `damping` holds for two spheres of the mean "
         "radius; at\na wall and at the coil for one such sphere. It is inherited as it is given: with one "
         "`restitution` each class gets\nthe damping that its own mass needs. `[contact.A-B]` is for a "
         "[pair of materials](#several-powders-and-materials), under their names in any order."},
        {"contact.A-B", kPairAlone,
         "A pair of materials, `[contact.cocoa-steel]`, takes this too under the law `luding`:"},
        {"contact", aloneKeys(), "These hold for all contacts."},
        {"contact.parameters contact.wall.parameters contact.coil.parameters contact.A-B.parameters", kLawParameters,
         "The parameters of [a law of your own](laws/README.md), under the names that its file declares. `[contact]` "
         "needs all of\nthem; the wall replaces single ones, and the coil takes from the wall what it does not "
         "state."},
        {"contact.properties contact.wall.properties contact.coil.properties contact.A-B.properties", kLawProperties,
         "The properties that [a law of your own](laws/README.md#numbers-of-each-particle) gives each particle, under "
         "the names that its file declares: in `[contact]` those of the first powder. Walls have 0 unless they state "
         "them, the coil and further materials have those of the wall, further powders those of the first one. "
         "A pair of a powder with itself gives that powder's."},
    };
    return kTables;
}

}  // namespace vkdose
