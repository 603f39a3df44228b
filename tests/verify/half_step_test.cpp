// Velocity Verlet with half-step velocities, and a small sphere at the neck between two large ones: the limits
// host/verify/README.md states, so that they stay true. A change that removes the error must change that page too.

#include "host/backend/reference/reference.h"
#include "host/core/vec.h"
#include "host/verify/cases.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::verify;

namespace {

/// [degrees]; 0 if it is held
double parting(double ratio, double timeStep) {
    const auto backend = makeReferenceBackend();
    Stage stage(*backend, "neck");
    return partingFromNeck(stage, ratio, timeStep) * 180 / kPi;
}

}  // namespace

TEST_CASE("up to a size ratio of 5 the time step does not matter") {
    // Angles are looked at every 0.2 ms, in which the sphere turns by up to 0.7 degrees; here they fall together.
    for (const double ratio : {3.0, 5.0}) CHECK(std::abs(parting(ratio, 2e-6) - parting(ratio, 0.5e-6)) < 0.5);
}

TEST_CASE("at a size ratio of 10 it parts late, by an error of first order") {
    const double coarse = parting(10, 4e-6), middle = parting(10, 2e-6), fine = parting(10, 1e-6);
    CHECK(coarse - middle > 4);
    CHECK(middle - fine > 2);
    CHECK((coarse - middle) / (middle - fine) == Approx(2).margin(0.5));  // second order would give 4
}

TEST_CASE("at a size ratio of 20 it is held at a time step of 2e-6 s and let go at 1e-6 s") {
    CHECK(parting(20, 2e-6) == 0);
    CHECK(parting(20, 1e-6) > 80);
}
