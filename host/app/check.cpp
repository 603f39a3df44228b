#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/app/text.h"
#include "host/core/printable.h"
#include "host/sim/runner.h"

namespace vkdose {

namespace {

/// Used where no speed is measured: about the speed of two cores of a server with a CPU driver and a settled bed.
constexpr double kAssumedSpeed = 6e6;

/// The freshly filled grid has no contacts yet, so it runs faster than the bed it becomes.
double measuredSpeed(const Case& c, const Insertion& filled, Backend& backend) {
    using Clock = std::chrono::steady_clock;
    backend.load(c.world, c.settlingLaw, filled.particles);
    // Without an outlet or a fall of a second there is nothing to lose; the probe ends long before either.
    std::uint32_t steps = 16;
    backend.advance(steps, 0);  // warm up: pipelines, first neighbour list
    double seconds = 0, work = 0;
    while (seconds < 1.0) {
        const auto begin = Clock::now();
        backend.advance(steps, 0);
        const double spent = std::chrono::duration<double>(Clock::now() - begin).count();
        seconds += spent;
        work += static_cast<double>(steps) * static_cast<double>(filled.particles.size());
        if (spent < 0.1) steps = std::min<std::uint32_t>(steps * 2, 1U << 20);
    }
    return work / seconds;
}

void printFilling(const Insertion& filled) {
    const auto [low, high] = std::minmax_element(filled.particles.radius.begin(), filled.particles.radius.end());
    fmt::print("particles  {}, {:.4g} g", filled.particles.size(), filled.mass * 1e3);
    if (filled.targetMass > 0) fmt::print(" (target {:.4g} g)", filled.targetMass * 1e3);
    if (low != filled.particles.radius.end()) fmt::print(", radius {:.4g} to {:.4g} mm", *low * 1e3, *high * 1e3);
    if (filled.redrawn > 0) fmt::print(", {} draws outside the bounds drawn again", filled.redrawn);
    fmt::print("\n");
}

void printSoftening(const Case& c) {
    const ContactParameters& p = c.dosingLaw.of(ContactClass::ParticleParticle);
    fmt::print(
        "softened   {:.4g} times: k = {:.5g} N/m, damping {:.4g} kg/s, plasticity_depth {:.4g} between particles\n",
        c.softened, p.k2Max, p.gamma, p.plasticityDepth);
}

void printTimeScales(const Derived& d) {
    fmt::print("contact duration     mean pair on k1  stiffest pair on k2\n");
    for (const Derived::PairDuration& p : d.durations) {
        fmt::print("  {:<18} {:>13.4g} s  {:>17.4g} s\n", p.name, p.mean, p.stiffest);
    }
    fmt::print("time step  {:.4g} s = 1/{:.3g} of the stiffest\n", d.timeStep, d.stiffest / d.timeStep);
}

void printPredictions(const Derived& d) {
    fmt::print("push V_z   {:.4g} mm/s (p Omega / 2 pi)\n", d.pushVelocity * 1e3);
    fmt::print("tip V_t    {:.4g} mm/s (Omega r_c)\n", d.tipVelocity * 1e3);
    fmt::print("per dose   {:.4g} g by the closed form (rho_b p pi r_c^2 n_t)\n", d.massPerDose * 1e3);
    fmt::print("doses      {:.3g} to empty the canister by the closed form\n", d.doses);
}

}  // namespace

int checkCommand(const CheckOptions& options) {
    const Case c = loadCase(options.input.file, options.input.overrides);
    const Insertion filled = insertParticles(c);
    const Derived d = derive(c, filled);
    const Timeline timeline(c);
    fmt::print("case       {}: {}\n", c.name, printableLines(c.reason));
    printFilling(filled);
    if (c.softened > 1) printSoftening(c);
    printTimeScales(d);
    if (c.world.coil) printPredictions(d);
    fmt::print("schedule   settle {} steps, rotate {}, rest {}; sensors every {} steps\n", timeline.settleSteps(),
               timeline.rotateSteps(), timeline.restSteps(), timeline.sensorSteps());

    const double work = d.steps * static_cast<double>(d.particles);
    fmt::print("work       about {:.3g} million steps, {}particle-steps\n", d.steps * 1e-6, large(work));
    if (options.measure) {
        const std::unique_ptr<Backend> backend = makeBackend(options.backend, filled.particles.size());
        const double speed = measuredSpeed(c, filled, *backend);
        fmt::print(
            "run time   {} at {}particle-steps/s, measured on {}\n"
            "           with the fresh, loose filling; a settled bed touches more and takes up to about twice as "
            "long\n",
            duration(work / speed), large(speed), backend->description());
    } else {
        fmt::print("run time   {} at an assumed {}particle-steps/s (--measure asks the device)\n",
                   duration(work / kAssumedSpeed), large(kAssumedSpeed));
    }
    return kOk;
}

}  // namespace vkdose
