#include "host/analysis/figures.h"

#include "tests/analysis/doses.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using vkdose::test::dosesOf;
using vkdose::test::nearRelative;

TEST_CASE("the paper's window in a large canister, the saturation of a small one") {
    const DosingFigures large = figuresOf(dosesOf({4e-3, 4e-3, 4e-3, 4e-3}, 0), 0.048, {});
    CHECK(large.beta.doses == 3);
    CHECK(nearRelative(large.beta.beta, 4e-3, 1e-12));
    const DosingFigures small = figuresOf(dosesOf({4e-3, 4e-3, 1e-3, 1e-3}, 0), 0.010, {});
    CHECK(small.beta.doses == 1);  // 4 g; 8 g are not below 80 % of 10 g
    CHECK(small.dosesTo99 == 4);
}

TEST_CASE("what fell out while settling does not hide a blockage from the first dose on") {
    CHECK(figuresOf(dosesOf({0, 0, 0}, 1e-3), 0.048, {}).blocked == 1);
}

TEST_CASE("a run without doses has no figures") {
    const DosingFigures f = figuresOf({}, 0.048, {});
    CHECK(f.beta.doses == 0);
    CHECK_FALSE(f.dosesTo99);
    CHECK_FALSE(f.blocked);
}

TEST_CASE("next to nothing is what the case says, or the paper's share of a dose") {
    // A device of milligrams: three doses of 5 mg are a flow, and of 0.1 mg none.
    StopRule stop;
    stop.threshold = 1e-6;
    stop.doses = 2;
    CHECK_FALSE(figuresOf(dosesOf({5e-6, 5e-6, 5e-6}, 0), 1e-3, stop).blocked);
    CHECK(figuresOf(dosesOf({5e-6, 1e-7, 1e-7}, 0), 1e-3, stop).blocked == 2);
    stop.threshold = 1e-4;
    CHECK(figuresOf(dosesOf({5e-6, 5e-6, 5e-6}, 0), 1e-3, stop).blocked == 1);

    // Without an experiment's rule: the threshold shrinks with the dose, and without a dose nothing is little.
    StopRule none;
    none.kind = StopRule::Kind::None;
    none.threshold = 0;
    CHECK(nearRelative(blockageRule(none, 4.2e-3).threshold, 0.15e-3, 1e-12));
    CHECK(nearRelative(blockageRule(none, 4.2e-6).threshold, 0.15e-6, 1e-12));
    CHECK(blockageRule(none, 0).threshold == 0);
    CHECK(blockageRule(none, 1).doses == 3);
    std::vector<Dose> doses = dosesOf({5e-6, 5e-6, 5e-6}, 0);
    for (Dose& d : doses) d.closedForm = 5e-6;
    CHECK_FALSE(figuresOf(doses, 1e-3, none).blocked);
}

TEST_CASE("doses to a mass that all reach it are not blocked, however far the coil turned for them") {
    std::vector<Dose> doses = dosesOf(std::vector<double>(8, 3e-5), 0);
    for (Dose& d : doses) {
        d.target = 3e-5;
        d.closedForm = 1e-3;
    }
    doses[0].closedForm = 4e-3;  // it fills the throat too; its share of the paper's threshold would be 0.14 g
    StopRule none;
    none.kind = StopRule::Kind::None;
    const DosingFigures f = figuresOf(doses, 1e-2, none);
    CHECK_FALSE(f.blocked);
    CHECK(nearRelative(f.rule.threshold, 0.15e-3 * 3e-5 / 4.2e-3, 1e-12));
    for (Dose& d : doses) d.closedForm = 1e-5;  // the coil stopped before the target, by its time or torque
    CHECK(nearRelative(figuresOf(doses, 1e-2, none).rule.threshold, 0.15e-3 * 1e-5 / 4.2e-3, 1e-12));
}

TEST_CASE("what is next to nothing in a dose to a mass follows the mass where a device has no closed form") {
    StopRule none;
    none.kind = StopRule::Kind::None;
    none.threshold = 0;
    std::vector<Dose> doses = dosesOf({3e-5, 3e-5, 0, 0, 0}, 0);
    for (Dose& d : doses) {
        d.target = 3e-5;
        d.closedForm = 0;
    }
    const DosingFigures f = figuresOf(doses, 0.048, none);
    CHECK(nearRelative(f.rule.threshold, blockageRule(none, 3e-5).threshold, 1e-12));
    CHECK(f.rule.threshold > 0);
    CHECK(f.blocked == 3);
    for (Dose& d : doses) d.target = 0;  // neither tells how much should come
    CHECK(figuresOf(doses, 0.048, none).rule.threshold == 0);
}
