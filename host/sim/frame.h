#pragma once
// The whole state of a run at one instant, to be looked at: what trajectories, pictures and fields are made of.

#include <cstdint>
#include <vector>

#include "host/backend/backend.h"
#include "host/model/particles.h"
#include "host/sim/timeline.h"

namespace vkdose {

struct Frame {
    std::uint64_t step = 0;
    double time = 0;  ///< [s]
    Phase phase = Phase::Settle;
    int dose = 0;          ///< 0 while settling
    double coilAngle = 0;  ///< of Backend::coilAngle: rotation about +z since load [rad]
    Particles particles;
    std::vector<Contact> contacts;  ///< none if they were not stored
    /// Of each of the world's bodies, how far it has come in phases or freely; empty if none moves so.
    std::vector<Moved> bodiesMoved{};

    Moved movedOf(std::size_t body) const { return body < bodiesMoved.size() ? bodiesMoved[body] : Moved{}; }
};

}  // namespace vkdose
