#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <future>
#include <new>
#include <thread>

#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/app/inputs.h"
#include "host/app/interrupt.h"
#include "host/app/tell.h"
#include "host/backend/vulkan/vulkan.h"
#include "host/bench/copies.h"
#include "host/bench/machine.h"
#include "host/bench/results_table.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/printable.h"
#include "host/output/run_folder.h"
#include "host/vk/device.h"

namespace vkdose {

namespace {

using bench::Workload;

constexpr std::uint32_t kProfiledSteps = 256, kFirstSteps = 32;

/// Processors that work at once. The plain loop takes as many threads as a software device would.
int processors() {
    return std::max(1, int(std::thread::hardware_concurrency()));
}

std::optional<Case> settledBed(const BenchOptions& options) {
    if (!options.bed.empty()) return loadCase(options.bed);
    if (std::filesystem::exists(kSettledBed)) return loadCase(kSettledBed);
    tell(stderr, "vkdose: there is no {} here, so nothing is measured on it; --bed names it\n", kSettledBed);
    return std::nullopt;
}

std::vector<bench::Plan> chosenPlans(const BenchOptions& options) {
    std::vector<bench::Plan> plans = bench::plans(settledBed(options)), chosen;
    std::string known;
    for (const bench::Plan& p : plans) {
        known += "\n  " + p.name;
        if (p.name.find(options.only) != std::string::npos && (p.quick || !options.quick) &&
            (!p.huge || options.only == p.name))
            chosen.push_back(p);
    }
    if (chosen.empty())
        throw UsageError(fmt::format("--only {}: no {}workload has this in its name; the workloads are{}", options.only,
                                     options.quick ? "quick " : "", known));
    return chosen;
}

double since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Mean time of a rebuild of the neighbour rows and the refresh of the contact lists that follows. It covers all passes
/// except `decide` and those of every step. It is taken from the first steps after loading; the very first of them
/// builds the rows.
double rebuildSeconds(const VulkanProfile& first) {
    constexpr std::array kOthers{"decide", "pairs", "surfaces", "bodies", "move"};
    double seconds = 0;
    for (const VulkanProfile::Pass& p : first.passes)
        if (std::find(kOthers.begin(), kOthers.end(), p.name) == kOthers.end()) seconds += p.seconds;
    return first.rebuilds > 0 ? seconds / double(first.rebuilds) : 0;
}

/// Steps of the profile: fewer of a large bed, so that it takes no longer than the repeats.
std::uint32_t profiledSteps(std::size_t particles) {
    constexpr std::size_t kMostParticleSteps = 256'000'000;
    return std::uint32_t(std::clamp<std::size_t>(kMostParticleSteps / particles, kFirstSteps, kProfiledSteps));
}

void fillProfile(bench::Row& row, const VulkanProfile& p) {
    for (const VulkanProfile::Pass& pass : p.passes) row.passes.push_back({pass.name, pass.seconds / p.steps});
    row.listed = p.listed;
    row.refreshesPer1000 = 1e3 * double(p.refreshes) / p.steps;
    row.tableBytes = p.tableBytes / double(row.particles);
    row.copyBandwidth = p.copyBandwidth;
    row.stepBytes = stepBytes(row.coordination.touching, row.coordination.walls);
}

/// A backend of its own for each workload, so that the time to the first step is that of a program just started.
void measure(bench::Row& row, const Workload& w, const BackendChoice& choice, const bench::Effort& effort) {
    const auto start = std::chrono::steady_clock::now();
    const std::unique_ptr<Backend> backend = makeBackend(choice, row.particles);
    row.on = backend->description();
    backend->load(w.world, w.particles);
    backend->advance(1, w.coilRate);
    row.startUp = since(start);
    backend->load(w.world, w.particles);
    row.rebuildSeconds = rebuildSeconds(profile(*backend, kFirstSteps, w.coilRate));

    std::uint64_t steps = 0, lastSteps = 0, rebuilds = 0, lastRebuilds = 0;
    const auto advance = [&](std::uint32_t n) {
        lastSteps = n;
        lastRebuilds = rebuilds;
        rebuilds = backend->advance(n, w.coilRate).rebuilds;
        steps += n;
    };
    row.speed = bench::time(advance, row.particles, w.warmSteps, effort);
    row.rebuildsPer1000 = 1e3 * double(rebuilds - lastRebuilds) / double(lastSteps);
    row.coordination = bench::coordinationOf(*backend, row.particles);
    row.contactsPerSecond = row.speed.particleSteps.median * (row.coordination.touching / 2 + row.coordination.walls);
    fillProfile(row, profile(*backend, profiledSteps(row.particles), w.coilRate));
    if (!validationClean(choice, *backend)) throw DeviceError("the validation layer found faults");
}

bench::Row named(const std::string& name, const Workload& w, const bench::Effort& effort) {
    bench::Row row;
    row.workload = name;
    row.particles = w.particles.size();
    row.repeats = effort.repeats;
    return row;
}

/// A packing too large for a device or this machine is a result too.
bench::Row measured(const std::string& name, const Workload& w, const BackendChoice& choice,
                    const bench::Effort& effort) {
    bench::Row row = named(name, w, effort);
    try {
        measure(row, w, choice, effort);
    } catch (const DeviceError& e) {
        if (row.on.empty()) throw;  // no device at all
        row.refused = e.what();
    } catch (const std::bad_alloc&) {
        row.refused = "this machine has not enough memory for it";
    }
    return row;
}

/// Adds up the speeds of several processes. This process itself does not use the device.
bench::Row measuredCopies(const std::string& name, const Workload& w, const BenchOptions& options,
                          bench::Effort effort) {
    bench::Row row = named(name, w, effort);
    row.on = fmt::format("{} processes", options.copies);
    row.copies = options.copies;
    const auto oneCopy = [&](const bench::Meet& meet) {
        const std::unique_ptr<Backend> backend = makeBackend(options.backend, row.particles);
        backend->load(w.world, w.particles);
        effort.meet = meet;
        const auto advance = [&](std::uint32_t n) { backend->advance(n, w.coilRate); };
        return bench::time(advance, row.particles, w.warmSteps, effort).rates;
    };
    try {
        row.speed.rates = bench::sumOfCopies(options.copies, effort.repeats, oneCopy);
        row.speed.particleSteps = bench::spreadOf(row.speed.rates);
    } catch (const DeviceError& e) {
        row.refused = e.what();
    }
    return row;
}

/// `options.members` copies of the workload in one ensemble.
bench::Row measuredEnsemble(const std::string& name, const Workload& w, const BenchOptions& options,
                            const bench::Effort& effort) {
    const std::size_t members = std::size_t(options.members);
    bench::Row row = named(name, w, effort);
    row.members = options.members;
    row.particles *= members;
    try {
        VulkanEnsemble ensemble = makeEnsemble(options.backend, row.particles);
        std::vector<std::unique_ptr<Backend>> backends;
        while (backends.size() < members) backends.push_back(ensemble.enter());
        row.on = backends[0]->description();
        // Every member in a thread of its own, as Rendezvous wants it.
        const auto together = [&](const std::function<void(Backend&)>& act) {
            std::vector<std::future<void>> acts;
            for (const auto& backend : backends) acts.push_back(std::async(std::launch::async, [&] { act(*backend); }));
            for (std::future<void>& a : acts) a.get();
        };
        together([&](Backend& b) { b.load(w.world, w.particles); });
        const auto advance = [&](std::uint32_t n) { together([&](Backend& b) { b.advance(n, w.coilRate); }); };
        row.speed = bench::time(advance, row.particles, w.warmSteps, effort);
        row.tableBytes = tableBytes(*backends[0]) / double(row.particles);
    } catch (const DeviceError& e) {
        row.refused = e.what();
    }
    return row;
}

/// The driver of the device that a backend describes; empty if it is none.
std::string driverOf(const std::string& description) {
    for (const vk::DeviceInfo& d : vk::listDevices())
        if (description == "vulkan: " + d.name) return d.driver;
    return "";
}

void print(const bench::Row& row) {
    tell("{}\n", bench::tableLine(row));
    const std::string details = bench::detailLines(row);
    if (!details.empty()) tell("{}\n", details);
    sendText(stdout);
}

}  // namespace

int benchCommand(const BenchOptions& options) {
    const std::vector<bench::Plan> plans = chosenPlans(options);
    if (!options.bed.empty())
        keepInputs(loadCase(options.bed).files, {options.out / "bench.json", options.out / "bench.csv"});
    createFolder(options.out);
    bench::Effort effort;
    effort.repeats = options.repeats;
    if (options.quick) {
        effort.seconds = 0.02;
        effort.mostWarmSteps = 50;
    }

    const std::atomic<bool>& stop = watchInterrupts();
    std::vector<bench::Row> rows;
    const std::string processor = bench::processorText();
    std::string driver;  // looked up once, because that takes an instance of Vulkan; all rows are of one device
    const auto add = [&](bench::Row row) {
        const bool ofDevice = !row.plain && row.refused.empty();
        if (ofDevice && driver.empty()) driver = driverOf(row.on);
        if (ofDevice) row.driver = driver;
        row.processor = processor;
        print(row);
        rows.push_back(std::move(row));
    };
    tell("{}\n", bench::headLine());
    for (const bench::Plan& plan : plans) {
        if (stop) break;
        const Workload workload = plan.make();
        if (options.copies > 1) {
            add(measuredCopies(plan.name, workload, options, effort));
        } else if (options.members > 1) {
            add(measuredEnsemble(plan.name, workload, options, effort));
        } else {
            add(measured(plan.name, workload, options.backend, effort));
            add(bench::plainRow(plan.name, workload, processors(), effort));
        }
        replaceFile(options.out / "bench.json", bench::jsonTable(rows));
        replaceFile(options.out / "bench.csv", bench::csvTable(rows));
    }
    if (!rows.empty() && std::all_of(rows.begin(), rows.end(), [](const bench::Row& r) { return !r.refused.empty(); }))
        throw DeviceError("nothing could be measured");
    for (const bench::Plan& plan : plans)
        if (const std::string line = bench::ratioLine(rows, plan.name, plan.without); !line.empty()) tell("{}\n", line);
    if (!rows.empty())
        tell("\n{}\nall figures: {}\n", bench::machineLines(rows.front()),
             printable((options.out / "bench.csv").string()));
    return stop ? kInterrupted : kOk;
}

}  // namespace vkdose
