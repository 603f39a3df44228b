#pragma once
// Materials, and contact parameters of each pair of them in SI. Symbols as in physics.md (Luding (2008), Granular
// Matter 10:235, and the paper's table).

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "host/model/user_law.h"

namespace vkdose {

/// What particles, walls and bodies are made of. A material is named by its index (World::materials). The first three
/// are those of a case with one powder; other powders and materials of bodies come after them.
struct Material {
    std::string name;     ///< for messages
    bool powder = false;  ///< particles may be of it
    double density = 0;   ///< of a powder's particles [kg/m3]; of others without meaning
};
inline constexpr int kFirstPowder = 0, kWallMaterial = 1, kCoilMaterial = 2;
inline constexpr int kUsualMaterials = 3;
inline constexpr int kMostMaterials = 8;

/// Coarse kinds of contacts: with another particle, with the coil, or with anything else.
enum class ContactClass { ParticleParticle = 0, ParticleWall = 1, ParticleCoil = 2 };
inline constexpr int kContactClasses = 3;

/// The kind of a particle's contact with a surface or a body of this material.
constexpr ContactClass classAtWall(int material) {
    return material == kCoilMaterial ? ContactClass::ParticleCoil : ContactClass::ParticleWall;
}

/// The materials of the two sides of a contact. Their order does not matter to the law.
struct MaterialPair {
    int a = kFirstPowder, b = kFirstPowder;
};

/// The pair of a contact of the first powder.
constexpr MaterialPair pairOf(ContactClass c) {
    return {kFirstPowder, static_cast<int>(c)};  // the materials are numbered as the classes are
}
static_assert(pairOf(ContactClass::ParticleWall).b == kWallMaterial &&
              pairOf(ContactClass::ParticleCoil).b == kCoilMaterial);

/// Normal force that limits friction: Luding -> max(0, f + k_c delta); Absolute -> |f_n|, damping included.
enum class CoulombLimit { Luding = 0, Absolute = 1 };

/// Rolling lever a_r: Full -> 2 a_i a_j/(a_i + a_j) (wall: 2 a_i); Half -> half of it (Luding's own).
enum class RollingLever { Full = 0, Half = 1 };

/// The law of the normal force. It also says how stiff sliding, rolling and torsion are, and how strongly all are
/// damped.
enum class NormalLaw {
    Luding = 0,        ///< linear, hysteretic, adhesive
    HertzMindlin = 1,  ///< elastic spheres: all stiffnesses and dampings grow with the overlap
    Eepa = 2,  ///< Edinburgh's elasto-plastic adhesive spheres: Hertz's line, from which contacts stay flattened
    Jkr = 3,   ///< elastic adhesive spheres (Johnson, Kendall, Roberts): contacts hold on beyond touch
    User = 4,  ///< ContactLaw::user
};

/// Under Hertz-Mindlin, EEPA and JKR kt, kr and kTo are ratios to the stiffness 2 E* a of a contact of the radius a,
/// which is that of Hertz's line, gammaT, gammaR and gammaTo ratios to its damping [-]; k1, k2Max, kc, plasticityDepth
/// and gamma are not used. Under a user's law they are ratios to what its functions stiffness and damping answer. k1 is
/// then the largest stiffness of mean spheres, k2Max that of the smallest, gamma their largest damping and reach the
/// farthest, as a device told them (user_law_trial.h).
struct ContactParameters {
    double k1 = 0;               ///< plastic loading stiffness [N/m]
    double k2Max = 0;            ///< limit elastic stiffness, k2-hat [N/m]
    double kc = 0;               ///< adhesion stiffness [N/m]
    double plasticityDepth = 0;  ///< phi_f [-]
    double gamma = 0;            ///< normal viscosity [kg/s]
    double kt = 0;               ///< sliding stiffness [N/m]
    double gammaT = 0;           ///< sliding viscosity [kg/s]
    double mu = 0;               ///< sliding friction [-]
    double kr = 0;               ///< rolling stiffness [N/m]
    double gammaR = 0;           ///< rolling viscosity [kg/s]
    double muR = 0;              ///< rolling friction [-]
    double kTo = 0;              ///< torsion stiffness [N/m]
    double gammaTo = 0;          ///< torsion viscosity [kg/s]
    double muTo = 0;             ///< torsion friction [-]; 0 switches torsion off
    CoulombLimit coulombLimit = CoulombLimit::Luding;
    NormalLaw law = NormalLaw::Luding;
    double modulus = 0;          ///< Hertz-Mindlin, EEPA, JKR: E*, effective Young's modulus of the two bodies [Pa]
    double dampingShare = 0;     ///< Hertz-Mindlin, EEPA, JKR: beta, which gives the restitution (normal_law.h) [-]
    double surfaceEnergy = 0;    ///< EEPA, JKR: delta gamma, of the two surfaces [J/m2]
    double plasticityRatio = 0;  ///< EEPA: lambda_p = 1 - k1/k2, below 1 [-]
    double constantPull = 0;     ///< EEPA: -f0, a pull that every contact has [N]
    double reach = 0;            ///< User: how far beyond touch any contact holds on, at most [m]
    double kMost = 0;            ///< User: the largest stiffness that the law's trial found [N/m]
    std::array<double, kMostLawParameters> own{};  ///< User: in the order of UserLaw::parameters
    double adhesionExponent = 1.5;                 ///< EEPA: chi, with which the pull fades as the contact opens [-]
};

/// The parameters of each pair of materials. Pairs that cannot touch, as two walls, are there and mean nothing.
class PairTable {
  public:
    PairTable() { resize(kUsualMaterials); }

