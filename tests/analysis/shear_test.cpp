// The shear cell, on a made-up yield locus.
#include "host/analysis/shear.h"

#include <cmath>

#include "host/core/vec.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr double kInner = 8e-3, kOuter = 16e-3;

/// Lines of 10 ms in which the powder has these stresses [Pa], evenly over the ring, by turns a little more and less.
std::vector<LidSample> lines(double from, double to, double normal, double shear, double ripple) {
    // Rings of width dr: force 2 pi r dr sigma, torque 2 pi r^2 dr tau.
    constexpr int kRings = 2000;
    double area = 0, moment = 0;
    for (int i = 0; i < kRings; ++i) {
        const double dr = (kOuter - kInner) / kRings, r = kInner + (i + 0.5) * dr;
        area += 2 * kPi * r * dr;
        moment += 2 * kPi * r * r * dr;
    }
    std::vector<LidSample> samples;
    const int count = int(std::lround((to - from) / 0.01));
    for (int i = 1; i <= count; ++i) {
        const double off = i % 2 == 0 ? ripple : -ripple;
        samples.push_back({from + 0.01 * i, area * (normal + off), -moment * (shear + off)});
    }
    return samples;
}

}  // namespace

TEST_CASE("stresses on the lid are the powder's, and the yield locus is the line through them") {
    const double friction = 35 * kPi / 180, cohesion = 120;
    std::vector<ShearPoint> points;
    for (const double normal : {500.0, 1000.0, 2000.0}) {
        const double shear = cohesion + std::tan(friction) * normal;
        auto samples = lines(0, 0.2, 77, 5, 0);  // before the window
        const auto counted = lines(0.2, 0.4, normal, shear, 10);
        samples.insert(samples.end(), counted.begin(), counted.end());
        const auto p = shearPoint(samples, 0.2 + 1e-9, 0.4 + 1e-9, kInner, kOuter);
        REQUIRE(p);
        CHECK(p->lines == 20);
        CHECK(nearRelative(p->normal, normal, 1e-6));  // the rings' width squared
        CHECK(nearRelative(p->shear, shear, 1e-6));
        CHECK(nearRelative(p->shearDeviation, 10 * std::sqrt(20.0 / 19), 1e-6));
        CHECK(nearRelative(p->normalDeviation, 10 * std::sqrt(20.0 / 19), 1e-6));
        points.push_back(*p);
    }
    const auto locus = yieldLocus(points);
    REQUIRE(locus);
    CHECK(nearRelative(locus->friction, friction, 1e-6));
    CHECK(nearRelative(locus->cohesion, cohesion, 1e-5));
    // sum(sigma tau) / sum(sigma^2) of the three: tan(phi) + c 3500 / (0.25e6 + 1e6 + 4e6).
    CHECK(nearRelative(std::tan(locus->effective), std::tan(friction) + cohesion * 3500 / 5.25e6, 1e-5));
}

TEST_CASE("one point gives a friction angle and no cohesion, none or equal loads give nothing") {
    const auto one = yieldLocus({{1000, 700, 0, 0, 5}});
    REQUIRE(one);
    CHECK(nearRelative(one->friction, std::atan(0.7), 1e-12));
    CHECK(std::isnan(one->cohesion));
    CHECK(one->effective == one->friction);
    CHECK_FALSE(yieldLocus({}));
    CHECK_FALSE(yieldLocus({{1000, 700, 0, 0, 5}, {1000, 800, 0, 0, 5}}));
    CHECK_FALSE(shearPoint(lines(0, 0.1, 1, 1, 0), 0.2, 0.3, kInner, kOuter));
}

TEST_CASE("a lid whose axis points to the powder has the same pressure") {
    std::vector<LidSample> samples = lines(0.2, 0.4, 1000, 500, 10), turned = samples;
    for (LidSample& s : turned) s.force = -s.force;
    for (std::vector<LidSample>* one : {&samples, &turned}) {
        makePressurePositive(*one);
        const auto p = shearPoint(*one, 0.2 + 1e-9, 0.4 + 1e-9, kInner, kOuter);
        REQUIRE(p);
        CHECK(nearRelative(p->normal, 1000, 0.05));
    }
}

TEST_CASE("ffc follows from the circles that touch the yield locus, wherever the steady flow lies on its own") {
    const double phi = 0.55, c = 300;
    for (const double centre : {3000.0, 9000.0})
        for (const double behind : {0.0, 0.2, 0.5}) {  // angle past the place of touch [rad]
            CAPTURE(centre, behind);
            const double radius = centre * std::sin(phi) + c * std::cos(phi), at = kPi / 2 + phi - behind;
            ShearPoint steady;
            steady.normal = centre + radius * std::cos(at);
            steady.shear = radius * std::sin(at) * (behind == 0 ? 1 - 1e-12 : 1);
            const auto f = flowability({phi, c, phi}, steady);
            REQUIRE(f);
            // At the place of touch itself the root vanishes, and rounding is magnified.
            CHECK(nearRelative(f->consolidation, centre + radius, 1e-5));
            CHECK(nearRelative(f->strength, 2 * c * std::tan(kPi / 4 + phi / 2), 1e-9));
            CHECK(nearRelative(f->ffc, f->consolidation / f->strength, 1e-12));
        }
    ShearPoint above;
    above.normal = 1000;
    above.shear = 1.01 * (c + 1000 * std::tan(phi));
    CHECK_FALSE(flowability({phi, c, phi}, above));
    CHECK_FALSE(flowability({phi, 0, phi}, {1000, 500}));
    CHECK_FALSE(flowability({phi, std::nan(""), phi}, {1000, 500}));
}

TEST_CASE("peaks are prorated by the shear stress of their own pre-shear") {
    const std::vector<LidSample> rising = lines(0, 0.1, 500, 400, 40);
    const auto point = shearPoint(rising, 0, 0.1, kInner, kOuter);
    REQUIRE(point);
    CHECK(nearRelative(point->peak, 440, 1e-3));
    const std::vector<ShearStage> stages{{{4000, 2000}, {1000, 0, 0, 0, 5, 900}},
                                         {{4000, 2200}, {2000, 0, 0, 0, 5, 1300}}};
    CHECK(meanPreShear(stages).shear == Approx(2100));
    const std::vector<ShearPoint> points = prorated(stages);
    CHECK(points[0].normal == 1000);
    CHECK(points[0].shear == Approx(900 * 2100.0 / 2000));
    CHECK(points[1].shear == Approx(1300 * 2100.0 / 2200));
}
