#pragma once
// What plain code does with the same packing: the yardstick for speed on a processor. No part of the simulator.

#include <cstdint>
#include <memory>

#include "host/model/particles.h"
#include "host/model/world.h"

namespace vkdose::bench {

/// A scalar single-precision loop with a list of neighbours: normal spring (k1) and dashpot, leapfrog, threads that
/// share the particles and meet once a step. It has less to do than a backend: no friction, rolling, history or
/// adhesion, no walls, no coil, no gravity, and the list is built once. Nothing would hold the packing together, so the
/// time step is a millionth of the world's: the arithmetic is the same, and the spheres hardly move.
class PlainLoop {
  public:
    PlainLoop(const World& world, const Particles& particles, int threads);
    ~PlainLoop();
    PlainLoop(const PlainLoop&) = delete;
    PlainLoop& operator=(const PlainLoop&) = delete;

    void advance(std::uint32_t steps);

    double listed() const;    ///< neighbours in the list, mean over particles
    double touching() const;  ///< of them overlapping now

  private:
    struct Loop;
    std::unique_ptr<Loop> loop_;
};

}  // namespace vkdose::bench
