// The figures of a run that is over, by their names.
#include "host/study/trials.h"

#include <cmath>
#include <fstream>

#include "tests/support/catch.h"
#include "tests/support/folder.h"

using namespace vkdose;
using namespace vkdose::test;

TEST_CASE("a figure of a run comes with its standard error, where the run tells it") {
    const Folder run;
    run.write("summary.json", R"({"dose_statistics": {"mean_kg": 0.002},
        "analysis": {"beta_kg_per_dose": 0.0031, "beta_standard_error_kg_per_dose": 0.0001},
        "bodies": [{"name": "lid", "largest_torque_Nm": 0.5}],
        "measures": {"heap": {"angle_deg": 31.5, "angle_error_deg": 1.2, "height_m": 0.01},
                     "front": {"angle_deg": 43.8, "angle_error_deg": null}}})");
    const auto in = [&](const char* figure) { return RunFigures(run.path()).at(figure); };
    CHECK(in("heap.angle_deg").value == 31.5);
    CHECK(in("heap.angle_deg").error == 1.2);
    CHECK(in("heap.angle_error_deg").value == 1.2);
    CHECK(std::isnan(in("heap.angle_error_deg").error));
    CHECK(in("heap.height_m").value == 0.01);
    CHECK(std::isnan(in("heap.height_m").error));
    CHECK(in("front.angle_deg").value == 43.8);
    CHECK(std::isnan(in("front.angle_deg").error));
    CHECK(in("lid.largest_torque_Nm").value == 0.5);
    CHECK(std::isnan(in("lid.largest_torque_Nm").error));
    CHECK(in("mass_per_dose_g").value == Approx(3.1));
    CHECK(in("mass_per_dose_g").error == Approx(0.1));
    CHECK(in("dose.mean_kg").value == 0.002);
    CHECK(std::isnan(in("nobody.angle_deg").value));
}
