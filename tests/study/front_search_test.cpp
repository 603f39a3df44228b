// The search of a design, on functions that stand in for simulations.
#include "host/study/front_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "host/study/normal_distribution.h"
#include "tests/support/catch.h"

using namespace vkdose;

namespace {

using Wish = CalibrationTarget::Wish;
using Place = FrontPoint::Verdict;

CalibrationTarget goal(Wish wish, double atLeast = -INFINITY, double atMost = INFINITY) {
    CalibrationTarget t;
    t.wish = wish;
    t.atLeast = atLeast;
    t.atMost = atMost;
    return t;
}

CalibrationAim aimAt(std::vector<CalibrationTarget> goals, int maxRuns, std::size_t parameters) {
    CalibrationAim aim;
    aim.method = CalibrationAim::Method::Design;
    aim.targets = std::move(goals);
    aim.maxRuns = maxRuns;
    for (std::size_t i = 0; i < parameters; ++i) aim.parameters.push_back({"p" + std::to_string(i), 0, 1});
    return aim;
}

using Figures = std::vector<double>;

/// Trials of one seed of a function with a figure for each goal.
template <class F>
TryPoints once(const F& f) {
    return [f](const std::vector<Parameters>& points) {
        std::vector<Trials> all;
        for (const Parameters& p : points) {
            Trials& trials = all.emplace_back();
            for (const double x : f(p)) trials.push_back({{x}, 0});
        }
        return std::optional(all);
    };
}

/// The same again, as often as confirming runs are made.
template <class F>
ConfirmPoint again(const CalibrationAim& aim, const F& f) {
    return [&aim, f](const Parameters& p) {
        Trials trials;
        for (const double x : f(p)) trials.push_back({Figures(std::size_t(aim.confirmingSeeds), x), 0});
        return std::optional(trials);
    };
}

template <class F>
FrontResult found(const CalibrationAim& aim, const F& f) {
    return searchFront(aim, once(f), again(aim, f)).value();
}

/// Much comes at a price, and the second parameter wastes unless it is 0.3: the front is where it is.
Figures priced(const Parameters& p) {
    return {p[0], p[0] * p[0] + 4 * std::pow(p[1] - 0.3, 2)};
}

/// The area between the points and the corner (0, 2) of no gain and high price.
double areaOf(std::vector<Figures> points) {
    std::sort(points.begin(), points.end(), [](const Figures& a, const Figures& b) { return a[1] < b[1]; });
    double area = 0, reached = 0;
    for (const Figures& p : points) {
        if (p[1] >= 2) break;
        area += std::max(0.0, p[0] - reached) * (2 - p[1]);
        reached = std::max(reached, p[0]);
    }
    return area;
}

std::vector<Figures> figuresAt(const std::vector<Parameters>& points) {
    std::vector<Figures> all;
    for (const Parameters& p : points) all.push_back(priced(p));
    return all;
}

}  // namespace

TEST_CASE("the front between gain and price is found along its length, better than by points spread evenly") {
    const CalibrationAim aim = aimAt({goal(Wish::Largest), goal(Wish::Smallest)}, 25, 2);
    const FrontResult r = found(aim, priced);
    REQUIRE(r.points.size() == 25);
    REQUIRE(r.front.size() >= 4);
    CHECK(r.front.size() <= kMostOnFront);
    std::vector<Figures> front;
    for (const FrontPoint& p : r.front) {
        CHECK(p.verdict == Place::OnFront);
        CHECK(p.figures[0].value == r.points[p.point][0]);
        front.push_back({p.figures[0].value, p.figures[1].value});
    }
    for (std::size_t k = 1; k < front.size(); ++k) {  // along the first wish, each cheaper than the one before
        CHECK(front[k][0] < front[k - 1][0]);
        CHECK(front[k][1] < front[k - 1][1]);
    }
    CHECK(front.front()[0] > 0.9);
    CHECK(front.back()[1] < 0.1);
    // The true front has int_0^1 (2 - x^2) dx = 5/3.
    std::vector<Parameters> even;
    for (int i = 1; i <= 25; ++i) even.push_back(haltonPoint(i, 2));
    const double reached = areaOf(figuresAt(r.points)), spread = areaOf(figuresAt(even));
    CAPTURE(reached, spread);
    CHECK(5.0 / 3 - reached < 0.6 * (5.0 / 3 - spread));
    // It is the same search again.
    CHECK(found(aim, priced).points == r.points);
}

