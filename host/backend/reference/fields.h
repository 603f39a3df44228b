#pragma once
// Coarse-grained fields (host/model/field.h) of particles and of the forces along their branches, in double precision.

#include <cstdint>
#include <vector>

#include "host/model/field.h"
#include "host/model/world.h"

namespace vkdose::reference {

/// The part of a contact that the stress needs.
struct Branch {
    std::uint32_t particle = 0;  ///< on which the force acts
    std::uint32_t other = 0;     ///< the larger index of a pair; meaningless with a wall
    bool pair = false;
    Vec3 centre{0};  ///< of the particle, when the force acted [m]
    Vec3 along{0};   ///< from the centre of the other particle, or from the wall, to this centre [m]
    Vec3 force{0};   ///< on the particle [N]
};

/// Computes the fields. The world has the densities of the powders.
FieldPoints coarseGrain(const FieldRequest& request, const World& world, const Particles& particles,
                        const std::vector<Branch>& branches);

}  // namespace vkdose::reference
