// Photographs drawn with a known surface: the profile must come back.

#include "host/photo/profile.h"

#include <leptonica/allheaders.h>

#include "tests/photo/drawing.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::photo;
using namespace vkdose::test;

namespace {

constexpr double kMmPerPixel = 0.2;

Reading reading() {
    Reading r;
    r.mmPerPixel = kMmPerPixel;
    return r;
}

/// The greatest distance of a height from the surface within half a pixel of its column: a step inside a column may be
/// seen at either end. In pixels; huge where powder is missing.
double worstError(const Surface& found, const Drawing& d, bool rearLeft = true) {
    double worst = 0;
    for (std::size_t i = 0; i < found.points.size(); ++i) {
        const double column = rearLeft ? double(i) : d.width - 1.0 - double(i);
        double low = 1e9, high = -1e9;
        for (int k = 0; k <= 10; ++k) {
            const double h = d.surface(column + k / 10.0);
            low = std::min(low, h);
            high = std::max(high, h);
        }
        if (!found.points[i].heightMm) return 1e9;
        const double height = *found.points[i].heightMm / kMmPerPixel;
        worst = std::max({worst, low - height, height - high});
    }
    return worst;
}

Surface surfaceIn(const Grey& grey, const Reading& r = reading()) {
    return surfaceOf(pictureOf(grey), r);
}

const std::function<double(double)> kLevel = [](double) { return 80.0; };
const std::function<double(double)> kStep = [](double x) { return x < 130 ? 60.0 : 110.0; };
const std::function<double(double)> kSine = [](double x) { return 90 + 25 * std::sin(2 * kPi * x / 150); };
const std::function<double(double)> kSlope = [](double x) { return 30 + 0.45 * x; };

}  // namespace

TEST_CASE("a clean picture gives the surface to the pixel") {
    // A pixel is powder or not, so its edge is off by half a pixel; the median of 3 x 3 rounds a crest by as much
    // again.
    for (const auto& surface : {kLevel, kStep, kSine, kSlope}) {
        Drawing d;
        d.surface = surface;
        CHECK(near(worstError(surfaceIn(draw(d)), d), 0, 1, 1.0));
    }
}

TEST_CASE("heights and places are in millimetres from the rear wall and the lowest point") {
    Drawing d;
    d.width = 100;
    d.height = 60;
    d.surface = [](double x) { return x < 40 ? 20.0 : 30.0; };
    Reading r;
    r.lengthMm = 50;  // of 100 pixels: 0.5 mm each
    const Surface left = surfaceIn(draw(d), r);
    REQUIRE(left.points.size() == 100);
    CHECK(near(left.points.front().zMm, 0.25, 0.5, 1e-12));
    CHECK(near(left.points.back().zMm, 49.75, 0.5, 1e-12));
    CHECK(near(left.points[10].heightMm.value(), 10, 0.5, 1e-12));
    CHECK(near(left.points[90].heightMm.value(), 15, 0.5, 1e-12));

    r.rearLeft = false;
    r.cornerZMm = 5;
    r.cornerHeightMm = -2;
    const Surface right = surfaceIn(draw(d), r);
    CHECK(near(right.points.front().zMm, 5.25, 0.5, 1e-12));
    CHECK(near(right.points[10].heightMm.value(), 13, 0.5, 1e-12));
    CHECK(near(right.points[90].heightMm.value(), 8, 0.5, 1e-12));
}

TEST_CASE("the region is cut out of the picture") {
    Drawing d;
    d.surface = kSlope;
    Grey grey = draw(d);
    blot(grey, 20, 20, 15, 5);  // outside the region, as dark as powder
    Reading r = reading();
    r.region = Region{100, 10, 150, 170};  // ends 20 pixels above the picture's lower edge
    const Surface s = surfaceIn(grey, r);
    REQUIRE(s.points.size() == 150);
    for (const int i : {5, 75, 145}) {
        const double expected = (kSlope(100 + i + 0.5) - 20) * kMmPerPixel;
        CHECK(near(s.points[std::size_t(i)].heightMm.value(), expected, kMmPerPixel, 1.0));
    }
}

