#include "host/bench/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>

#include "host/bench/plain_loop.h"

namespace vkdose::bench {

namespace {

constexpr std::uint32_t kFewestSteps = 16;

struct Lap {
    double wall, processor;  // [s]
};

Lap timed(const std::function<void(std::uint32_t)>& advance, std::uint32_t steps) {
    const std::clock_t processor = std::clock();
    const auto wall = std::chrono::steady_clock::now();
    advance(steps);
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count(),
            double(std::clock() - processor) / CLOCKS_PER_SEC};
}

/// The number of steps that take about `seconds`. Doubles the steps until a lap is long enough to predict it.
std::uint32_t stepsFor(double seconds, const std::function<void(std::uint32_t)>& advance) {
    std::uint32_t steps = kFewestSteps;
    for (;;) {
        const double spent = timed(advance, steps).wall;
        if (spent * 4 >= seconds) return std::max(kFewestSteps, std::uint32_t(seconds / spent * steps));
        steps *= 2;
    }
}

}  // namespace

Spread spreadOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return {(values[(n - 1) / 2] + values[n / 2]) / 2, values.front(), values.back()};
}

Speed time(const std::function<void(std::uint32_t)>& advance, std::size_t particles, std::uint32_t warmSteps,
           const Effort& effort) {
    advance(std::max(1u, std::min(warmSteps, effort.mostWarmSteps)));
    Speed speed;
    speed.steps = stepsFor(effort.seconds, advance);
    std::vector<double> busy;
    for (int i = 0; i < effort.repeats; ++i) {
        effort.meet();
        const Lap lap = timed(advance, speed.steps);
        speed.rates.push_back(double(particles) * speed.steps / lap.wall);
        busy.push_back(lap.processor / lap.wall);
    }
    speed.particleSteps = spreadOf(speed.rates);
    speed.coresBusy = spreadOf(busy);
    return speed;
}

Coordination coordinationOf(const Backend& backend, std::size_t particles) {
    double pairs = 0, walls = 0;
    for (const Contact& c : backend.contacts()) (c.kind == ContactClass::ParticleParticle ? pairs : walls) += 1;
    return {2 * pairs / double(particles), walls / double(particles)};
}

Row plainRow(const std::string& name, const Workload& workload, int threads, const Effort& effort) {
    Row row;
    row.workload = name;
    row.on = fmt::format("plain loop, {} threads", threads);
    row.plain = true;
    row.particles = workload.particles.size();
    row.repeats = effort.repeats;
    PlainLoop loop(workload.world, workload.particles, threads);
    row.listed = loop.listed();
    row.speed = time([&](std::uint32_t steps) { loop.advance(steps); }, row.particles, 1, effort);
    row.coordination.touching = loop.touching();
    return row;
}

}  // namespace vkdose::bench
