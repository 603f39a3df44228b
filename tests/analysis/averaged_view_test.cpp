// The mean of photographs of the powder, of spheres whose outline is known.
#include "host/analysis/averaged_view.h"

#include <algorithm>
#include <cmath>

#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr double kPixel = 0.1e-3;

Particles sphere(double x, double y, double radius, double z = 0) {
    Particles p;
    p.add({x, y, z}, radius);
    return p;
}

/// Columns in which the surface is not within `tolerance` [m] of the upper half of this circle, or is where it is not.
int wrongColumns(const AveragedView& view, double x, double y, double radius, double tolerance) {
    int wrong = 0;
    const auto surface = view.surface();
    for (int c = 0; c < view.columns(); ++c) {
        const double dx = view.x(c) - x;
        const auto& height = surface.at(std::size_t(c));
        if (std::abs(dx) > radius)
            wrong += height ? 1 : 0;
        else
            wrong += height && std::abs(*height - y - std::sqrt(radius * radius - dx * dx)) <= tolerance ? 0 : 1;
    }
    return wrong;
}

bool isEmpty(const AveragedView& view) {
    const auto surface = view.surface();
    return std::all_of(surface.begin(), surface.end(), [](const auto& height) { return !height; });
}

}  // namespace

TEST_CASE("the columns of a view fill its width exactly, whatever the pixel") {
    const AveragedView view(10e-3, 0.37e-3);
    CHECK(view.columns() == 54);
    CHECK(near(view.x(0) - view.pixel() / 2, -10e-3, 10e-3, 1e-12));
    CHECK(near(view.x(53) + view.pixel() / 2, 10e-3, 10e-3, 1e-12));
    CHECK(isEmpty(view));
}

TEST_CASE("one photograph of a sphere shows its outline, also one that the view cuts") {
    for (const double x : {0.0, 2.3e-3, -4.9e-3, 6.0e-3}) {
        CAPTURE(x);
        AveragedView view(5e-3, kPixel);
        view.add(sphere(x, -3e-3, 2e-3));
        // Half a pixel: that of the rows, whose middles are asked.
        CHECK(wrongColumns(view, x, -3e-3, 2e-3, 0.5001 * kPixel) == 0);
    }
}

TEST_CASE("a sphere that is farther from the glass counts where nothing stands before it, and dosed ones never") {
    AveragedView view(5e-3, kPixel);
    Particles p = sphere(0, 0, 1e-3);
    p.append(sphere(0.5e-3, 0, 2e-3, -50e-3));
    p.append(sphere(0, 3e-3, 2e-3));
    p.status.back() = Status::Dosed;
    view.add(p);
    CHECK(view.photographs() == 1);
    CHECK(wrongColumns(view, 0.5e-3, 0, 2e-3, 0.5001 * kPixel) == 0);
}

TEST_CASE("the surface is where half of the photographs show powder") {
    // Heights of a wide sphere's top; the median is the answer, not the mean.
    const auto topOf = [](const std::vector<double>& heights) {
        AveragedView view(0.5e-3, kPixel);
        for (const double h : heights) view.add(sphere(0, h - 1, 1));
        return view.surface().at(5).value();
    };
    CHECK(near(topOf({1e-3, 1.2e-3, 9e-3}), 1.2e-3, kPixel, 0.51));
    CHECK(near(topOf({9e-3, -5e-3, 1.2e-3, 1e-3, 1.4e-3}), 1.2e-3, kPixel, 0.51));
    // Of an even number it lies under the upper one of the middle two, where the share falls below a half.
    CHECK(near(topOf({1e-3, 2e-3}), 2e-3, kPixel, 0.51));
    // Evenly spread over ten pixels the share falls by 0.1 from pixel to pixel: then the line between pixels is exact.
    std::vector<double> spread;
    for (int i = 0; i < 1000; ++i) spread.push_back(1e-3 + 1e-6 * (i + 0.5));
    CHECK(near(topOf(spread), 1.5e-3, kPixel, 0.02));
}

TEST_CASE("two spheres in one place of one photograph are one photograph of powder") {
    AveragedView view(3e-3, kPixel);
    Particles twice = sphere(0, 0, 2e-3);
    twice.append(sphere(0, 0, 2e-3));
    view.add(twice);
    view.add(Particles());
    view.add(Particles());
    CHECK(isEmpty(view));
}

TEST_CASE("what lies alone is no part of the bed") {
    AveragedView view(10e-3, kPixel);
    Particles p = sphere(0, 0, 3e-3);
    p.append(sphere(-4e-3, 7e-3, 1e-3));  // stuck above
    p.append(sphere(8e-3, -5e-3, 1e-3));  // rolled away, and lower
    view.add(p);
    CHECK(wrongColumns(view, 0, 0, 3e-3, 0.5001 * kPixel) == 0);
}