    /// Where a pair is in a list of all: those with the larger index below come first.
    static constexpr std::size_t index(MaterialPair p) {
        const auto larger = static_cast<std::size_t>(std::max(p.a, p.b)),
                   smaller = static_cast<std::size_t>(std::min(p.a, p.b));
        return larger * (larger + 1) / 2 + smaller;
    }

    int materials() const { return materials_; }
    /// Room for so many materials; the pairs of those that stay are kept.
    void resize(int materials) {
        materials_ = materials;
        pairs_.resize(index({materials, 0}));
    }

    /// Throws std::out_of_range if there is no such material.
    const ContactParameters& of(MaterialPair p) const { return pairs_.at(index(p)); }
    ContactParameters& of(MaterialPair p) { return pairs_.at(index(p)); }

    /// Of all pairs, in the order of `index`.
    auto begin() const { return pairs_.begin(); }
    auto end() const { return pairs_.end(); }
    auto begin() { return pairs_.begin(); }
    auto end() { return pairs_.end(); }
    void fill(const ContactParameters& p) { std::fill(begin(), end(), p); }

  private:
    int materials_ = 0;
    std::vector<ContactParameters> pairs_;
};

/// Everything the contact law needs, for one member (canister).
struct ContactLaw {
    PairTable pairs;
    RollingLever rollingLever = RollingLever::Full;
    std::shared_ptr<const UserLaw> user;  ///< null unless the pairs follow NormalLaw::User

    const ContactParameters& between(int a, int b) const { return pairs.of({a, b}); }
    ContactParameters& between(int a, int b) { return pairs.of({a, b}); }
    const ContactParameters& of(MaterialPair p) const { return pairs.of(p); }
    ContactParameters& of(MaterialPair p) { return pairs.of(p); }
    /// Of the first powder.
    const ContactParameters& of(ContactClass c) const { return of(pairOf(c)); }
    ContactParameters& of(ContactClass c) { return of(pairOf(c)); }
    /// Gives all pairs this limit of friction.
    void limitFriction(CoulombLimit limit) {
        for (ContactParameters& p : pairs) p.coulombLimit = limit;
    }
};

}  // namespace vkdose
