#pragma once
// Hertz and Mindlin: elastic spheres whose materials have moduli. physics.md, "Hertz and Mindlin". Laws that add to it
// are made of it.

#include "host/law/law.h"

namespace vkdose {

/// An elastic material.
struct Elasticity {
    double modulus = 0;  ///< Young's modulus E [Pa]
    double poisson = 0;  ///< Poisson's ratio [-]
};

/// 2 sqrt(5/6): with the damping kHertzDamping * beta * sqrt(m* df/d delta) the restitution of an impact does not
/// depend on its speed (Tsuji 1992). It is that of a linear contact with the share beta of critical damping, exactly
/// (Antypov and Elliott 2011, EPL 94:50004).
inline constexpr double kHertzDamping = 1.8257418583505538;

/// Between bodies of two materials: E*, and what follows from the restitution 0 < e <= 1 and from Poisson's ratios. The
/// rest is that of `rest`: friction, the ratios of rolling and torsion, and what a law has beside the moduli.
ContactParameters ofModuli(NormalLaw law, const Elasticity& a, const Elasticity& b, double restitution,
                           const ContactParameters& rest = {});
inline ContactParameters hertzMindlin(const Elasticity& a, const Elasticity& b, double restitution,
                                      const ContactParameters& rest = {}) {
    return ofModuli(NormalLaw::HertzMindlin, a, b, restitution, rest);
}

/// Stiffness of the normal direction df/d delta of Hertz's law, 2 E* sqrt(R* delta) [N/m]; `reduced` is a* = 2 R* [m].
double hertzStiffness(const ContactParameters& p, double reduced, double overlap);

class Hertz : public Law {
  public:
    NormalLaw kind() const override { return NormalLaw::HertzMindlin; }
    std::string_view word() const override { return "hertz-mindlin"; }
    std::string_view meaning() const override;
    std::vector<LawKey> keys() const override;
    bool fromModuli() const override { return true; }

    ContactParameters linearised(const ContactParameters& p, double mass, double reduced,
                                 double overlap) const override;
    double overlapUnder(const ContactParameters& p, double reduced, double load) const override;
    double overlapOfImpact(const ContactParameters& p, double mass, double reduced, double speed) const override;
    /// That of any impact. Of a law with plasticity or adhesion: the one that damping is made for, of an impact that
    /// leaves Hertz's line neither flattened nor sticking.
    double restitution(const ContactParameters& p, double mass) const override;
    LawLanes lanes(const ContactParameters& p) const override;

    /// The memory tells only that the contact touches.
    NormalAnswer answer(const ContactParameters& p, double overlap, double reduced, double mass,
                        double& memory) const override;
    double stored(const ContactParameters& p, double overlap, double reduced, double force,
                  double memory) const override;
    double lost(const NormalStep& step) const override;

  protected:
    /// The stiffness that the other directions and all damping are ratios to: 2 E* a of the contact radius a [N/m].
    virtual double stiffness(const ContactParameters& p, double reduced, double overlap) const;
    /// The answer of a law that has this force and pull, and the rest from the stiffness at the overlap.
    NormalAnswer answerOf(const ContactParameters& p, double overlap, double reduced, double mass, double force,
                          double pull) const;
};

}  // namespace vkdose
