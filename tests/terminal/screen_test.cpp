// The picture of a run on a terminal, counted in pixels and characters.

#include "host/terminal/screen.h"
#include "host/model/body_mesh.h"

#include <cmath>

#include "host/terminal/pace.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::terminal;
using namespace vkdose::test;

namespace {

/// 60 mm canister, 23 mm wide, 10 mm throat; a coil of four turns through both.
Scene scene() {
    Scene s;
    s.canister = Canister{0.06, 0.023, 0.17, 0.023, 0.01, false};
    s.coil = geometry::Coil{0.0104, 0.0175, 0.001, 0.07};
    s.fast = 0.1;
    return s;
}

Frame frame() {
    Frame f;
    f.dose = 1;
    f.phase = Phase::Rotate;
    return f;
}

/// Characters as a terminal counts them: without escape sequences, a sequence of UTF-8 as one.
int cells(const std::string& line) {
    int count = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '\033') {
            while (line[i] != 'm') ++i;
        } else if ((std::uint8_t(line[i]) & 0xc0U) != 0x80U) {
            ++count;
        }
    }
    return count;
}

LiveState state() {
    LiveState s;
    s.frame = frame();
    s.frame.particles.add(Vec3(0, 0.01, 0.03), 0.0019);
    s.closedForm = 2e-3;
    s.progress = "dose 1 rotate, t = 2.5 s";
    return s;
}

Dose dose(int index, double mass) {
    Dose d;
    d.index = index;
    d.mass = mass;
    d.complete = true;
    return d;
}

}  // namespace

TEST_CASE("a sphere stands where it is: z to the right, y up, true to scale") {
    // 72 pixels for 70 mm and the margins: a pixel is a millimetre. The floor, y = -11.5 mm, is one pixel from below.
    Scene s = scene();
    s.coil.reset();
    for (const Vec3 x : {Vec3(0, 0, 0.03), Vec3(0, 0.02, 0.01), Vec3(0, -0.005, 0.065)}) {
        Frame f = frame();
        f.particles.add(x, 0.0025);
        const Canvas canvas = sideView(s, f, 72, 60, Style::Colour);
        double sumX = 0, sumY = 0, pixels = 0;
        for (int px = 0; px < canvas.width(); ++px)
            for (int py = 0; py < canvas.height(); ++py) {
                const auto c = canvas.at(px, py);
                if (!c || c->red == c->blue) continue;  // nothing, or a wall
                sumX += px + 0.5;
                sumY += py + 0.5;
                pixels += 1;
            }
        // Half a pixel for the grid; the area of a disc of radius 2.5 pixels, 19.6, to a ring of half pixels.
        CHECK(near(sumX / pixels, 1 + x.z * 1e3, 1, 0.5));
        CHECK(near(canvas.height() - sumY / pixels, 1 + (x.y + 0.0115) * 1e3, 1, 0.5));
        CHECK(near(pixels, kPi * 2.5 * 2.5, 2 * kPi * 2.5 * 0.5, 1));
    }
}

TEST_CASE("spheres in front hide those behind, and only active ones are drawn") {
    Scene s = scene();
    s.coil.reset();
    Frame f = frame();
    f.particles.add(Vec3(-0.005, 0, 0.03), 0.0025, Vec3(0.1, 0, 0));  // in front, fast: orange
    f.particles.add(Vec3(0.005, 0, 0.03), 0.0025);                    // behind, at rest: blue
    f.particles.add(Vec3(-0.009, 0, 0.05), 0.0025);
    f.particles.status[2] = Status::Dosed;
    const Canvas canvas = sideView(s, f, 72, 60, Style::Colour);
    const int y = canvas.height() - 13;
    REQUIRE(canvas.at(31, y));
    CHECK(canvas.at(31, y)->red > canvas.at(31, y)->blue);
    CHECK_FALSE(canvas.at(51, y));
    std::swap(f.particles.position[0], f.particles.position[1]);
    const Canvas swapped = sideView(s, f, 72, 60, Style::Colour);
    CHECK(swapped.at(31, y)->blue > swapped.at(31, y)->red);
}

TEST_CASE("a body is its edges, in the place where its motion has brought it") {
    // A box of 20 mm, turned by 45 degrees about x after a second: its silhouette is a square on its corner. The
    // picture is as wide as the body.
    Scene s;
    RigidBody body;
    body.shapes = {geometry::Block{Vec3(-0.01), Vec3(0.01), false}};
    body.course.motion = geometry::Turn{{1, 0, 0}, Vec3(0), kPi / 4};
    s.bodies = {body};
    s.skins = {bodySkin(body)};
    Frame f = frame();
    // Whether a pixel at this place, or beside it, is lit; the body reaches to `half` in z and y, 59 pixels in all.
    const auto lit = [&](double time, double half, double z, double y) {
        f.time = time;
        const Canvas canvas = sideView(s, f, 61, 61, Style::Colour);
        const double perMetre = 59 / (2 * half);
        const int px = int(1 + (z + half) * perMetre), py = int(canvas.height() - 1 - (y + half) * perMetre);
        for (const int d : {-1, 0, 1})
            if (canvas.at(px, py + d)) return true;
        return false;
    };
    const double half = std::sqrt(2) * 0.01;
    for (const double share : {0.2, 0.4, 0.6, 0.8}) {
        CHECK(lit(1, half, -share * half, (share - 1) * half));
        CHECK(lit(1, half, share * half, (share - 1) * half));
        CHECK_FALSE(lit(1, half, -share * half, 0));
        CHECK(lit(0, 0.01, -share * 0.01, -0.01));
        CHECK_FALSE(lit(0, 0.01, -share * 0.01, (share - 1) * 0.01));
    }
}

