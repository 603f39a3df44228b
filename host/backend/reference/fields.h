#pragma once
// Coarse-grained fields (host/model/field.h) of particles and what acts along their branches, in double precision.

#include <cstdint>
#include <vector>

#include "host/model/field.h"
#include "host/model/particles.h"

namespace vkdose::reference {

/// A contact as the stress sees it.
struct Branch {
    std::uint32_t particle = 0;  ///< on which the force acts
    std::uint32_t other = 0;     ///< the larger index of a pair; of no meaning with a wall
    bool pair = false;
    Vec3 centre{0};  ///< of the particle, when the force acted [m]
    Vec3 along{0};   ///< to it from the other's centre, or from the wall [m]
    Vec3 force{0};   ///< on it [N]
};

/// `density` of the particles [kg/m3].
FieldPoints coarseGrain(const FieldRequest& request, double density, const Particles& particles,
                        const std::vector<Branch>& branches);

}  // namespace vkdose::reference
