#include "host/sim/stop_rule.h"
#include "tests/support/catch.h"

using namespace vkdose;

namespace {

StopRule rule(StopRule::Kind kind) {
    StopRule r;
    r.kind = kind;
    return r;
}

/// Feeds doses until the judge ends the run; returns how many that took, 0 if it never did.
int dosesUntilOver(DoseJudge& judge, const std::vector<double>& masses) {
    int n = 0;
    for (const double m : masses) {
        ++n;
        if (judge.over(m, m > 0 ? 1 : 0, 100)) return n;
    }
    return 0;
}

}  // namespace

TEST_CASE("experiment rule: three consecutive doses together give at most 0.15 g") {
    DoseJudge judge(rule(StopRule::Kind::Experiment));
    CHECK(dosesUntilOver(judge, {4e-3, 0.1e-3, 0.04e-3, 0.02e-3, 0.02e-3, 0.02e-3}) == 5);  // 0.16 g, then 0.08 g
    CHECK(judge.reason() == StopReason::Experiment);
}

TEST_CASE("experiment rule: the change over the three doses counts, not each dose alone") {
    DoseJudge judge(rule(StopRule::Kind::Experiment));
    CHECK(dosesUntilOver(judge, {0.14e-3, 0.14e-3, 0.14e-3, 0.14e-3}) == 0);
}

TEST_CASE("experiment rule: a big dose between small ones starts the count anew") {
    DoseJudge judge(rule(StopRule::Kind::Experiment));
    CHECK(dosesUntilOver(judge, {0, 0, 3e-3, 0, 0, 0}) == 6);
}

TEST_CASE("simulation rule: not a single particle in three doses") {
    DoseJudge judge(rule(StopRule::Kind::Simulation));
    CHECK(dosesUntilOver(judge, {4e-3, 0, 0, 1e-6, 0, 0, 0, 0}) == 7);
    CHECK(judge.reason() == StopReason::Simulation);
}

TEST_CASE("simulation rule: rounding in the sums of an empty dose is not mass") {
    DoseJudge judge(rule(StopRule::Kind::Simulation));
    CHECK_FALSE(judge.over(1e-3, 5, 100));
    CHECK_FALSE(judge.over(1e-12, 0, 100));
    CHECK_FALSE(judge.over(-1e-12, 0, 100));
    CHECK(judge.over(1e-12, 0, 100));
}

TEST_CASE("a device that delivers first in dose 4 is not ended before, whatever rule looks at its doses") {
    for (const auto kind : {StopRule::Kind::Experiment, StopRule::Kind::Simulation}) {
        StopRule r = rule(kind);
        DoseJudge open(r);
        CHECK(dosesUntilOver(open, {0, 0, 0, 4e-3, 4e-3, 0, 0, 0, 0}) == 8);
        CHECK(stopKeyword(open.reason()) ==
              stopKeyword(kind == StopRule::Kind::Experiment ? StopReason::Experiment : StopReason::Simulation));
        r.maxDoses = 6;
        DoseJudge counted(r);
        CHECK(dosesUntilOver(counted, {0, 0, 0, 4e-3, 4e-3, 4e-3, 4e-3}) == 6);
        CHECK(counted.reason() == StopReason::Doses);
    }
}

TEST_CASE("a run in which nothing ever comes makes the doses asked for, and without a number it ends all the same") {
    const std::vector<double> nothing(100, 0.0);
    StopRule r = rule(StopRule::Kind::Experiment);
    DoseJudge endless(r);
    CHECK(dosesUntilOver(endless, nothing) == 30);  // ten times the three doses of the rule
    CHECK(endless.reason() == StopReason::Experiment);
    StopRule timed = r;
    timed.endTime = 1000;
    DoseJudge untilThen(timed);
    CHECK(dosesUntilOver(untilThen, nothing) == 0);
    r.maxDoses = 50;
    DoseJudge fifty(r);
    CHECK(dosesUntilOver(fifty, nothing) == 50);
    CHECK(fifty.reason() == StopReason::Doses);
}

TEST_CASE("a run that a rule ended is over by the same rule, and open by another one") {
    StopRule r = rule(StopRule::Kind::Experiment);
    DoseJudge ended(r);
    REQUIRE(dosesUntilOver(ended, {4e-3, 0, 0, 0}) == 4);
    Record record;
    ended.save(record);
    const auto over = [&](const StopRule& other) {
        DoseJudge judge(other);
        judge.restore(record);
        return judge.ends(100);
    };
    CHECK(over(r));
    r.doses = 4;
    CHECK_FALSE(over(r));
    r.maxDoses = 4;
    CHECK(over(r));
    r.maxDoses = 5;
    CHECK_FALSE(over(r));
    CHECK_FALSE(over(rule(StopRule::Kind::None)));
}

TEST_CASE("the number of doses in a row is the case's") {
    StopRule r = rule(StopRule::Kind::Simulation);
    r.doses = 1;
    DoseJudge judge(r);
    CHECK(dosesUntilOver(judge, {4e-3, 4e-3, 0}) == 3);
}

TEST_CASE("a resumed run that is to look at fewer doses looks at the last ones") {
    StopRule r = rule(StopRule::Kind::Simulation);
    r.doses = 12;
    DoseJudge before(r);
    REQUIRE_FALSE(before.over(1e-3, 5, 5));
    for (int i = 0; i < 9; ++i) REQUIRE_FALSE(before.over(0, 0, 5));
    Record record;
    before.save(record);
    r.doses = 3;
    DoseJudge after(r);
    after.restore(record);
    CHECK(after.over(0, 0, 5));
}

TEST_CASE("without a rule on mass only the dose count and emptiness end a run") {
    StopRule r = rule(StopRule::Kind::None);
    DoseJudge endless(r);
    CHECK(dosesUntilOver(endless, std::vector<double>(50, 0.0)) == 0);
    r.maxDoses = 4;
    DoseJudge four(r);
    CHECK(dosesUntilOver(four, std::vector<double>(50, 0.0)) == 4);
    CHECK(four.reason() == StopReason::Doses);
    DoseJudge empty(r);
    CHECK_FALSE(empty.over(4e-3, 7, 1));
    CHECK(empty.over(4e-3, 1, 0));
    CHECK(empty.reason() == StopReason::Empty);
}

TEST_CASE("a mass that is not a number does not end a run as if nothing had come") {
    DoseJudge judge(rule(StopRule::Kind::Experiment));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (int i = 0; i < 5; ++i) CHECK_FALSE(judge.over(nan, 1, 100));
}

TEST_CASE("every reason has a keyword and a sentence") {
    for (int i = 0; i <= static_cast<int>(StopReason::DeviceError); ++i) {
        const auto reason = static_cast<StopReason>(i);
        CHECK(stopKeyword(reason) != "unknown");
        CHECK(stopSentence(reason, StopRule{}) != "unknown");
    }
    CHECK_THAT(stopSentence(StopReason::Experiment, StopRule{}), Catch::Contains("3 doses") && Catch::Contains("0.15"));
    StopRule one;
    one.maxDoses = 1;
    CHECK(stopSentence(StopReason::Doses, one) == "the dose asked for is done");
}
