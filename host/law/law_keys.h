#pragma once
// What a law reads of a case, and the keys that more than one law has.

#include "host/core/key.h"
#include "host/law/law.h"

namespace vkdose {

/// A key of a pair's table that a law reads.
struct LawKey {
    Key key;
    double ContactParameters::*member = nullptr;  ///< null where the value is no parameter as it stands
};

inline constexpr Key kRestitutionKey =
    key::number("restitution", kPlain, kNonNegative, told("in place of `damping`"),
                "γ so that a head-on impact rebounds with this share of its speed; above 0 and at most 1. "
                "`\"hertz-mindlin\"` requires it, and every impact rebounds so; so do `\"eepa\"` and `\"jkr\"`, where "
                "plasticity and adhesion take more")
        .replacing("damping derived");
inline constexpr Key kSurfaceEnergyKey =
    key::number("surface_energy", {1, "J/m2"}, kNonNegative, told("required with `eepa` and `jkr`"),
                "Δγ, of both surfaces together; under `eepa` it acts on the flattened patch of a contact, under `jkr` "
                "on all of the contact");

/// Ratio of the sliding (or rolling) stiffness to the normal one with which sliding (or rolling) oscillates as fast as
/// the normal direction (paper).
inline constexpr double kTwoSevenths = 0.286;
inline constexpr Key kSlidingStiffnessKey =
    key::number("kt_over_k", kPlain, kPositive, kTwoSevenths, "k_t/k, stiffness of sliding");
inline constexpr Key kSlidingDampingKey =
    key::number("damping_t_ratio", kPlain, kNonNegative, kTwoSevenths, "γ_t/γ, damping of sliding");

}  // namespace vkdose
