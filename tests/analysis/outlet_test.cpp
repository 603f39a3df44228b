// Stops of the outlet, from time series in which they are easy to see.
#include "host/analysis/outlet.h"

#include <numbers>
#include <string>

#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using vkdose::test::near;
using vkdose::test::Verdict;

namespace {

constexpr double kLine = 0.1;   // between two lines [s]
constexpr double kFill = 0.05;  // [kg]

/// A line for each character: 's' settling, 'x' turning with a gram coming out, '-' turning with nothing, '.' rest, 'o'
/// rest with a gram. The coil makes a turn a second.
std::vector<FlowSample> series(const std::string& lines, double inside = kFill) {
    std::vector<FlowSample> samples;
    FlowSample s;
    s.inside = inside;
    for (const char c : lines) {
        const bool turns = c == 'x' || c == '-';
        if (turns && !s.turning) ++s.dose;
        s.turning = turns;
        s.time += kLine;
        if (turns) s.angle += 2 * std::numbers::pi * kLine;
        if (c == 'x' || c == 'o') {
            s.dosed += 1e-3;
            s.inside -= 1e-3;
        }
        samples.push_back(s);
    }
    return samples;
}

OutletFlow flowOf(const std::string& lines) {
    return outletFlow(series(lines), kFill);
}

/// Times are sums of lines: rounding.
Verdict same(double a, double b) {
    return near(a, b, kLine, 1e-9);
}

}  // namespace

TEST_CASE("a stop goes on over a rest, which does not count, the coil's filling is none") {
    const OutletFlow flow = flowOf("ss---xxx--...----xxx");
    CHECK(same(flow.lead.value(), 0.4));  // up to the line in which something had come
    CHECK(flow.longest.dose == 1);
    CHECK(same(flow.longest.start, 0.8));
    CHECK(same(flow.longest.time, 0.6));
    CHECK(same(flow.longest.turns, 0.6));
    CHECK_FALSE(flow.stoppedAt);
    REQUIRE(flow.longestIn.size() == 2);
    CHECK(same(flow.longestIn.at(1), 0.2));
    CHECK(same(flow.longestIn.at(2), 0.4));
}

TEST_CASE("a stop of more than a turn counts as stopped, from the dose in which it began") {
    CHECK_FALSE(flowOf("x----------x").stoppedAt);  // just a turn
    const OutletFlow flow = flowOf("xx.xxx---..--------x..xx------------x");
    CHECK(flow.stoppedAt == 2);
    CHECK(flow.longest.dose == 4);
    CHECK(same(flow.longest.time, 1.2));
    CHECK(same(flow.longestIn.at(3), 0.8));
}

TEST_CASE("what falls out at rest ends a stop, the longest of several in a dose counts") {
    const OutletFlow flow = flowOf("x---x-.o.----x--");
    CHECK(same(flow.longest.time, 0.4));
    CHECK(flow.longest.dose == 2);
    CHECK(same(flow.longestIn.at(1), 0.3));
    CHECK(same(flow.longestIn.at(2), 0.4));
}

TEST_CASE("an outlet from which nothing ever came has stopped from the start, an empty canister has not") {
    const OutletFlow never = flowOf("s--------..--------");
    CHECK_FALSE(never.lead);
    CHECK(same(never.longest.time, 1.6));
    CHECK(never.stoppedAt == 1);
    CHECK(outletFlow(series("x----------------", 0.01 * kFill), kFill).longest.dose == 0);
    CHECK(flowOf("sss").longest.dose == 0);
    CHECK(outletFlow({}, kFill).longest.dose == 0);
    // Powder that fell out while settling counts as out.
    CHECK(same(flowOf("o--x").lead.value(), 0));
}

TEST_CASE("the lines of a time series by their columns") {
    Table table({"dose", "time_s", "phase", "coil_angle_rad", "dosed_mass_kg", "canister_mass_kg", "throat_mass_kg"});
    table.add({"2", "0.5", "rotate", "3", "0.01", "0.02", "0.005"});
    table.add({"2", "0.6", "rest", "3", "0.01", "0.02", "0.005"});
    const std::vector<FlowSample> samples = flowSamples(table);
    REQUIRE(samples.size() == 2);
    CHECK(samples[0].turning);
    CHECK_FALSE(samples[1].turning);
    CHECK(samples[0].dose == 2);
    CHECK(samples[0].time == 0.5);
    CHECK(samples[0].angle == 3);
    CHECK(samples[0].dosed == 0.01);
    CHECK(near(samples[0].inside, 0.025, 0.025, 1e-12));  // a sum of two numbers
}

TEST_CASE("what another run dosed, whose powder a run takes, is not the first powder of this one") {
    // Its first line is the state that the other's doses left, before the coil turns.
    std::vector<FlowSample> before = series("s--xx."), after = series("--xx--");
    FlowSample first = before.back();
    first.dose = 0;
    for (FlowSample& s : after) {
        s.time += first.time;
        s.angle += first.angle;
        s.dosed += first.dosed;
    }
    after.insert(after.begin(), first);
    const OutletFlow flow = outletFlow(after, kFill);
    CHECK(same(flow.lead.value(), 0.3));
    CHECK(flow.longest.dose == 1);
    CHECK(same(flow.longest.time, 0.2));
    CHECK(same(flow.longest.start, first.time + 0.4));
    // Nothing at all in this run: its whole rotation is a stop.
    std::vector<FlowSample> never(after.begin(), after.begin() + 3);
    CHECK_FALSE(outletFlow(never, kFill).lead);
    CHECK(same(outletFlow(never, kFill).longest.turns, 0.2));
}