TEST_CASE("noise, light from a side and from a corner, and their sum") {
    // Two pixels: one for the grid and the median as in the clean picture, one for what noise of a fifth to a third of
    // the contrast leaves of the edge.
    const auto side = [](double x, double) { return 0.45 + 0.85 * x; };
    const auto corner = [](double x, double y) { return 1.3 * std::exp(-1.1 * (x * x + (1 - y) * (1 - y))); };
    const auto above = [](double, double y) { return 1.2 - 0.7 * y; };
    for (const auto& light : std::vector<std::function<double(double, double)>>{side, corner, above}) {
        for (const auto& surface : {kStep, kSine, kSlope}) {
            for (const double noise : {0.0, 8.0}) {
                Drawing d;
                d.surface = surface;
                d.light = light;
                d.noise = noise;
                d.seed = 7;
                CHECK(near(worstError(surfaceIn(draw(d)), d), 0, 1, noise > 0 ? 2.0 : 1.0));
            }
        }
    }
    Drawing noisy;
    noisy.surface = kSine;
    noisy.noise = 25;
    CHECK(near(worstError(surfaceIn(draw(noisy)), noisy), 0, 1, 3.0));  // noise of a fifth of the contrast, no less
}

TEST_CASE("without evening the light out the same picture goes wrong") {
    Drawing d;
    d.surface = kSine;
    d.light = [](double x, double) { return 0.3 + 1.0 * x; };
    const Grey grey = draw(d);
    CHECK(near(worstError(surfaceIn(grey), d), 0, 1, 1.0));
    Reading r = reading();
    r.threshold = 125;  // half way between powder and background in even light; takes the picture as it is
    CHECK(worstError(surfaceIn(grey, r), d) > 20);
}

TEST_CASE("light powder before a dark wall, told or found") {
    Drawing d;
    d.surface = kSine;
    d.powder = 200;
    d.background = 40;
    for (const Powder told : {Powder::Automatic, Powder::Light}) {
        Reading r = reading();
        r.powder = told;
        const Surface s = surfaceIn(draw(d), r);
        CHECK(s.powder == Powder::Light);
        CHECK(near(worstError(s, d), 0, 1, 1.0));
    }
    Reading wrong = reading();
    wrong.powder = Powder::Dark;
    CHECK_THROWS_AS(surfaceIn(draw(d), wrong), PhotoError);
}

TEST_CASE("a threshold that is given is that of the picture's own greys") {
    Drawing d;
    d.surface = kSlope;
    Reading r = reading();
    r.threshold = 125;
    CHECK(near(worstError(surfaceIn(draw(d), r), d), 0, 1, 1.0));
    r.threshold = 60;  // nothing is darker than the powder's 60
    CHECK_THROWS_WITH(surfaceIn(draw(d), r), Catch::Contains("--powder"));
}

TEST_CASE("specks above, holes within, reflections on the powder and powder stuck to the window") {
    Drawing d;
    d.surface = kLevel;
    Grey grey = draw(d);
    for (int i = 0; i < 12; ++i) blot(grey, 10 + 24 * i, 20 + 5 * (i % 4), 1.6, 30);  // dust, below 1 mm
    blot(grey, 60, 150, 8, 255);                                                      // reflection
    blot(grey, 200, 170, 2, 190);                                                     // a hole
    blot(grey, 150, 40, 12, 60);  // stuck: large, but not of the bed
    CHECK(near(worstError(surfaceIn(grey), d), 0, 1, 1.0));
}

