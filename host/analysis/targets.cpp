#include "host/analysis/targets.h"

#include <fmt/format.h>

#include "host/core/grams.h"

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
        f.closedForm += d.closedForm;
    }
    if (f.doses == 0) return f;
    for (double* sum : {&f.target, &f.stopMass, &f.overshoot, &f.error, &f.rotation, &f.closedForm}) *sum /= f.doses;
    return f;
}

std::string targetText(const Dose& d) {
    return fmt::format("target {} g, {} g at the stop after {:.3g} s, overshoot {} g; stopped by {}", grams(d.target),
                       grams(d.stopMass), d.rotation, grams(d.overshoot()),
                       Words<StopCause>::kNames.at(std::size_t(d.stoppedBy)));
}

}  // namespace vkdose