TEST_CASE("the coil is a sine line that turns with its angle") {
    // Without powder; in dots two pixels to a cell, so 2 x 72 - 2 pixels for 70 mm.
    Scene s = scene();
    s.canister.reset();
    for (const double angle : {0.0, 1.0}) {
        Frame f = frame();
        f.coilAngle = angle;
        const Canvas canvas = sideView(s, f, 72, 60, Style::Plain);
        const double perMetre = 142 / 0.07;
        int found = 0;
        for (int px = 1; px < 143; px += 7) {
            const double z = (px + 0.5 - 1) / perMetre;
            const double y = 0.0104 * std::sin(angle + 2 * kPi * z / 0.0175);
            const double py = canvas.height() - 1 - (y + 0.0114) * perMetre;
            // Steepest, the line falls 2 pi 10.4/17.5 = 3.7 pixels to one across; a pixel more for the grid.
            for (int d = -4; d <= 4; ++d)
                if (canvas.at(px, int(std::floor(py)) + d)) {
                    ++found;
                    break;
                }
        }
        CHECK(found == 21);
    }
}

TEST_CASE("walls enclose the bed and leave the outlet open") {
    const Canvas canvas = sideView(scene(), frame(), 72, 60, Style::Colour);
    const auto wall = [&](int x, int y) { return canvas.at(x, y) && canvas.at(x, y)->red == canvas.at(x, y)->blue; };
    const int bottom = canvas.height() - 1;
    for (int x = 1; x < 71; ++x) CHECK(wall(x, bottom));  // floor and throat
    for (int y = 1; y < bottom; ++y) CHECK(wall(0, y));   // rear wall
    for (int y = bottom - 22; y < bottom; ++y) CHECK_FALSE(canvas.at(71, y));
    CHECK(wall(65, bottom - 24));  // the throat's upper side
}

TEST_CASE("speed goes from blue to orange") {
    const Colour rest = speedColour(0, 0.1), fast = speedColour(0.1, 0.1), beyond = speedColour(5, 0.1);
    CHECK(rest.blue > rest.red);
    CHECK(fast.red > fast.blue);
    CHECK(beyond == fast);
    CHECK(speedColour(std::nan(""), 0.1) == fast);
    int before = -1;
    for (int i = 0; i <= 25; ++i) {  // to the pale middle, at a quarter of the speed
        const int red = speedColour(0.001 * i, 0.1).red;
        CHECK(red >= before);
        before = red;
    }
}

TEST_CASE("a frame of nothing, or of nonsense, is drawn all the same") {
    Frame nothing;
    CHECK(sideView(Scene{}, nothing, 40, 10, Style::Plain).height() > 0);
    Frame odd = frame();
    odd.particles.add(Vec3(1e12, -1e12, 1e12), 1e-3);
    odd.particles.add(Vec3(0, 0, 0.03), 1e-3, Vec3(std::nan("")));
    const Canvas canvas = sideView(scene(), odd, 72, 20, Style::Colour);
    CHECK(canvas.width() <= 72);
    CHECK(canvas.height() <= 40);
    CHECK(sideView(scene(), frame(), 1, 1, Style::Plain).height() == 0);
}

TEST_CASE("a bar is as long as its value, to an eighth of a cell") {
    CHECK(bar(1, 0, 1, 4) == "████");
    CHECK(bar(0, 0, 1, 4) == "    ");
    CHECK(bar(0.5, 0, 1, 4) == "██  ");
    CHECK(bar(0.53125, 0, 1, 4) == "██▏ ");
    CHECK(bar(0.59375, 0, 1, 4) == "██▍ ");
    CHECK(bar(0.71875, 0, 1, 4) == "██▉ ");
    CHECK(bar(0.5, 0.75, 1, 4) == "██ │");
    CHECK(bar(1, 0.25, 1, 4) == "█│██");
    CHECK(bar(1, 1, 1, 4) == "███│");
    CHECK(bar(3, 0, 1, 2) == "██");
    CHECK(bar(-1, 0, 1, 2) == "  ");
    CHECK(bar(std::nan(""), 0, 1, 2) == "  ");
    CHECK(bar(1, 1, 0, 2) == "  ");
}

