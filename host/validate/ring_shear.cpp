// Beads in a ring shear cell under a load: the angle of steady flow, from the stresses while the powder is sheared
// before each point, beside what a ring shear tester measured with beads of glass.

#include <cmath>

#include "host/validate/comparisons.h"

namespace vkdose::validate {

Evaluation ringShear(const std::vector<Run>& runs, const std::filesystem::path&) {
    constexpr double kMeasured = 23.5, kBeside = 2;  // [degrees]
    std::vector<double> angles;
    for (const Run& run : runs)
        angles.push_back(std::atan2(run.figure("/measures/ring-shear/pre_shear_stress_Pa"),
                                    run.figure("/measures/ring-shear/pre_shear_normal_stress_Pa")) *
                         180 / kPi);
    Finding finding = meanOf("angle of steady flow", "degrees", angles);
    finding.remark = "2 degrees beyond are allowed: theirs are other beads";
    holdAgainst(finding, {{"ring shear tester RST-01", kMeasured}}, 0, kBeside);
    return {{finding}, {}};
}

}  // namespace vkdose::validate
