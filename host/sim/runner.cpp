#include "host/sim/runner.h"

#include <utility>

#include "host/sim/run_loop.h"

namespace vkdose {

RunResult runFilled(const Case& c, Insertion filled, Derived derived, Backend& backend, RunObserver& observer,
                    const std::atomic<bool>& stop, const RunCheckpoint* from) {
    return RunLoop(c, std::move(filled), std::move(derived), backend, observer, stop).play([from](RunLoop& run) {
        if (from != nullptr)
            run.goOn(*from);
        else
            run.begin();
    });
}

RunResult runFrom(const Case& c, Insertion filled, Derived derived, Backend& backend, RunObserver& observer,
                  const std::atomic<bool>& stop, const RunCheckpoint& from, double time) {
    return RunLoop(c, std::move(filled), std::move(derived), backend, observer, stop).play([&](RunLoop& run) {
        run.takeOver(from, time);
    });
}

RunResult runCase(const Case& c, Backend& backend, RunObserver& observer, const std::atomic<bool>& stop) {
    Insertion filled = insertParticles(c);
    Derived derived = derive(c, filled);
    return runFilled(c, std::move(filled), std::move(derived), backend, observer, stop);
}

}  // namespace vkdose
