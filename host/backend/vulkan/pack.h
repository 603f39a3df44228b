#pragma once
// From the host's double-precision world to the device's layouts (shaders/shared/layout.h), and back.

#include <array>
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

/// What the device keeps of each direction that repeats, by x, y and z; 0 where none does. The inverse of keptPeriods
/// in shaders/law/period.glsl.
std::array<double, 3> fromKept(const glm::dvec2& kept, const Vec3& period);

/// Writes a member's part of one half of the state buffer (gpu::stateOffset): `share` slots from `first` on. Slots that
/// no particle needs are padding.
void packState(const Particles& particles, std::size_t share, std::size_t first, std::vector<gpu::vec4>& half);
/// The low parts of the speeds beside it: of each particle two vectors (speedLowIndex in shaders/shared/tables.h). No
/// particle has gone through a period.
std::vector<gpu::vec4> packSpeedLows(const Particles& particles);

/// The properties that a user's law gives each particle: two vectors of each (propertyIndex), high and low parts.
std::vector<gpu::vec4> packProperties(const Particles& particles);
void unpackProperties(const std::vector<gpu::vec4>& packed, Particles& particles);
/// Reads the particles from a half that holds only this member, and the low parts of their speeds. `period`:
/// World::period.
Particles unpackState(const std::vector<gpu::vec4>& half, const std::vector<gpu::vec4>& speedLows, std::size_t slots,
                      const Particles& loaded, const Vec3& period = Vec3(0));

}  // namespace vkdose
