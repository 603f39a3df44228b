#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/app/interrupt.h"
#include "host/app/tell.h"
#include "host/sim/comparison.h"

namespace vkdose {

namespace {

std::uint64_t stepsToCompare(const CompareOptions& options, const Case& c, const Timeline& timeline) {
    const std::uint64_t longest = timeline.stepsUntilDose(c.schedule.stop.maxDoses);
    const auto asked =
        options.time > 0 ? static_cast<std::uint64_t>(std::llround(options.time / c.world.timeStep)) : options.steps;
    const std::uint64_t steps = std::min(asked > 0 ? asked : timeline.stepsUntilDose(1), longest);
    if (steps == 0) throw UsageError("there is nothing to compare: not a single step is made");
    return steps;
}

const char* verdictText(Verdict verdict) {
    switch (verdict) {
        case Verdict::Agrees:
            return "agrees";
        case Verdict::Differs:
            return "DIFFERS";
        case Verdict::Undecided:
            return "undecided: the twins differ too much";
    }
    return "?";
}

const char* outcomeText(Verdict verdict) {
    switch (verdict) {
        case Verdict::Agrees:
            return "the backends agree";
        case Verdict::Differs:
            return "the backends DIFFER";
        case Verdict::Undecided:
            return "UNDECIDED: nothing shows that the backends differ, nor that they agree; compare fewer steps or a "
                   "larger, calmer case";
    }
    return "?";
}

void printParticles(const std::vector<ParticleRow>& rows) {
    tell("Particle by particle (largest difference; positions in mean radii, velocities in the velocity scale)\n");
    tell("{:>10} {:>10} {:<7} {:>8} {:>10} {:>10} {:>10} {:>10}  verdict\n", "step", "time [s]", "phase", "contacts",
         "position", "allowed", "velocity", "allowed");
    bool chaos = false;
    double printed = 0;
    for (const ParticleRow& r : rows) {
        if (r.verdict == Verdict::Undecided && std::exchange(chaos, true)) continue;
        // Many rows that agree say no more than a few.
        const bool dull = r.verdict == Verdict::Agrees && static_cast<double>(r.step) < 1.25 * printed;
        if (dull) continue;
        printed = static_cast<double>(r.step);
        tell("{:>10} {:>10.4g} {:<7} {:>8} {:>10.2e} {:>10.2e} {:>10.2e} {:>10.2e}  {}\n", r.step, r.time,
             phaseName(r.phase), r.contacts, r.position, r.positionLimit, r.velocity, r.velocityLimit,
             r.verdict == Verdict::Undecided ? "chaotic from here on: not judged" : verdictText(r.verdict));
    }
}

void printQuantities(const std::vector<QuantityRow>& rows) {
    tell("\nThe packing as a whole (largest difference over time; spread: rough twins of the reference)\n");
    tell("{:<27} {:>10} {:>10} {:>10}  {:<15} {:>9}  verdict\n", "quantity", "difference", "spread", "allowed", "unit",
         "at [s]");
    for (const QuantityRow& r : rows) {
        tell("{:<27} {:>10.3g} {:>10.3g} {:>10.3g}  {:<15} {:>9.4g}  {}\n", r.name, r.difference, r.spread, r.tolerance,
             r.unit, r.time, verdictText(r.verdict));
    }
}

}  // namespace

int compareCommand(const CompareOptions& options) {
    const Case c = loadCase(options.input.file, options.input.overrides);
    const Insertion filled = insertParticles(c);
    const Timeline timeline(c);
    const std::uint64_t steps = stepsToCompare(options, c, timeline);

    BackendChoice onReference;
    onReference.backend = "reference";
    const std::unique_ptr<Backend> reference = makeBackend(onReference, filled.particles.size());
    const std::unique_ptr<Backend> candidate = makeBackend(options.backend, filled.particles.size());
    std::vector<std::unique_ptr<Backend>> more;
    const auto another = [&] { return more.emplace_back(makeBackend(onReference, filled.particles.size())).get(); };
    Twins twins;
    twins.fine = another();
    for (int i = 0; i < options.twins; ++i) twins.rough.push_back(another());
    tell("{}: {} particles, {} steps ({:.4g} s): {} against {}, {} + 1 perturbed twins\n\n", c.name,
         filled.particles.size(), steps, timeline.time(steps), candidate->description(), reference->description(),
         options.twins);
    const Schedule& s = c.schedule;
    if (s.untilRest || s.targetMass > 0 || std::isfinite(s.maxTorque))
        tell(
            "All make the steps of the longest times: nothing that a run reads from its sensors ends a phase "
            "here.\n\n");
    sendText(stdout);

    const bool terminal = isatty(fileno(stderr)) == 1;
    const auto progress = [&](std::uint64_t step) {
        if (!terminal) return;
        tell(stderr, "\r{:>5.1f} %", 100.0 * static_cast<double>(step) / static_cast<double>(steps));
        sendText(stderr);
    };
    const Comparison result =
        compareBackends(c, filled, *reference, twins, *candidate, steps, progress, watchInterrupts());
    if (terminal) tell(stderr, "\r\033[K");
    printParticles(result.particles);
    printQuantities(result.quantities);
    tell("\nledger closed on every backend at {} times\n", result.particles.size());
    if (result.interrupted) {
        tell("interrupted after {} of {} steps\n", result.steps, steps);
        return kInterrupted;
    }
    if (result.undecided() > 0) {
        tell("{} of {} quantities are too chaotic for {} twins to decide\n", result.undecided(),
             result.quantities.size(), options.twins);
    }
    tell("{}\n", outcomeText(result.verdict()));
    if (!validationClean(options.backend, *candidate)) return kDeviceError;
    return result.verdict() == Verdict::Agrees ? kOk : kDisagree;
}

}  // namespace vkdose
