// `vkdose profile` as a user meets it.

#include "host/photo/profile.h"
#include "tests/app/sandbox.h"
#include "tests/photo/drawing.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// A bed that rises from 20 mm at the left to 30 mm at the right, 0.2 mm to a pixel.
void writePhoto(const Sandbox& box) {
    Drawing d;
    d.surface = [](double x) { return 100 + x / 6; };
    box.write("bed.png", photo::pngBytes(photo::pictureOf(draw(d))));
}

}  // namespace

TEST_CASE("profile writes the surface and the picture to judge it by") {
    const Sandbox box;
    writePhoto(box);
    const auto o = box.vkdose("profile bed.png --length-mm 60 --out surface.csv --check check.png");
    CAPTURE(o.err);
    REQUIRE(o.code == 0);
    CHECK(o.err.empty());
    CHECK_THAT(o.out, Catch::Contains("dark powder in 300 of 300 columns") && Catch::Contains("surface.csv"));
    const auto rows = readCsv(box / "surface.csv");
    REQUIRE(rows.size() == 301);
    CHECK(rows[0] == std::vector<std::string>{"z_mm", "height_mm"});
    CHECK(near(std::stod(rows[1][1]), 20, 0.2, 1));
    CHECK(near(std::stod(rows[300][1]), 30, 0.2, 1));
    CHECK(photo::readPicture(box / "check.png").width() == 300);

    // The right half, its rear wall on the right, 5 mm from there and 2 mm above the lowest point.
    const auto half = box.vkdose(
        "profile bed.png --mm-per-pixel 0.2 --roi 150,0,150,200 --rear right --corner-mm 5,2 --powder dark "
        "--threshold 125 --speck-mm 0.5");
    REQUIRE(half.code == 0);
    const auto mirrored = readCsv(box / "profile.csv");
    REQUIRE(mirrored.size() == 151);
    CHECK(mirrored[1][0] == "5.1000");
    CHECK(near(std::stod(mirrored[1][1]), 32, 0.2, 1));
    CHECK(near(std::stod(mirrored[150][1]), 27, 0.2, 1));
}

TEST_CASE("profile reads the mean of several photographs, and tells the slope") {
    const Sandbox box;
    std::string names;
    for (const int i : {0, 1, 2, 3, 4}) {
        Drawing d;
        d.surface = [&](double x) { return 60 + 8 * i + x / 2; };  // the middle one at 76 pixels
        box.write(std::to_string(i) + ".png", photo::pngBytes(photo::pictureOf(draw(d))));
        names += std::to_string(i) + ".png ";
    }
    const auto o = box.vkdose("profile " + names + "--mm-per-pixel 0.2 --roi 50,0,100,200");
    CAPTURE(o.out, o.err);
    REQUIRE(o.code == 0);
    CHECK_THAT(o.out, Catch::Contains("at 26.57° to the horizontal, rising to the right"));
    const auto rows = readCsv(box / "profile.csv");
    REQUIRE(rows.size() == 101);
    CHECK(near(std::stod(rows[1][1]), 0.2 * (76 + 25), 0.2, 1));

    box.write("small.png", photo::pngBytes(photo::pictureOf(photo::Grey(40, 30))));
    const auto mixed = box.vkdose("profile 0.png small.png --mm-per-pixel 0.2");
    CHECK(mixed.code == 2);
    CHECK_THAT(mixed.err,
               Catch::Contains("small.png has 40 x 30 pixels, 0.png has 300 x 200; give photographs of one"));
    CHECK_THAT(box.vkdose("profile 0.png 1.png --mm-per-pixel 1 --out 1.png").err, Catch::Contains("1.png"));
}

TEST_CASE("profile refuses what it cannot read, and writes nothing") {
    const Sandbox box;
    writePhoto(box);
    box.write("cut.png", readText(box / "bed.png").substr(0, 300));
    box.write("empty.png", "");
    struct Bad {
        const char* arguments;
        const char* says;
    };
    for (const Bad& bad :
         {Bad{"none.png --mm-per-pixel 1", "none.png"}, Bad{"cut.png --mm-per-pixel 1", "cut off"},
          Bad{"empty.png --mm-per-pixel 1", "empty"}, Bad{"bed.png", "--length-mm"},
          Bad{"bed.png --mm-per-pixel 1 --length-mm 1", "excludes"}, Bad{"bed.png --mm-per-pixel 0", "above zero"},
          Bad{"bed.png --mm-per-pixel nan", "above zero"}, Bad{"bed.png --mm-per-pixel 1 --roi 1,2,3", "--roi"},
          Bad{"bed.png --mm-per-pixel 1 --roi 1,2,3,4,5", "--roi"},
          Bad{"bed.png --mm-per-pixel 1 --roi 0,0,301,200", "300 x 200"},
          Bad{"bed.png --mm-per-pixel 1 --roi 0,0,300,40", "contrast"},
          Bad{"bed.png --mm-per-pixel 1 --threshold 256", "--threshold"},
          Bad{"bed.png --mm-per-pixel 1 --powder green", "--powder"},
          Bad{"bed.png --mm-per-pixel 1 --rear top", "--rear"},
          Bad{"bed.png --mm-per-pixel 1 --speck-mm -1", "--speck-mm"}}) {
        const auto o = box.vkdose(std::string("profile ") + bad.arguments);
        CAPTURE(bad.arguments, o.err);
        CHECK(o.code == 2);
        CHECK_THAT(o.err, Catch::Contains(bad.says));
        CHECK(o.out.empty());
    }
    CHECK(box.files().size() == 3);
    CHECK(box.vkdose("profile bed.png --mm-per-pixel 1 --out no/such/folder.csv").code == 5);
}
