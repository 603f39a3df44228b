#include "host/study/leave_one_out.h"

#include <cmath>
#include <vector>

#include "host/core/random.h"
#include "host/core/vec.h"
#include "tests/support/catch.h"

using namespace vkdose;

namespace {

/// Of the standard normal distribution.
double normal(std::uint64_t index) {
    const auto [u, v] = uniforms(4, Stream::Jitter, index);
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * kPi * v);
}

struct Observations {
    std::vector<std::vector<double>> points;
    std::vector<Measured> values;
};

/// A wave over a plane, with errors that are known and differ.
Observations wave(std::size_t count) {
    Observations all;
    for (std::size_t i = 0; i < count; ++i) {
        const auto [x, y] = uniforms(9, Stream::Jitter, i);
        const double error = 0.05 + 0.1 * x;
        all.points.push_back({x, y});
        all.values.push_back({40 + 3 * std::sin(4 * x) + y + error * normal(i), error});
    }
    return all;
}

Observations without(Observations all, std::size_t i) {
    all.points.erase(all.points.begin() + std::ptrdiff_t(i));
    all.values.erase(all.values.begin() + std::ptrdiff_t(i));
    return all;
}

}  // namespace

TEST_CASE("what is left out is predicted as by a process that never saw it") {
    const Observations all = wave(17);
    const GaussianProcess process(all.points, all.values);
    const ProcessKernel& kernel = process.kernel();
    const std::vector<LeftOut> closed = process.leftOut();
    REQUIRE(closed.size() == 17);
    for (std::size_t i = 0; i < closed.size(); ++i) {
        const Observations others = without(all, i);
        const Belief belief = GaussianProcess(others.points, others.values, kernel).at(all.points[i]);
        const double noise = kernel.noise * kernel.scale * kernel.scale + std::pow(all.values[i].error, 2);
        CAPTURE(i, belief.mean, belief.deviation);
        // In units of the observations' spread, 2 or so. One matrix is solved in place of 17.
        CHECK(closed[i].observed == Approx(all.values[i].value).epsilon(1e-12));
        CHECK(std::abs(closed[i].predicted.mean - belief.mean) < 1e-8 * kernel.scale);
        CHECK(std::abs(closed[i].predicted.deviation - std::hypot(belief.deviation, std::sqrt(noise))) <
              1e-8 * kernel.scale);
    }
}

TEST_CASE("a process with a given kernel is the one that found this kernel") {
    const Observations all = wave(11);
    const GaussianProcess found(all.points, all.values), given(all.points, all.values, found.kernel());
    for (const double x : {0.1, 0.7}) {
        CHECK(given.at({x, 0.4}).mean == found.at({x, 0.4}).mean);
        CHECK(given.at({x, 0.4}).deviation == found.at({x, 0.4}).deviation);
    }
}

TEST_CASE("leave-one-out: the figures of three observations by hand") {
    // Off by 1, -2 and 0 with deviations of 2, 1 and 1; the observations 10, 14 and 12 vary by 8.
    const LeaveOneOut all = leaveOneOut({{10, {9, 2}}, {14, {16, 1}}, {12, {12, 1}}});
    CHECK(all.points == 3);
    CHECK(all.error == Approx(std::sqrt(5.0 / 3)).epsilon(1e-12));
    CHECK(all.standardised == Approx(std::sqrt(4.25 / 3)).epsilon(1e-12));
    CHECK(all.largest == Approx(2).epsilon(1e-12));
    CHECK(all.predictiveR2 == Approx(1 - 5.0 / 8).epsilon(1e-12));
    CHECK(std::isnan(leaveOneOut({{7, {7, 1}}, {7, {7, 1}}}).predictiveR2));
}

TEST_CASE("leave-one-out tells a surrogate that is too sure, too careful or blind from an honest one") {
    using Honesty = LeaveOneOut::Verdict;
    const auto of = [](double standardised, double r2) { return LeaveOneOut{9, 1, standardised, 2, r2}.verdict(); };
    CHECK(of(1, 0.9) == Honesty::Honest);
    CHECK(of(1.9, 0.6) == Honesty::Honest);
    CHECK(of(2.1, 0.9) == Honesty::Overconfident);
    CHECK(of(0.4, 0.9) == Honesty::Cautious);
    CHECK(of(1, 0.4) == Honesty::Blind);
    CHECK(of(1, -0.1) == Honesty::Blind);
    CHECK(of(0.4, 0.4) == Honesty::Blind);
    CHECK(of(2.1, -1) == Honesty::Overconfident);
    CHECK(of(1, std::nan("")) == Honesty::Blind);
    CHECK(of(std::nan(""), 0.9) == Honesty::Overconfident);
}

TEST_CASE("a process through a wave with known errors is honest, one through mere noise is blind") {
    const Observations all = wave(40);
    const LeaveOneOut honest = leaveOneOut(GaussianProcess(all.points, all.values).leftOut());
    CAPTURE(honest.standardised, honest.predictiveR2);
    CHECK(honest.verdict() == LeaveOneOut::Verdict::Honest);
    // Of 40 independent errors the root mean square is within a fifth of 1 in 93 of 100 cases.
    CHECK(std::abs(honest.standardised - 1) < 0.2);
    CHECK(honest.predictiveR2 > 0.95);

    Observations noise = all;
    for (std::size_t i = 0; i < noise.values.size(); ++i) noise.values[i] = {normal(100 + i), 0};
    const LeaveOneOut blind = leaveOneOut(GaussianProcess(noise.points, noise.values).leftOut());
    CAPTURE(blind.standardised, blind.predictiveR2);
    CHECK(blind.verdict() == LeaveOneOut::Verdict::Blind);
}
