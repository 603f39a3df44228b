#pragma once
// Plain code on the same packing: the yardstick for speed on a processor. It is no part of the simulator.

#include <cstdint>
#include <memory>

#include "host/model/particles.h"
#include "host/model/world.h"

namespace vkdose::bench {

/// A scalar single-precision loop with the contact law of the backends between the spheres: adhesive normal force with
/// its history, damping, sliding and rolling springs. It computes every pair once, with leapfrog, in threads that share
/// the pairs and meet twice a step. It has less to do than a backend: no torsion (off in the paper), no walls, no coil,
/// no gravity, and the list is built once. Nothing would hold the packing together, so the spheres are `inertia` times
/// as heavy. The arithmetic is the same, and they hardly move. With `inertia` 1 it computes the same motion as a
/// backend, from a start without contacts.
class PlainLoop {
  public:
    PlainLoop(const RuledWorld& world, const Particles& particles, int threads, double inertia = 1e6);
    ~PlainLoop();
    PlainLoop(const PlainLoop&) = delete;
    PlainLoop& operator=(const PlainLoop&) = delete;

    void advance(std::uint32_t steps);

    Particles particles() const;
    double listed() const;    ///< neighbours in the list, mean over particles
    double touching() const;  ///< of them overlapping now

  private:
    struct Loop;
    std::unique_ptr<Loop> loop_;
};

}  // namespace vkdose::bench
