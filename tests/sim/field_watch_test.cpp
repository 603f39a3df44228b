// Fields that a run takes: when, averaged over what, and across an interruption.
#include "host/sim/field_watch.h"

#include <cmath>

#include "tests/sim/fake_backend.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// smallCase (settles 100 steps, turns 50, rests 20; sensors every 30) with a field of three points over z.
Case caseWith(double interval, bool average, FieldSensor::Preset preset = FieldSensor::Preset::None) {
    Case c = smallCase();
    FieldSensor s;
    s.name = "f";
    s.preset = preset;
    s.request.grid = {Vec3(0), Vec3(0.01, 0.06, 0.03), {1, 1, 3}};
    s.request.width = 0.01;
    s.interval = interval;
    s.average = average;
    c.fields.push_back(s);
    return c;
}

/// Density that counts the steps.
FieldPoint counting(std::uint64_t step) {
    FieldPoint p;
    p.density = double(step);
    p.momentum = Vec3(0, 0, 2 * double(step));
    p.contactStress[2].y = -double(step);
    return p;
}

struct Keeper : Notebook {
    std::vector<FieldSample> fields;
    std::optional<RunCheckpoint> checkpoint;  ///< the last
    std::size_t keptThen = 0;
    void onField(const FieldSample& f) override { fields.push_back(f); }
    void onCheckpoint(const RunCheckpoint& c, double) override {
        checkpoint = c;
        keptThen = fields.size();
    }
    bool storesCheckpoints() const override { return true; }
};

RunResult run(const Case& c, FakeBackend& backend, Keeper& keeper, const RunCheckpoint* from = nullptr) {
    const std::atomic<bool> stop{false};
    return runFilled(c, smallFilling(), {}, backend, keeper, stop, from);
}

std::vector<std::uint64_t> stepsOf(const std::vector<FieldSample>& fields) {
    std::vector<std::uint64_t> steps;
    for (const FieldSample& f : fields) steps.push_back(f.step);
    return steps;
}

}  // namespace

TEST_CASE("fields are taken at whole sensor intervals, not at ends of phases") {
    FakeBackend backend;
    backend.field = counting;
    Keeper keeper;
    run(caseWith(0.06, false), backend, keeper);
    CHECK(stepsOf(keeper.fields) == std::vector<std::uint64_t>{60, 120, 180, 240, 300});
    CHECK(backend.fieldCalls == 5);
    CHECK(keeper.fields[1].points.size() == 3);
    CHECK(keeper.fields[1].points[2].density == 120);
    CHECK(keeper.fields[1].number == 1);
    CHECK(keeper.fields[1].phase == Phase::Rotate);
    CHECK(keeper.fields[1].time == Approx(0.12));
}

TEST_CASE("an average is over the sensor intervals since the one before") {
    FakeBackend backend;
    backend.field = counting;
    Keeper keeper;
    run(caseWith(0.09, true), backend, keeper);
    REQUIRE(stepsOf(keeper.fields) == std::vector<std::uint64_t>{90, 180, 270});
    for (const FieldSample& f : keeper.fields) {
        const double mean = double(f.step) - 30;  // of three, 30 steps apart
        CHECK(nearRelative(f.points[1].density, mean, 1e-15));
        CHECK(nearRelative(f.points[1].velocity().z, 2, 1e-15));
        CHECK(nearRelative(f.points[1].contactStress[2].y, -mean, 1e-15));
    }
}

TEST_CASE("a height profile begins when settling ends, and follows the density from there") {
    Case c = caseWith(0.06, false, FieldSensor::Preset::HeightProfile);
    c.fields[0].initialHeight = 0.04;
    FakeBackend backend;
    backend.field = [](std::uint64_t step) {
        FieldPoint p;
        p.density = 500 - double(step);
        return p;
    };
    Keeper keeper;
    run(c, backend, keeper);
    REQUIRE(stepsOf(keeper.fields) == std::vector<std::uint64_t>{100, 120, 180, 240, 300});
    for (const FieldSample& f : keeper.fields)
        CHECK(nearRelative(f.heights.at(1), 0.04 * (500 - double(f.step)) / 400, 1e-14));
    CHECK(backend.fieldCalls == 5);

    c.fields[0].initialHeight = 0;  // from the density: here it is the same up to the top of the grid
    FakeBackend full;
    full.field = backend.field;
    Keeper other;
    run(c, full, other);
    CHECK(full.fieldCalls == 6);
    CHECK(near(other.fields.at(0).heights.at(0), 0.06, 0.06, 0.05));

    FakeBackend empty;
    Keeper none;
    run(c, empty, none);
    CHECK(std::isnan(none.fields.at(1).heights.at(0)));
}

TEST_CASE("the surface is where the density has risen to half of its largest value") {
    const FieldGrid grid{Vec3(0, -1, 0), Vec3(1, 9, 1), {1, 10, 1}};
    FieldPoints points(10);
    CHECK(surfaceHeight(grid, points) == 0);
    for (std::size_t n = 0; n < 6; ++n) points[n].density = 400;
    points[6].density = 100;
    CHECK(nearRelative(surfaceHeight(grid, points), 5.5 + 200.0 / 300, 1e-14));
    points[9].density = 300;  // a heap at the very top
    CHECK(nearRelative(surfaceHeight(grid, points), 9.5, 1e-14));
}

TEST_CASE("a run that goes on from a checkpoint keeps the same fields, averages under way included") {
    const bool profile = GENERATE(false, true);
    Case c = caseWith(0.09, true, profile ? FieldSensor::Preset::HeightProfile : FieldSensor::Preset::None);
    c.checkpoint.wall = 0;
    c.checkpoint.simulated = 0.125;  // the first within an average
    FakeBackend whole;
    whole.field = counting;
    Keeper all;
    run(c, whole, all);
    REQUIRE(all.fields.size() > 2);

    FakeBackend first;
    first.field = counting;
    first.runErrorAt = 150;
    Keeper before;
    run(c, first, before);
    REQUIRE(before.checkpoint);
    REQUIRE(before.keptThen < all.fields.size());
    FakeBackend second;
    second.field = counting;
    Keeper after;
    run(c, second, after, &*before.checkpoint);
    std::vector<FieldSample> joined(before.fields.begin(), before.fields.begin() + std::ptrdiff_t(before.keptThen));
    joined.insert(joined.end(), after.fields.begin(), after.fields.end());
    REQUIRE(stepsOf(joined) == stepsOf(all.fields));
    for (std::size_t n = 0; n < joined.size(); ++n) {
        CHECK(joined[n].number == all.fields[n].number);
        CHECK(joined[n].heights == all.fields[n].heights);
        for (std::size_t k = 0; k < 3; ++k) CHECK(joined[n].points[k].numbers() == all.fields[n].points[k].numbers());
    }
}
