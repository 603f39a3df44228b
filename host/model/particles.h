#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "host/core/vec.h"
#include "host/model/material.h"

namespace vkdose {

/// Where a particle is in the ledger. A dosed or lost particle takes no further part in the motion; one that waits
/// takes none before it is added to the powder (Refill).
enum class Status : std::uint32_t { Active = 0, Dosed = 1, Lost = 2, Waiting = 3 };

/// Particle state. Every array has one entry for each particle. The index identifies the particle for the whole run.
/// After n steps `velocity` and `spin` are those of the half step n - 1/2 (leapfrog); at n = 0 they are the initial
/// ones.
struct Particles {
    std::vector<Vec3> position;  ///< [m]
    std::vector<Vec3> velocity;  ///< [m/s]
    std::vector<Vec3> spin;      ///< angular velocity [rad/s]
    std::vector<double> radius;  ///< [m]
    std::vector<Status> status;
    std::vector<std::uint8_t> material;  ///< a powder of the world (World::materials)
    /// How many periods it has gone through since it was loaded, upwards less downwards; empty: no direction repeats.
    std::vector<glm::ivec3> gone;
    /// What a user's law gives each particle (UserLaw::properties); empty without such a law.
    std::vector<LawProperties> properties;

    std::size_t size() const { return position.size(); }
    void add(const Vec3& x, double r, const Vec3& v = Vec3(0), const Vec3& w = Vec3(0), int of = kFirstPowder) {
        position.push_back(x);
        velocity.push_back(v);
        spin.push_back(w);
        radius.push_back(r);
        status.push_back(Status::Active);
        material.push_back(static_cast<std::uint8_t>(of));
    }
    /// The particles of `more` behind these, with their status and material.
    void append(const Particles& more);
};

/// 0 if there are none [m].
inline double largestRadius(const Particles& p) {
    return p.radius.empty() ? 0.0 : *std::max_element(p.radius.begin(), p.radius.end());
}

/// Of a solid sphere [kg].
inline double sphereMass(double density, double radius) {
    return density * 4.0 / 3.0 * kPi * radius * radius * radius;
}

}  // namespace vkdose
