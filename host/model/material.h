#pragma once
// Materials, and contact parameters of each pair of them in SI. Symbols as in physics.md (Luding (2008), Granular
// Matter 10:235, and the paper's table).

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "host/law/contact_parameters.h"

namespace vkdose {

/// What particles, walls and bodies are made of. A material is named by its index (World::materials). The first three
/// are those of a case with one powder; other powders and materials of bodies come after them.
struct Material {
    std::string name;     ///< for messages
    bool powder = false;  ///< particles may be of it
    double density = 0;   ///< of a powder's particles [kg/m3]; of others without meaning
    /// What a user's law declares by `particle float`: of each particle of a powder at first, of a wall always.
    LawProperties properties{};
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

/// Rolling lever a_r: Full -> 2 a_i a_j/(a_i + a_j) (wall: 2 a_i); Half -> half of it (Luding's own).
enum class RollingLever { Full = 0, Half = 1 };

/// The parameters of each pair of materials. Entries of pairs that cannot touch, as two walls, are unspecified.
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
