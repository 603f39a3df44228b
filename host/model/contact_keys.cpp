// The keys of the contacts.
#include "host/model/case_keys.h"
#include "host/model/world.h"

namespace vkdose {
namespace {

using namespace key;

/// Ratio of the sliding (or rolling) stiffness to the normal one with which sliding (or rolling) oscillates as fast as
/// the normal direction (paper).
constexpr double kTwoSevenths = 0.286;

constexpr Key kContactAlone[] = {
    word(
        "law", "luding hertz-mindlin eepa jkr", "luding",
        "the law of the normal force. `\"luding\"`: linear, plastic and adhesive, with stiffnesses. "
        "`\"hertz-mindlin\"`: elastic spheres without adhesion, with the moduli of the materials; its contacts get "
        "stiffer with the overlap, and the time step is right up to `max_overlap_ratio`. `\"eepa\"`: the same spheres, "
        "which stay flattened and adhere where they were. `\"jkr\"`: the same spheres, elastic and adhesive, which "
        "hold on to each other a little beyond touch. `\"NAME.glsl\"`: [a law of your own](laws/README.md), the path "
        "of its file relative to this one")
        .orEndingIn(".glsl")
        .replacing("*"),
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
    number("youngs_modulus", {1, "Pa"}, kPositive, told("required unless `luding`"),
           "E; in `[contact]` of the particles, in the other two of the wall's and the coil's material"),
    number("poisson_ratio", kPlain, kNonNegative, told("required unless `luding`"), "ν of that material; at most 0.5"),
    number("plasticity_ratio", kPlain, kNonNegative, told("required with `eepa`"),
           "λ_p = 1 - k₁/k₂, below 1: how much stiffer unloading is than loading. 0 is elastic"),
    number("surface_energy", {1, "J/m2"}, kNonNegative, told("required with `eepa` and `jkr`"),
           "Δγ, of both surfaces together; under `eepa` it acts on the flattened patch of a contact, under `jkr` on "
           "all of the contact"),
    number("pull_off_force", {1, "N"}, kNonNegative, 0.0,
           "-f₀, a pull that every contact of the law `eepa` has, pressed or not"),
    number("adhesion_exponent", kPlain, kPositive, 1.5,
           "χ of the law `eepa`, 1 to 10: with it the pull fades while a contact opens"),
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
    number("k1_over_k", kPlain, kPositive, told("required with `luding`"),
           "k₁/k, stiffness of plastic loading; at most 1")
        .replacing("derived"),
    number("kc_over_k", kPlain, kNonNegative, told("this or `bond_number`"),
           "k_c/k, adhesion, during the doses; without effect where k₁ = k")
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
           "γ so that a head-on impact rebounds with this share of its speed; above 0 and at most 1. "
           "`\"hertz-mindlin\"` requires it, and every impact rebounds so; so do `\"eepa\"` and `\"jkr\"`, where "
           "plasticity and adhesion take more")
        .replacing("damping derived"),
    number("restitution_speed", {1, "m/s"}, kNonNegative, 0.0,
           "speed of the impact with that `restitution`. 0: the limit of slow impacts, in which damping alone takes "
           "energy. Above: plasticity and adhesion count too"),
    text("derived", told("none"),
         "how `vkdose` came to values of this table; the resolved case has it, and nothing else reads it"),
    number("friction", kPlain, kNonNegative, kRequired, "μ, a coefficient, not an angle"),
    word("coulomb_limit", "luding absolute", "luding",
         "the force that friction is a fraction of, in sliding, rolling and torsion"),
    number("kt_over_k", kPlain, kPositive, kTwoSevenths, "k_t/k, stiffness of sliding"),
    number("damping_t_ratio", kPlain, kNonNegative, kTwoSevenths, "γ_t/γ, damping of sliding"),
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

constexpr Key kLawParameters[] = {
    other("\"NAME\"", told("required"), "a number, in the unit that the law says"),
};

constexpr KeyTable kTables[] = {
    {"contact contact.wall contact.coil contact.A-B", kContactClass,
     "`[contact]` holds the parameters between particles. `[contact.wall]` replaces single ones for the walls,\n"
     "`[contact.coil]` for the coil. The coil takes what it does not state from the wall, and the wall from "
     "`[contact]`. What is given in place of `k`, `kc_over_k` or `damping` holds for two spheres of the mean radius; "
     "at\n"
     "a wall and at the coil for one such sphere. It is inherited as it is given: with one `restitution` each class "
     "gets\n"
     "the damping that its own mass needs. `[contact.A-B]` is for a "
     "[pair of materials](#several-powders-and-materials), under their names in any order."},
    {"contact.A-B", kPairAlone, "A pair of materials, `[contact.cocoa-steel]`, takes this too under the law `luding`:"},
    {"contact", kContactAlone, "These hold for all contacts."},
    {"contact.parameters contact.wall.parameters contact.coil.parameters contact.A-B.parameters", kLawParameters,
     "The parameters of [a law of your own](laws/README.md), under the names that its file declares. `[contact]` needs "
     "all of\nthem; the wall replaces single ones, and the coil takes from the wall what it does not state."},
};

}  // namespace

std::span<const KeyTable> contactKeys() {
    return kTables;
}

}  // namespace vkdose
