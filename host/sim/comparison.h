#pragma once
// Two backends on the same case and the same particles, in lockstep: how far they differ, and whether that is more
// than rounding and the chaos of a packing explain.
//
// A packing of spheres amplifies every difference. The amplification is measured by further runs of the reference whose
// particles start displaced:
// - The fine twin is displaced by up to kFineShift of the mean radius. It shows how fast small errors grow. The
//   candidate makes a rounding error in every step, and none of these errors grows faster. While they are small,
//   particles are compared one by one.
// - The rough twins are displaced by up to kRoughShift, a micrometre for a millimetre. No experiment could tell these
//   fillings apart, so a difference between them says nothing about the powder. Energies, masses and torques may differ
//   as much.

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "host/backend/backend.h"
#include "host/model/case.h"
#include "host/sim/timeline.h"

namespace vkdose {

/// Displacement of the twins' particles, in mean radii.
inline constexpr double kFineShift = 1e-7;
inline constexpr double kRoughShift = 1e-3;

/// Undecided: the twins differ so much that agreement of the candidate with the reference proves nothing.
enum class Verdict { Agrees, Differs, Undecided };

/// Particle by particle, at one time. Positions in mean radii, velocities in the velocity scale (the largest
/// root-mean-square speed of the reference so far).
struct ParticleRow {
    std::uint64_t step = 0;
    double time = 0;
    Phase phase = Phase::Settle;
    std::size_t contacts = 0;  ///< of the reference
    double position = 0;       ///< largest difference of the candidate
    double velocity = 0;
    double positionLimit = 0;  ///< what rounding times measured amplification explains
    double velocityLimit = 0;
    Verdict verdict = Verdict::Agrees;  ///< Undecided once the limit is so wide that it would say nothing
};

/// A figure of the whole packing, over all times of a phase.
struct QuantityRow {
    std::string name;       ///< "kinetic energy, settling"
    std::string unit;       ///< what the differences are given in: "of its largest", "mean radii"
    double difference = 0;  ///< largest over time, candidate to reference
    double spread = 0;      ///< largest over time, rough twins to reference
    double tolerance = 0;
    double time = 0;  ///< of the largest difference [s]
    Verdict verdict = Verdict::Agrees;
};

struct Comparison {
    std::vector<ParticleRow> particles;
    std::vector<QuantityRow> quantities;
    std::uint64_t steps = 0;
    bool interrupted = false;

    /// The verdict is Differs if any row differs. It is Agrees only on evidence of both kinds: a state that was judged
    /// particle by particle, and a quantity of the packing that chaos did not leave Undecided. Otherwise it is
    /// Undecided.
    Verdict verdict() const;
    int undecided() const;  ///< quantities
};

/// References to make the twins of.
struct Twins {
    Backend* fine = nullptr;
    std::vector<Backend*> rough;
};

/// Advances all backends through the schedule of `c` for `steps` steps (or until its end time) and compares them at a
/// series of times. The ledger of every backend must close: RunError otherwise, naming the backend. `progress` is told
/// the step reached.
Comparison compareBackends(const Case& c, const Insertion& filled, Backend& reference, const Twins& twins,
                           Backend& candidate, std::uint64_t steps, const std::function<void(std::uint64_t)>& progress,
                           const std::atomic<bool>& stop);

}  // namespace vkdose
