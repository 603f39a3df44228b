#pragma once
// A line of particles.csv.

#include <array>
#include <cstddef>

#include "host/core/columns.h"
#include "host/model/particles.h"

namespace vkdose {

template <>
struct Words<Status> {
    static constexpr std::array<const char*, 4> kNames{"active", "dosed", "lost", "waiting"};
};

struct ParticleRow {
    std::size_t id = 0;
    Vec3 position{0}, velocity{0}, spin{0};
    double radius = 0;
    Status status = Status::Active;
};

inline constexpr auto kParticleColumns = columns(
    column<&ParticleRow::id>("id", "1", "Number of the particle, from 0; it is the same during the whole run."),
    column<&ParticleRow::position, 0>("x_m", "m", "Position of the centre along x.", kAllDigits),
    column<&ParticleRow::position, 1>("y_m", "m", "Position of the centre along y, upwards.", kAllDigits),
    column<&ParticleRow::position, 2>("z_m", "m", "Position of the centre along z, towards the outlet.", kAllDigits),
    column<&ParticleRow::velocity, 0>("vx_m_s", "m/s", "Velocity along x, half a step before the end.", kAllDigits),
    column<&ParticleRow::velocity, 1>("vy_m_s", "m/s", "Velocity along y, likewise.", kAllDigits),
    column<&ParticleRow::velocity, 2>("vz_m_s", "m/s", "Velocity along z, likewise.", kAllDigits),
    column<&ParticleRow::spin, 0>("wx_rad_s", "rad/s", "Angular velocity about x, half a step before the end.",
                                  kAllDigits),
    column<&ParticleRow::spin, 1>("wy_rad_s", "rad/s", "Angular velocity about y, likewise.", kAllDigits),
    column<&ParticleRow::spin, 2>("wz_rad_s", "rad/s", "Angular velocity about z, likewise.", kAllDigits),
    column<&ParticleRow::radius>("radius_m", "m", "Radius of the sphere.", kAllDigits),
    column<&ParticleRow::status>(
        "status", "",
        "active, dosed, lost or waiting for its refill; a dosed particle stands where it was when "
        "it was counted."));

}  // namespace vkdose