TEST_CASE("a design keeps its bounds, also where none of the first points does") {
    // Only a tenth of the range is allowed, far from the first points.
    const auto f = [](const Parameters& p) { return Figures{p[0], p[1], p[0] + p[1]}; };
    const CalibrationAim aim =
        aimAt({goal(Wish::Largest), goal(Wish::Smallest), goal(Wish::None, 1.6, INFINITY)}, 20, 2);
    for (const Parameters& p : found(aimAt(aim.targets, 5, 2), f).points) CHECK(p[0] + p[1] < 1.6);
    const FrontResult r = found(aim, f);
    REQUIRE(!r.front.empty());
    for (const FrontPoint& p : r.front) {
        CHECK(p.figures[2].value >= 1.6);
        CHECK(p.verdict == Place::OnFront);
    }
    CHECK(r.front.front().figures[0].value > 0.9);
    // A band has two bounds.
    for (const FrontPoint& p :
         found(aimAt({goal(Wish::Largest), goal(Wish::None, 0.45, 0.5)}, 15, 2), [](const Parameters& at) {
             return Figures{at[0], at[1]};
         }).front) {
        CHECK(p.figures[0].value > 0.9);
        CHECK(p.figures[1].value >= 0.45);
        CHECK(p.figures[1].value <= 0.5);
    }
    // A bound that no point keeps leaves no front.
    CHECK(found(aimAt({goal(Wish::Largest, 3), goal(Wish::None)}, 8, 2), [](const Parameters& p) {
              return Figures{p[0], p[1]};
          }).front.empty());
}

TEST_CASE("a single wish leads to its best point") {
    const auto f = [](const Parameters& p) { return Figures{std::pow(p[0] - 0.7, 2) + std::pow(p[1] - 0.2, 2)}; };
    const FrontResult r = found(aimAt({goal(Wish::Smallest)}, 20, 2), f);
    REQUIRE(r.front.size() == 1);
    CHECK(r.front[0].figures[0].value < 2e-3);
}

TEST_CASE("only runs with new seeds say what lies on the front") {
    const CalibrationAim aim = aimAt({goal(Wish::Largest, -INFINITY, 1.5), goal(Wish::Smallest)}, 5, 2);
    // All points are on the front by their first runs; then one is dominated, one breaks a bound, one has no figure.
    const auto first = [](const Parameters& p) { return Figures{p[0], p[0]}; };
    const auto then = [](const Parameters& p) -> std::optional<Trials> {
        if (p[0] == 0.25) return Trials{{{0.2, 0.2, 0.2}, 0}, {{0.6, 0.6, 0.6}, 0}};
        if (p[0] == 0.75) return Trials{{{2, 2, 2}, 0}, {{0.1, 0.1, 0.1}, 0}};
        if (p[0] == 0.125) return Trials{{{0.1, 0.1}, 0}, {{0.1, 0.1, 0.1}, 0}};
        return Trials{{{p[0], p[0], p[0]}, 0}, {{p[0], p[0], p[0]}, 0}};
    };
    const FrontResult r = searchFront(aim, once(first), then).value();
    const auto at = [&](double x) {
        const auto p = std::find_if(r.front.begin(), r.front.end(),
                                    [&](const FrontPoint& f) { return r.points[f.point][0] == x; });
        REQUIRE(p != r.front.end());
        return *p;
    };
    CHECK(at(0.25).verdict == Place::Dominated);
    CHECK(at(0.75).verdict == Place::OutOfBounds);
    CHECK(at(0.125).verdict == Place::Incomplete);
    CHECK(at(0.5).verdict == Place::OnFront);
    CHECK(at(0.25).figures[1].value == Approx(0.6));
    CHECK(r.values[1][at(0.25).point].value == 0.25);
    CHECK(verdictText(Place::OutOfBounds) == "out of bounds");
}

TEST_CASE("a design that is interrupted gives nothing") {
    const CalibrationAim aim = aimAt({goal(Wish::Largest), goal(Wish::Smallest)}, 8, 2);
    int left = 2;
    const TryPoints stops = [&](const std::vector<Parameters>& points) -> std::optional<std::vector<Trials>> {
        if (left-- == 0) return std::nullopt;
        return once(priced)(points);
    };
    CHECK_FALSE(searchFront(aim, stops, again(aim, priced)));
    const ConfirmPoint never = [](const Parameters&) { return std::optional<Trials>(); };
    CHECK_FALSE(searchFront(aim, once(priced), never));
}
