#pragma once
// From the host's double-precision world to the device's layouts (shaders/shared/layout.h), and back.

#include <cstdint>
#include <vector>

#include "host/model/particles.h"
#include "host/model/world.h"
#include "shaders/shared/layout.h"

namespace vkdose {

/// All data of the only member except its bodies. Throws RunError if the world does not fit the tables.
gpu::Member packMember(const World& world, const ContactLaw& law, const Particles& particles);

/// How far beyond touch a contact of a packed member may hold [m].
float reachOf(const gpu::Member& member);

/// Replaces the contact law of a packed member, but not its reach.
void packLaw(const ContactLaw& law, gpu::Member& member);
/// Gravity, with the density of the first powder beside it.
void packGravity(const World& world, gpu::Member& member);

/// Writes a member's part of one half of the state buffer (gpu::stateOffset): `share` slots from `first` on. Slots that
/// no particle needs are padding.
void packState(const Particles& particles, std::size_t share, std::size_t first, std::vector<gpu::vec4>& half);
/// The low parts of the speeds beside it: of each particle two vectors (speedLowIndex in shaders/shared/tables.h).
std::vector<gpu::vec4> packSpeedLows(const Particles& particles);
/// Reads the particles from a half that holds only this member, and the low parts of their speeds.
Particles unpackState(const std::vector<gpu::vec4>& half, const std::vector<gpu::vec4>& speedLows, std::size_t slots,
                      const Particles& loaded);

}  // namespace vkdose
