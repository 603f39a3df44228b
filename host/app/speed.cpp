#include "host/app/speed.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "host/app/text.h"
#include "host/core/error.h"
#include "host/core/printable.h"

namespace vkdose {

namespace {

/// With so many times the particles of the fill a run goes at another speed.
constexpr double kManyMore = 2;

/// The freshly filled grid has no contacts yet, so it runs faster than the bed it becomes.
double measuredSpeed(const Case& c, const Insertion& filled, Backend& backend) {
    using Clock = std::chrono::steady_clock;
    const auto particles = static_cast<double>(std::max<std::size_t>(filled.particles.size(), 1));
    backend.load(c.settlingWorld(), c.settlingLaw, filled.particles);
    // Without an outlet or a fall of a second there is nothing to lose; the probe ends long before either.
    auto steps = static_cast<std::uint32_t>(std::clamp(1e6 / particles, 1.0, 16.0));
    backend.advance(steps, 0);  // warm up: pipelines, first neighbour list
    double seconds = 0, work = 0;
    while (seconds < 1.0) {
        const auto begin = Clock::now();
        backend.advance(steps, 0);
        const double spent = std::chrono::duration<double>(Clock::now() - begin).count();
        seconds += spent;
        work += static_cast<double>(steps) * particles;
        if (spent < 0.1) steps = std::min<std::uint32_t>(steps * 2, 1U << 20);
    }
    return work / seconds;
}

}  // namespace

Speed speedOf(const Case& c, const Insertion& filled, const BackendChoice& choice, bool assume) {
    if (assume) return {kAssumedSpeed, false, ""};
    try {
        const std::unique_ptr<Backend> backend = makeBackend(choice, filled.particles.size());
        return {measuredSpeed(c, filled, *backend), true, backend->description(), filled.particles.size()};
    } catch (const DeviceError& e) {
        return {kAssumedSpeed, false, e.what()};
    } catch (const RunError& e) {
        return {kAssumedSpeed, false, e.what()};
    }
}

std::string speedText(const Speed& speed) {
    const std::string rate = large(speed.rate) + "particle-steps/s";
    if (speed.measured) return fmt::format("at {}, measured on {}", rate, speed.told);
    if (speed.told.empty()) return "at an assumed " + rate;
    return fmt::format("at an assumed {}, because the device could not be measured: {}", rate,
                       printable(speed.told.substr(0, speed.told.find('\n'))));
}

std::string workText(const Derived& derived) {
    return fmt::format("work       about {:.3g} million steps, {}particle-steps{}\n", derived.steps * 1e-6,
                       large(derived.work), derived.countsLeaving ? "" : "; powder that leaves is not taken off");
}

std::string runTimeText(const Derived& derived, const Speed& speed) {
    const std::string text = fmt::format("run time   {} {}\n", duration(derived.work / speed.rate), speedText(speed));
    // A step has a cost of its own, which a hundred spheres bear as well as a thousand.
    const double mean = derived.steps > 0 ? derived.work / derived.steps : 0;
    if (speed.measured && mean > kManyMore * static_cast<double>(speed.particles))
        return text + fmt::format(
                          "           with the {} particles of the fill; refills make them {:.0f} on average, "
                          "and a step with more of them takes less time for each\n",
                          speed.particles, mean);
    return text + caveatText(speed, 11);
}

std::string caveatText(const Speed& speed, int indent) {
    if (!speed.measured) return "";
    return fmt::format(
        "{:{}}with the fresh, loose filling; a settled bed touches more and takes two to three times as long\n", "",
        indent);
}

}  // namespace vkdose