TEST_CASE("a column without powder, or with powder up to the region's edge, has no height") {
    Drawing d;
    d.surface = [](double x) { return x < 50 ? 250.0 : x < 200 ? 70.0 : std::nan(""); };
    const Surface s = surfaceIn(draw(d));
    CHECK_FALSE(s.points[20].heightMm);
    CHECK(s.points[100].heightMm);
    CHECK_FALSE(s.points[250].heightMm);
    CHECK(s.columnsCut == 50);
    const std::string csv = csvText(s);
    CHECK_THAT(csv, Catch::StartsWith("z_mm,height_mm\n0.1000,\n"));
    CHECK_THAT(csv, Catch::Contains("\n20.1000,14.0000\n"));
    CHECK_THAT(csv, Catch::EndsWith("\n59.9000,\n"));
}

TEST_CASE("a picture in which there is nothing to see is refused") {
    Drawing plain;
    plain.surface = [](double) { return std::nan(""); };
    CHECK_THROWS_WITH(surfaceIn(draw(plain)), Catch::Contains("contrast"));
    plain.noise = 3;
    CHECK_THROWS_WITH(surfaceIn(draw(plain)), Catch::Contains("contrast"));
    plain.light = [](double x, double y) { return 0.4 + 0.4 * x + 0.4 * y; };  // only light
    CHECK_THROWS_WITH(surfaceIn(draw(plain)), Catch::Contains("--roi"));
    plain.noise = 50;
    CHECK_THROWS_WITH(surfaceIn(draw(plain)), Catch::Contains("noise"));

    Drawing floats;  // powder that does not reach down
    Grey grey = draw(floats);
    for (int y = 150; y < 200; ++y)
        for (int x = 0; x < grey.width; ++x) grey.at(x, y) = 190;
    Reading r = reading();
    r.powder = Powder::Dark;
    CHECK_THROWS_WITH(surfaceIn(grey, r), Catch::Contains("lowest point"));
}

TEST_CASE("options that make no sense say what would") {
    const Grey grey = draw(Drawing{});
    Reading none;
    CHECK_THROWS_WITH(surfaceIn(grey, none), Catch::Contains("--mm-per-pixel"));
    Reading both = reading();
    both.lengthMm = 60;
    CHECK_THROWS_WITH(surfaceIn(grey, both), Catch::Contains("twice"));
    for (const double size : {0.0, -1.0, std::nan("")}) {
        Reading r;
        r.mmPerPixel = size;
        CHECK_THROWS_AS(surfaceIn(grey, r), PhotoError);
    }
    constexpr int kHuge = std::numeric_limits<int>::max();
    for (const Region region : {Region{-1, 0, 50, 50}, Region{0, 0, 301, 200}, Region{250, 0, 51, 200},
                                Region{0, 150, 50, 51}, Region{kHuge, kHuge, kHuge, kHuge}, Region{0, 0, kHuge, 20}}) {
        Reading r = reading();
        r.region = region;
        CHECK_THROWS_WITH(surfaceIn(grey, r), Catch::Contains("300 x 200"));
    }
    Reading small = reading();
    small.region = Region{0, 0, 7, 100};
    CHECK_THROWS_WITH(surfaceIn(grey, small), Catch::Contains("too small"));
}

TEST_CASE("the check picture shows the surface where it was found") {
    Drawing d;
    d.surface = kStep;
    const Picture photo = pictureOf(draw(d));
    const Surface s = surfaceOf(photo, reading());
    const Picture check = checkPicture(photo, s);
    REQUIRE(check.width() == 300);
    for (const int x : {50, 250}) {
        l_int32 r = 0, g = 0, b = 0;
        pixGetRGBPixel(check.pix(), x, s.edge[std::size_t(x)].value(), &r, &g, &b);
        CHECK(r == 255);
        CHECK(g == 0);
        pixGetRGBPixel(check.pix(), x, 195, &r, &g, &b);
        CHECK(r == g);
    }

    Drawing wide;
    wide.width = 4000;
    wide.height = 40;
    wide.surface = [](double) { return 20.0; };
    wide.edgeSamples = 1;
    const Picture large = pictureOf(draw(wide));
    CHECK(checkPicture(large, surfaceOf(large, reading())).width() == 1600);
}
