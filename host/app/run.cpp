#include <fmt/format.h>

#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/app/interrupt.h"
#include "host/app/progress.h"
#include "host/app/report.h"
#include "host/core/error.h"
#include "host/output/run_folder.h"

namespace vkdose {

namespace {

/// Passes everything on to the output folder and, unless quiet, to the display.
class Fanout : public RunObserver {
  public:
    Fanout(RunObserver& folder, RunObserver* display) : folder_(folder), display_(display) {}
    void onProgress(const Progress& p) override {
        if (display_) display_->onProgress(p);
    }
    void onSample(const Sample& s) override { folder_.onSample(s); }
    void onDose(const Dose& d) override {
        folder_.onDose(d);
        if (display_) display_->onDose(d);
    }

  private:
    RunObserver& folder_;
    RunObserver* display_;
};

int exitCode(StopReason reason) {
    switch (reason) {
        case StopReason::Interrupted:
            return kInterrupted;
        case StopReason::RunError:
            return kRunError;
        case StopReason::DeviceError:
            return kDeviceError;
        default:
            return kOk;
    }
}

}  // namespace

int runCommand(const RunOptions& options) {
    // Everything that can be refused is refused before the folder is touched.
    const Case c = loadCase(options.input.file, options.input.overrides);
    Insertion filled = insertParticles(c);
    Derived derived = derive(c, filled);
    (void)Timeline(c);
    const std::unique_ptr<Backend> backend = makeBackend(options.backend);
    RunFolder folder(options.out.empty() ? std::filesystem::path("out") / c.name : options.out, options.force, c);

    const std::atomic<bool>& stop = watchInterrupts();
    ProgressDisplay display;
    if (!options.quiet) {
        fmt::print("{}: {} particles, {:.3f} g, on {}\n", c.name, filled.particles.size(), filled.mass * 1e3,
                   backend->description());
        std::fflush(stdout);
    }
    Fanout observers(folder, options.quiet ? nullptr : &display);
    const RunResult result = runFilled(c, std::move(filled), std::move(derived), *backend, observers, stop);
    display.close();

    if (!result.error.empty()) fmt::print(stderr, "vkdose: {}\n", result.error);
    folder.finish(c, result, backend->description());
    if (!options.quiet) {
        fmt::print("{}output   {}\n", reportText(c, result, backend->description()), folder.path().string());
    }
    const bool clean = validationClean(options.backend, *backend);
    return result.error.empty() && !clean ? kDeviceError : exitCode(result.reason);
}

}  // namespace vkdose
