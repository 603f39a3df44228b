#pragma once
// Both backends on the same scene, compared particle by particle and contact by contact.

#include <algorithm>
#include <map>
#include <tuple>

#include "tests/support/gpu.h"
#include "tests/support/near.h"

namespace vkdose::test {

/// Largest differences between two backends, in the units a tolerance can be argued in.
struct Differences {
    double position = 0;        ///< of a particle's radius
    double velocity = 0;        ///< of the scene's speed scale
    double spin = 0;            ///< surface speed, of the speed scale
    double maxOverlap = 0;      ///< of the smaller particle's radius
    double spring = 0;          ///< ditto
    double force = 0;           ///< of what 1e-3 of the smaller radius exerts on k
    std::size_t unmatched = 0;  ///< contacts only one of them has
};

/// In which order a backend tells the contacts with one body is its own affair: those with the coil are numbered by
/// where they push to.
inline std::vector<Contact> comparable(std::vector<Contact> contacts) {
    const auto rank = [](const Contact& c) { return std::tuple(c.kind, c.particle, c.force.z); };
    std::sort(contacts.begin(), contacts.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        if (contacts[i].kind != ContactClass::ParticleCoil) continue;
        const bool another = i > 0 && contacts[i - 1].kind == ContactClass::ParticleCoil &&
                             contacts[i - 1].particle == contacts[i].particle;
        contacts[i].other = another ? contacts[i - 1].other + 1 : 0;
    }
    return contacts;
}

/// The largest difference between the contact stresses of two fields, in units of the largest in `b`.
inline double stressDifference(const FieldPoints& a, const FieldPoints& b) {
    REQUIRE(a.size() == b.size());
    double worst = 0, most = 0;
    for (std::size_t k = 0; k < b.size(); ++k)
        for (std::size_t row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column) {
                const double stress = b[k].contactStress[row][column];
                most = std::max(most, std::abs(stress));
                worst = std::max(worst, std::abs(a[k].contactStress[row][column] - stress));
            }
    REQUIRE(most > 0);
    return worst / most;
}

inline Differences differences(const Backend& a, const Backend& b, double speed) {
    constexpr double kStiffness = 24067;  // k of paperLaw [N/m]
    const Particles p = a.particles(), q = b.particles();
    REQUIRE(p.size() == q.size());
    Differences d;
    const auto raise = [](double& worst, double value) {
        worst = std::isfinite(value) ? std::max(worst, value) : INFINITY;
    };
    for (std::size_t i = 0; i < p.size(); ++i) {
        REQUIRE(p.status[i] == q.status[i]);
        raise(d.position, glm::length(p.position[i] - q.position[i]) / p.radius[i]);
        raise(d.velocity, glm::length(p.velocity[i] - q.velocity[i]) / speed);
        raise(d.spin, glm::length(p.spin[i] - q.spin[i]) * p.radius[i] / speed);
    }
    using Key = std::tuple<ContactClass, std::uint32_t, std::uint32_t>;
    std::map<Key, Contact> known;
    for (const Contact& c : comparable(b.contacts())) known[{c.kind, c.particle, c.other}] = c;
    for (const Contact& c : comparable(a.contacts())) {
        const auto twin = known.find({c.kind, c.particle, c.other});
        if (twin == known.end()) {
            ++d.unmatched;
            continue;
        }
        const double r = c.kind == ContactClass::ParticleParticle ? std::min(p.radius[c.particle], p.radius[c.other])
                                                                  : p.radius[c.particle];
        const Contact& t = twin->second;
        raise(d.maxOverlap, std::abs(c.maxOverlap - t.maxOverlap) / r);
        raise(d.spring, glm::length(c.sliding - t.sliding) / r);
        raise(d.spring, glm::length(c.rolling - t.rolling) / r);
        raise(d.spring, std::abs(c.torsion - t.torsion) / r);
        raise(d.force, glm::length(c.force - t.force) / (kStiffness * 1e-3 * r));
        known.erase(twin);
    }
    d.unmatched += known.size();
    return d;
}

/// Radii and time steps as both precisions see them: what is compared is the arithmetic, not the input's last bits.
inline double single(double x) {
    return double(float(x));
}

}  // namespace vkdose::test
