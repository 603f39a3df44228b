#pragma once
// Times workloads. Nothing here knows a concrete backend.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "host/backend/backend.h"
#include "host/bench/workloads.h"

namespace vkdose::bench {

struct Effort {
    int repeats = 5;
    double seconds = 1;                  ///< of one repeat, about
    std::uint32_t mostWarmSteps = ~0u;   ///< cuts the workload's own warm-up short
    std::function<void()> meet = [] {};  ///< called before every repeat
};

/// Of the repeats.
struct Spread {
    double median = 0, low = 0, high = 0;
};
Spread spreadOf(std::vector<double> values);  ///< at least one

struct Speed {
    std::uint32_t steps = 0;    ///< of one repeat
    std::vector<double> rates;  ///< of the repeats, in their order [particle-steps/s]
    Spread particleSteps;       ///< of the rates
    Spread coresBusy;           ///< processor time of this process over wall time; a device of its own counts nothing
};

/// Runs `advance` for some steps to warm up, and to find out how many steps make a repeat. Then runs the repeats.
Speed time(const std::function<void(std::uint32_t steps)>& advance, std::size_t particles, std::uint32_t warmSteps,
           const Effort& effort);

/// Contacts per particle. A contact of a pair counts for both particles.
struct Coordination {
    double touching = 0;  ///< other particles
    double walls = 0;     ///< surfaces and turns of the coil
};
Coordination coordinationOf(const Backend& backend, std::size_t particles);

/// One pass of the device, or the rebuild that some of them make together.
struct PassTime {
    std::string name;
    double seconds = 0;  ///< per step
};

/// A line of the result: a workload on a backend, or in the plain loop.
struct Row {
    std::string workload, on;
    std::string driver, processor;  ///< of the machine; empty: not known, or none
    std::string refused;            ///< why there are no figures; empty: there are
    std::size_t particles = 0;
    int repeats = 0;
    Speed speed;
    double listed = 0;  ///< neighbours in the list per particle
    Coordination coordination;
    // The following figures are those of a backend only.
    double contactsPerSecond = 0;  ///< pairs once, walls and coil
    double rebuildsPer1000 = 0;    ///< while timed
    double refreshesPer1000 = 0;   ///< of the contact lists, while profiled
    double startUp = 0;            ///< device, pipelines, tables, first step [s]
    double tableBytes = 0;         ///< per particle
    double stepBytes = 0;          ///< per particle and step, estimated
    double copyBandwidth = 0;      ///< measured [bytes/s]
    std::vector<PassTime> passes;  ///< in a steady step; empty: the device keeps no time
    double rebuildSeconds = 0;     ///< one rebuild of the neighbour rows, on the device's clock
    // Not of a backend in a process of its own: then only the speed and the list are known, or only the speed.
    bool plain = false;  ///< the plain loop
    int copies = 1;      ///< processes side by side, of which `speed` is the sum
    int members = 1;     ///< canisters in one ensemble, each with the workload for itself; `speed` is that of all

    bool onlySpeed() const { return copies > 1 || members > 1; }

    double bandwidth() const { return stepBytes * speed.particleSteps.median; }  ///< [bytes/s]
};

/// Times the loop of plain_loop.h on the same particles.
Row plainRow(const std::string& name, const Workload& workload, int threads, const Effort& effort);

}  // namespace vkdose::bench
