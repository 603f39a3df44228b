#include "host/analysis/targets.h"

#include <utility>

#include "tests/support/catch.h"

using namespace vkdose;

namespace {

Dose dose(double target, double stop, double mass, double rotation, StopCause cause) {
    Dose d;
    d.target = target;
    d.stopMass = stop;
    d.mass = mass;
    d.rotation = rotation;
    d.stoppedBy = cause;
    d.complete = true;
    return d;
}

}  // namespace

TEST_CASE("figures of doses to a mass are means over the complete ones with a target") {
    std::vector<Dose> doses{dose(4e-3, 4.1e-3, 4.5e-3, 0.5, StopCause::Mass),
                            dose(4e-3, 3.5e-3, 3.7e-3, 2.0, StopCause::Time),
                            dose(4e-3, 9e-3, 9e-3, 9, StopCause::Mass), dose(0, 9e-3, 9e-3, 9, StopCause::Time)};
    doses[2].complete = false;
    for (const auto& [i, closedForm] : {std::pair(0, 9e-3), std::pair(1, 5e-3), std::pair(2, 90e-3)})
        doses[std::size_t(i)].closedForm = closedForm;
    const TargetFigures f = targetFigures(doses);
    CHECK(f.doses == 2);
    CHECK(f.byMass == 1);
    CHECK(f.target == Approx(4e-3));
    CHECK(f.stopMass == Approx(3.8e-3));
    CHECK(f.overshoot == Approx(0.3e-3));
    CHECK(f.error == Approx(0.1e-3));
    CHECK(f.rotation == Approx(1.25));
    CHECK(f.closedForm == Approx(7e-3));
    CHECK(targetFigures({doses[3]}).doses == 0);
    CHECK(targetText(doses[0]) ==
          "target 4.000 g, 4.100 g at the stop after 0.5 s, overshoot 0.400 g; stopped by mass");
}
