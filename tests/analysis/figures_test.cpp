#include "host/analysis/figures.h"

#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using vkdose::test::nearRelative;

namespace {

/// Complete doses of these masses [kg] on top of what fell out while settling.
std::vector<Dose> dosesOf(const std::vector<double>& masses, double settling) {
    std::vector<Dose> doses;
    for (const double m : masses) {
        Dose d;
        d.mass = m;
        d.cumulative = (doses.empty() ? settling : doses.back().cumulative) + m;
        d.complete = true;
        doses.push_back(d);
    }
    return doses;
}

}  // namespace

TEST_CASE("the paper's window in a large canister, the saturation of a small one") {
    const DosingFigures large = figuresOf(dosesOf({4e-3, 4e-3, 4e-3, 4e-3}, 0), 0.048);
    CHECK(large.beta.doses == 3);
    CHECK(nearRelative(large.beta.beta, 4e-3, 1e-12));
    const DosingFigures small = figuresOf(dosesOf({4e-3, 4e-3, 1e-3, 1e-3}, 0), 0.010);
    CHECK(small.beta.doses == 1);  // 4 g; 8 g are not below 80 % of 10 g
    CHECK(small.dosesTo99 == 4);
}

TEST_CASE("what fell out while settling does not hide a blockage from the first dose on") {
    CHECK(figuresOf(dosesOf({0, 0, 0}, 1e-3), 0.048).blocked == 1);
}

TEST_CASE("a run without doses has no figures") {
    const DosingFigures f = figuresOf({}, 0.048);
    CHECK(f.beta.doses == 0);
    CHECK_FALSE(f.dosesTo99);
    CHECK_FALSE(f.blocked);
}
