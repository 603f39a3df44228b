#include "host/analysis/targets.h"

#include <fmt/format.h>

namespace vkdose {

TargetFigures targetFigures(const std::vector<Dose>& doses) {
    TargetFigures f;
    for (const Dose& d : doses) {
        if (!d.complete || !(d.target > 0)) continue;
        ++f.doses;
        f.byMass += d.stoppedBy == StopCause::Mass ? 1 : 0;
        f.target += d.target;
        f.stopMass += d.stopMass;
        f.overshoot += d.overshoot();
        f.error += d.mass - d.target;
        f.rotation += d.rotation;
    }
    if (f.doses == 0) return f;
    for (double* sum : {&f.target, &f.stopMass, &f.overshoot, &f.error, &f.rotation}) *sum /= f.doses;
    return f;
}

std::string targetText(const Dose& d) {
    return fmt::format("target {:.3f} g, {:.3f} g at the stop after {:.3g} s, overshoot {:.3f} g; stopped by {}",
                       d.target * 1e3, d.stopMass * 1e3, d.rotation, d.overshoot() * 1e3,
                       Words<StopCause>::kNames.at(std::size_t(d.stoppedBy)));
}

}  // namespace vkdose
