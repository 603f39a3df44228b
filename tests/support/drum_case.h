#pragma once

#include <string>

namespace vkdose::test {

/// A few spheres in a closed drum that turns, and a post in it that follows the drive. It has doses, and no canister.
inline const std::string kDrum = R"(boundaries = "none"
[particles]
density = 1427.0
mass_g = 0.5
[particles.size]
distribution = "fixed"
radius_mm = 1.25
[particles.region]
low = [-0.008, -0.01, 0.001]
high = [0.008, 0.008, 0.009]
[contact]
k = 8000.0
k1_over_k = 0.2
kc_over_k = 0.0
plasticity_depth = 0.05
damping = 0.03
friction = 0.5
[[body]]
name = "drum"
shape = "cylinder"
radius_mm = 15
length_mm = 10
ends = true
[body.motion]
kind = "turn"
speed_rpm = 60
[[body]]
name = "post"
shape = "cylinder"
radius_mm = 1.2
length_mm = 10
at = [0.0105, -0.002, 0]
[body.motion]
kind = "turn"
follows = "drive"
turns_per_turn = 2
[settle]
time_s = 0.06
[dose]
rotate_s = 0.05
speed_rpm = 30
[stop]
rule = "none"
max_doses = 1
)";

}  // namespace vkdose::test