TEST_CASE("no line is wider than the terminal, and there are no more than it has") {
    LiveState s = state();
    for (int i = 1; i <= 40; ++i) s.doses.push_back(dose(i, 1e-3 * i));
    s.frame.dose = 41;
    s.progress = std::string(300, 'x');
    for (const Style style : {Style::Colour, Style::Plain})
        for (const int columns : {1, 39, 40, 60, 79, 89, 90, 120, 300})
            for (const int rows : {1, 2, 3, 7, 23, 60}) {
                CAPTURE(columns, rows);
                const auto lines = screenLines(scene(), s, columns, rows, style);
                CHECK(!lines.empty());
                CHECK(int(lines.size()) <= rows);
                for (const std::string& line : lines) CHECK(cells(line) <= columns);
                CHECK_THAT(lines.back(), Catch::StartsWith("x"));
            }
}

TEST_CASE("doses are listed with their masses, the one under way too") {
    LiveState s = state();
    s.doses = {dose(1, 1.234e-3), dose(2, 2.5e-3)};
    s.frame.dose = 3;
    s.underWay = 0.75e-3;
    for (const int columns : {80, 120}) {
        std::string text;
        for (const std::string& line : screenLines(scene(), s, columns, 30, Style::Plain)) text += line + "\n";
        for (const char* part : {"dose 1", "1.234 g\n", "2.500 g\n", "0.750 g ...", "closed form 2.000 g", "t = 2.5 s"})
            CHECK_THAT(text, Catch::Contains(part));
    }
    s.frame.dose = 2;  // at rest after its end: nothing is under way
    for (const std::string& line : screenLines(scene(), s, 80, 30, Style::Plain)) CHECK(line.find("...") == line.npos);

    s.doses = {dose(1, 2.03e-6)};  // a device of milligrams
    s.frame.dose = 1;
    s.closedForm = 1.5e-6;
    std::string tiny;
    for (const std::string& line : screenLines(scene(), s, 80, 30, Style::Plain)) tiny += line + "\n";
    CHECK_THAT(tiny, Catch::Contains("0.00203 g\n") && Catch::Contains("closed form 0.00150 g"));

    s.closedForm = 0;  // a settling
    for (const std::string& line : screenLines(scene(), s, 80, 30, Style::Plain))
        CHECK(line.find("closed form") == line.npos);
}

TEST_CASE("force, torque, power and work of bodies stand below the doses, or beside the bed") {
    Scene s = scene();
    for (const char* name : {"screw", "an-agitator-with-a-long-name", "flap", "hopper", "gate"}) {
        s.bodies.emplace_back().name = name;
        s.loaded.emplace_back(name);
        s.skins.emplace_back();
    }
    LiveState now = state();
    now.loads.resize(5);
    now.loads[0] = {Vec3(0.3, -0.4, 0), -6.78e-3, 0.0123, 0.045};
    now.loads[1] = {Vec3(0, 0, 1e-7), 0, -123456, 0};
    for (const int columns : {60, 80, 120})
        for (const int rows : {24, 40}) {
            CAPTURE(columns, rows);
            const auto lines = screenLines(s, now, columns, rows, Style::Plain);
            CHECK(int(lines.size()) <= rows);
            std::string text;
            for (const std::string& line : lines) {
                CHECK(cells(line) <= columns);
                text += line + "\n";
            }
            CHECK_THAT(text, Catch::Contains("body") && Catch::Contains("N     mN m       mW       mJ"));
            CHECK_THAT(text, Catch::Contains("      0.5    -6.78     12.3       45\n"));
            CHECK_THAT(text, Catch::Contains("    1e-07        0   -1e+08        0\n"));
            CHECK_THAT(text, Catch::Contains("and 1 more\n"));
            CHECK_THAT(text, Catch::Contains("closed form"));
        }
    // The bed keeps its size when the first sample comes; in a low terminal the loads make room for the doses.
    LiveState before = now;
    before.loads.clear();
    CHECK(screenLines(s, before, 80, 40, Style::Plain).size() == screenLines(s, now, 80, 40, Style::Plain).size());
    std::string low;
    for (const std::string& line : screenLines(s, now, 80, 8, Style::Plain)) low += line + "\n";
    CHECK_THAT(low, Catch::Contains("closed form") && !Catch::Contains("mN m"));
}

TEST_CASE("drawing never takes more than its share of the time") {
    // A clock of our own: drawings that take from nothing to a second, asked for every millisecond.
    for (const double share : {0.01, 0.5}) {
        Pace pace(share, 0.2);
        double now = 0, drawing = 0, lastBegin = -1;
        std::uint64_t drawings = 0;
        while (now < 1000) {
            if (pace.due(now)) {
                CHECK(now - lastBegin >= 0.2);
                const double cost = 0.001 * double((drawings * 37) % 101) * 0.1;
                lastBegin = now;
                drawing += cost;
                pace.drew(now, now + cost);
                now += cost;
                ++drawings;
                // The break that a drawing owes comes after it.
                CHECK(drawing <= share * now + cost);
            }
            now += 0.001;
        }
        CHECK(drawings > 500);
        CHECK(drawings <= 5000);
    }
}
