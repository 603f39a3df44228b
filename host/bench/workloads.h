#pragma once
// The workloads of the benchmark: fixed worlds with fixed particles, the same on every machine.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/model/case.h"

namespace vkdose::bench {

struct Workload {
    RuledWorld world;
    Particles particles;
    double coilRate = 0;           ///< [rad/s about +z]
    std::uint32_t warmSteps = 64;  ///< before anything is timed
};

/// A workload by name. It is made only when its turn comes, because the large ones take a gigabyte.
struct Plan {
    std::string name;
    bool quick;  ///< small enough for a test
    std::function<Workload()> make;
    bool huge = false;      ///< takes 8 GB and ten minutes: runs only if it is asked for by its whole name
    std::string without{};  ///< the workload that is the same but for one thing, with which it is compared
};

/// The workloads are `free-fall` (no contacts, one speed), `bed-3k` ... `bed-4M` (boxes full of spheres that press on
/// each other and are at rest, without gravity), `bed-3k-mesh` (the spheres of `bed-3k` around a resting coil of
/// 10,000 triangles), and, for a case with a list of settled particles, `<name>-rest` and `<name>-turning`. These two
/// are its bed with the law of the doses, the coil still or at the case's speed.
std::vector<Plan> plans(const std::optional<Case>& bed);

}  // namespace vkdose::bench
