// summary.json: what is told of the doses.
#include "host/output/summary.h"

#include <nlohmann/json.hpp>

#include "tests/sim/fake_backend.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

TEST_CASE("doses to a mass have the closed form of the turns that they made, not their target") {
    Case c = smallCase();
    RunResult r;
    r.derived.massPerDose = 1e-3;
    const auto told = [&] {
        return nlohmann::json::parse(summaryJson(c, r, "fake"))["closed_form"]["mass_per_dose_kg"];
    };
    CHECK(told() == 1e-3);
    c.schedule.targetMass = 1e-3;  // by which `derive` plans
    CHECK(told().is_null());
    for (const double closedForm : {6e-3, 3e-3, 99e-3}) {
        Dose d;
        d.target = 1e-3;
        d.closedForm = closedForm;
        d.complete = closedForm < 99e-3;
        r.doses.push_back(d);
    }
    CHECK(nearRelative(told().get<double>(), 4.5e-3, 1e-12));
}
