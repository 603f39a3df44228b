// Whole pictures by their content: powder, coil, outline, colour bar, scale bar and letters at the places they must be.

#include "tests/render/scenes.h"

#include <set>
#include <tuple>
#include <utility>

#include "host/render/colour.h"
#include "host/render/outline.h"
#include "host/render/picture.h"
#include "tests/support/mini_case.h"
#include "tests/support/near.h"
#include "tests/support/places.h"

using namespace vkdose;
using namespace vkdose::test;
using render::Canvas;
using render::Layout;
using render::Panel;
using render::PictureSpec;
using render::Quantity;

namespace {

/// Three particles of known speed in the canister of mini, far from each other, and one that is dosed.
Frame someFrame() {
    Frame f;
    f.time = 0.25;
    f.phase = Phase::Rotate;
    f.dose = 1;
    f.coilAngle = -kPi / 2;
    f.particles.add({-4e-3, 12e-3, 3e-3}, 1.2e-3, {0, 0, 0});
    f.particles.add({-4e-3, 12e-3, 8e-3}, 1.2e-3, {0, 0, 0.05});
    f.particles.add({-4e-3, 12e-3, 13e-3}, 1.2e-3, {0, 0.1, 0});
    f.particles.add({-4e-3, 8e-3, 8e-3}, 1.2e-3);
    f.particles.status[3] = Status::Dosed;
    return f;
}

struct Drawn {
    Case c = mini();
    PictureSpec spec;
    Box content;
    Layout layout;
    Canvas canvas;
};

/// Width and height of a picture in which all that the tests look for is several pixels wide. [pixels]
const std::pair<int, int> kQuick{640, 520};

/// Of these frames, coloured by speed on the automatic scale, 0 to 100 mm/s.
Drawn drawn(Studio& studio, PictureSpec spec, const std::vector<Frame>& frames) {
    const Case c = mini();
    std::vector<Panel> panels;
    Box content = render::contentOf(c, frames.at(0));
    for (const Frame& f : frames) {
        panels.push_back({&f, valuesOf(Quantity::Speed, c, f, nullptr), render::stateText(c, f)});
        content = render::united(content, render::contentOf(c, f));
    }
    spec.scale = scaleFor(Quantity::Speed, c, {});
    if (spec.width == 0) std::tie(spec.width, spec.height) = kQuick;
    const Layout layout = layoutOf(spec, content, panels.size());
    return {c, spec, content, layout, drawPicture(studio.caster(), c, spec, content, panels)};
}

Vec3 colourAt(const Drawn& d, const Vec3& point, std::size_t panel = 0) {
    const render::Camera::Place p = d.layout.camera.project(point);
    return d.canvas.colourAt(int(d.layout.panels[panel].x + p.x), int(d.layout.panels[panel].y + p.y));
}

/// A shaded colour has lost light, in the same share of each component.
bool isShadeOf(const Vec3& seen, const Vec3& colour) {
    const Vec3 a = render::linearLight(seen), b = render::linearLight(colour);
    return glm::length(glm::normalize(a) - glm::normalize(b)) < 0.02 && glm::length(a) > 0.6 * glm::length(b);
}

bool isGrey(const Vec3& c) {
    return std::max({c.x, c.y, c.z}) - std::min({c.x, c.y, c.z}) < 0.06 && c.x < 0.9;
}

/// Dark pixels of letters in a box.
int ink(const Canvas& canvas, double left, double top, double right, double bottom) {
    int dark = 0;
    for (int y = std::max(0, int(top)); y < std::min(double(canvas.height()), bottom); ++y)
        for (int x = std::max(0, int(left)); x < std::min(double(canvas.width()), right); ++x)
            dark += canvas.colourAt(x, y).x < 0.4;
    return dark;
}

}  // namespace

TEST_CASE("particles stand where they are, in the colour of their speed, dosed ones are gone") {
    Studio studio;
    for (const auto view : {render::View::Side, render::View::End, render::View::Iso}) {
        PictureSpec spec;
        spec.view = view;
        const Frame f = someFrame();
        const Drawn d = drawn(studio, spec, {f});
        // The point of each sphere that is nearest to the viewer. Seen from the end, the last one hides the others.
        for (std::size_t i = view == render::View::End ? 2 : 0; i < 3; ++i) {
            const double t = 0.5 * double(i);
            CHECK(isShadeOf(colourAt(d, f.particles.position[i] + 1.2e-3 * d.layout.camera.towards),
                            render::mapColour(t)));
        }
        if (view == render::View::Side) CHECK(colourAt(d, f.particles.position[3]) == Vec3(1));
    }
}

TEST_CASE("the coil is seen at the frame's angle, or not at all") {
    Studio studio;
    PictureSpec spec;
    const Frame f = someFrame();
    const Drawn with = drawn(studio, spec, {f});
    spec.coil = false;
    const Drawn without = drawn(studio, spec, {f});
    const geometry::Coil& coil = *with.c.world.coil;
    int there = 0, gone = 0;
    for (int turn = 0; turn < 3; ++turn) {
        // At the angle -pi/2 - pi/2 of the frame and the way along, the wire is nearest to the viewer.
        const double s = coil.pitch * (turn + (coil.hand > 0 ? 0.75 : 0.25));
        const Vec3 point(-coil.radius - coil.wireRadius, 0, coil.zStart + s);
        there += isGrey(colourAt(with, point));
        gone += colourAt(without, point) == Vec3(1);
    }
    CHECK(there == 3);
    CHECK(gone == 3);
}

TEST_CASE("the canister's edges are drawn, but not through what lies before them") {
    Studio studio;
    PictureSpec spec;
    spec.coil = false;
    Frame f = someFrame();
    f.particles.add({-9e-3, 5e-3, 0}, 2e-3);  // before the rear wall's edge
    const Drawn d = drawn(studio, spec, {f});
    const auto edge = [&](const Vec3& x) {  // within a pixel, for the line is thin
        const render::Camera::Place p = d.layout.camera.project(x);
        for (int dx = -1; dx <= 1; ++dx)
            for (int dy = -1; dy <= 1; ++dy) {
                const Vec3 c =
                    d.canvas.colourAt(int(d.layout.panels[0].x + p.x) + dx, int(d.layout.panels[0].y + p.y) + dy);
                if (isGrey(c) && c.x < 0.8) return true;
            }
        return false;
    };
    CHECK(edge({0, 0, 0}));          // rear wall
    CHECK(edge({0, 10e-3, 0.016}));  // front wall
    CHECK(edge({0, -7e-3, 8e-3}));   // floor
    CHECK(edge({0, 7e-3, 18e-3}));   // throat
    CHECK(edge({0, 0, 21e-3}));      // its end
    CHECK_FALSE(edge({0, 2e-3, 8e-3}));
    CHECK_FALSE(edge({0, 5e-3, 0}));  // hidden
}

TEST_CASE("the colour bar shows the map from bottom to top, with ticks and a title beside it") {
    Studio studio;
    const Drawn d = drawn(studio, {}, {someFrame()});
    const Layout& l = d.layout;
    const int x = int(l.bar.x + l.barWidth / 2);
    for (const double t : {0.01, 0.25, 0.5, 0.75, 0.99}) {
        const Vec3 seen = d.canvas.colourAt(x, int(l.bar.y + (1 - t) * l.barHeight));
        CHECK(near(seen, render::mapColour(t), 1, 0.02));  // a row of pixels, and 8 bits
    }
    for (const auto& tick : d.spec.scale.ticks()) {
        const double y = l.bar.y + (1 - tick.place) * l.barHeight;
        CHECK(ink(d.canvas, l.bar.x + l.barWidth + 0.5 * l.text, y - 0.5 * l.text, l.bar.x + l.barWidth + 3 * l.text,
                  y + 0.5 * l.text) > 5);
    }
    CHECK(d.spec.scale.title == "speed [mm/s]");
    CHECK(ink(d.canvas, l.bar.x + l.barWidth + 3 * l.text, l.bar.y, d.canvas.width(), l.bar.y + l.barHeight) > 50);
}

TEST_CASE("the scale bar is as long as it says") {
    Studio studio;
    for (const auto view : {render::View::Side, render::View::End, render::View::Cut, render::View::CutEnd}) {
        PictureSpec spec;
        spec.view = view;
        const Drawn d = drawn(studio, spec, {someFrame()});
        const Layout& l = d.layout;
        const int y = int(l.scaleFrom.y);
        int dark = 0;
        for (int x = int(l.scaleFrom.x) - 5; x < l.scaleTo.x + 0.3 * l.text; ++x)
            dark += d.canvas.colourAt(x, y).x < 0.3;
        CHECK(near(dark, l.scaleLength / l.camera.pixel, 1, 1));  // to a pixel
        CHECK(l.scaleLength == Approx(5e-3));
        CHECK(ink(d.canvas, l.scaleTo.x + 0.4 * l.text, y - l.text, l.scaleTo.x + 5 * l.text, y + l.text) > 20);
    }
}

TEST_CASE("panels stand side by side, each with its state and its title") {
    Studio studio;
    std::vector<Frame> frames(3, someFrame());
    frames[1].particles.status[1] = Status::Dosed;
    frames[2].time = 12.3;
    PictureSpec spec;
    spec.coil = false;
    const Drawn d = drawn(studio, spec, frames);
    const Vec3 point = frames[0].particles.position[1] - Vec3(1.2e-3, 0, 0);
    CHECK(isShadeOf(colourAt(d, point, 0), render::mapColour(0.5)));
    CHECK(colourAt(d, point, 1) == Vec3(1));
    CHECK(isShadeOf(colourAt(d, point, 2), render::mapColour(0.5)));
    std::set<int> titles;
    for (const Canvas::Point& p : d.layout.panels)
        titles.insert(
            ink(d.canvas, p.x, p.y - 1.6 * d.layout.text, p.x + d.layout.camera.width, p.y - 0.2 * d.layout.text));
    CHECK(*titles.begin() > 50);
    CHECK(titles.size() == 2);  // the third tells another time
}

TEST_CASE("a picture tells what the device does: a slide does not turn") {
    Case c = mini();
    Frame f;
    CHECK(render::stateText(c, f) == "0.00 s");
    f.time = 12.3;
    f.dose = 1;
    f.phase = Phase::Rotate;
    CHECK(render::stateText(c, f) == "12.30 s, dose 1, turning");
    c.world.coil.reset();
    RigidBody slide;
    slide.course.motion = geometry::Slide{Vec3(0, 0, 0.1)};
    c.world.bodies = {slide};
    CHECK(render::stateText(c, f) == "12.30 s, dose 1, moving");
    f.phase = Phase::Reverse;
    CHECK(render::stateText(c, f) == "12.30 s, dose 1, moving back");
    f.phase = Phase::Rest;
    CHECK(render::stateText(c, f) == "12.30 s, dose 1, resting");
    c.world.bodies.push_back(slide);
    c.world.bodies[1].course.motion = geometry::Turn{};
    f.phase = Phase::Rotate;
    CHECK(render::stateText(c, f) == "12.30 s, dose 1, turning");
}

TEST_CASE("any size is kept, and the parts stay inside") {
    const Case c = mini();
    const Frame f = someFrame();
    const Box content = render::contentOf(c, f);
    for (const auto& [width, height] : {std::pair{317, 211}, {64, 64}, {1280, 720}, {200, 900}, {0, 0}})
        for (const std::size_t panels : {1u, 2u, 4u, 5u}) {
            for (const auto view :
                 {render::View::Side, render::View::End, render::View::Iso, render::View::Cut, render::View::CutEnd}) {
                PictureSpec spec;
                spec.view = view;
                spec.width = width;
                spec.height = height;
                const Layout l = layoutOf(spec, content, panels);
                if (width > 0) {
                    CHECK(l.width == width);
                    CHECK(l.height == height);
                } else {
                    CHECK(l.width % 2 == 0);
                    CHECK(l.height % 2 == 0);
                }
                if (width > 0 && width < 300) continue;  // too small for all of it
                for (const Canvas::Point& p : l.panels) {
                    CHECK(p.x >= 0);
                    CHECK(p.y >= l.text);
                    CHECK(p.x + l.camera.width <= l.bar.x);
                    CHECK(p.y + l.camera.height <= l.height);
                }
                CHECK(l.bar.x + l.barWidth < l.width);
                CHECK(l.bar.y + l.barHeight < l.height);
                CHECK(l.scaleTo.y + 0.4 * l.text < l.height);
            }
        }
    Studio studio;
    PictureSpec odd;
    odd.width = 317;
    odd.height = 211;
    const Drawn d = drawn(studio, odd, {f});
    CHECK(d.canvas.width() == 317);
    CHECK(d.canvas.height() == 211);
    CHECK(d.canvas.bytes().size() == 4UL * 317 * 211);
    CHECK(d.canvas.png().substr(1, 3) == "PNG");
}

TEST_CASE("the camera fills the picture with what is to be seen") {
    const Box box{{-0.01, -0.02, 0}, {0.03, 0.05, 0.06}};
    for (const auto view :
         {render::View::Side, render::View::End, render::View::Iso, render::View::Cut, render::View::CutEnd}) {
        const render::Camera c = cameraFor(view, box, 400, 300);
        double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 x((corner & 1) != 0 ? box.high.x : box.low.x, (corner & 2) != 0 ? box.high.y : box.low.y,
                         (corner & 4) != 0 ? box.high.z : box.low.z);
            const render::Camera::Place p = c.project(x);
            left = std::min(left, p.x);
            right = std::max(right, p.x);
            top = std::min(top, p.y);
            bottom = std::max(bottom, p.y);
        }
        CHECK(near(left, 0, 1, 1e-6));
        CHECK(near(top, 0, 1, 1e-6));
        CHECK(near(right, c.width, 1, 1));
        CHECK(near(bottom, c.height, 1, 1));
        CHECK((c.width == 400 || c.height == 300));
    }
    CHECK(render::viewNamed("cut") == render::View::Cut);
    CHECK(render::viewNamed("cut-end") == render::View::CutEnd);
    CHECK_FALSE(render::viewNamed("top"));
}

TEST_CASE("a stray sphere does not decide how high a picture reaches") {
    const Case c = mini();
    Frame f;
    for (int i = 0; i < 199; ++i) f.particles.add({0, 1e-4 * i, 5e-3}, 1e-3);
    const double high = render::contentOf(c, f).high.y;
    CHECK(high > 20.8e-3);
    f.particles.add({0, 55e-3, 5e-3}, 1e-3);
    CHECK(near(render::contentOf(c, f).high.y, high, 1e-3, 0.2));  // the second highest, 0.1 mm lower, and its margin
    for (int i = 0; i < 3; ++i) f.particles.add({0, 55e-3, 5e-3}, 1e-3);
    CHECK(render::contentOf(c, f).high.y > 55e-3);
}

TEST_CASE("the outline lies on the surfaces") {
    for (const char* floor : {"trough", "flat"}) {
        const Case c = loadCase(sourceDir() + "/cases/mini.toml", {std::string("canister.floor=") + floor});
        const Box content{{-0.01, -0.01, -0.001}, {0.01, 0.05, 0.022}};
        for (const Vec3& towards : {Vec3(-1, 0, 0), Vec3(0, 0, 1), glm::normalize(Vec3(-1, 0.5, 0.7))}) {
            int points = 0;
            for (const render::Line& line : render::outlineOf(c, towards, content, {}))
                for (const Vec3& x : line) {
                    double nearest = 1;
                    for (const Wall& wall : c.world.walls)
                        nearest = std::min(nearest, std::abs(geometry::closestPoint(wall.shape, x).distance));
                    CHECK(near(nearest, 0, 7e-3, 1e-6));
                    ++points;
                }
            CHECK(points > 200);
            for (const render::Line& line : render::outlineOf(c, towards, content, render::cutOf(render::View::Cut)))
                for (const Vec3& x : line) CHECK(x.x > -1e-8);
        }
    }
}

TEST_CASE("boundaries that are no canister are drawn as far as the powder reaches") {
    Case c = mini();
    c.canister.reset();
    c.world.walls = {geometry::Plane{{0, 0, 0}, {0, 1, 0}}, geometry::Tube{{0, 0, 0}, {0, 1, 0}, 0.01}};
    const Box content{{-0.02, -0.01, -0.03}, {0.02, 0.03, 0.03}};
    const std::vector<render::Line> lines = render::outlineOf(c, {-1, 0, 0}, content, {});
    REQUIRE(lines.size() == 5);  // the plane's rectangle, two rings, two sides
    CHECK(lines[0].size() == 5);
    for (const Vec3& x : lines[0]) {
        CHECK(near(x.y, 0, 0.01, 1e-9));
        CHECK(near(std::abs(x.x), 0.02, 0.01, 1e-9));
        CHECK(near(std::abs(x.z), 0.03, 0.01, 1e-9));
    }
    for (std::size_t i = 1; i < 5; ++i)
        for (const Vec3& x : lines[i]) {
            CHECK(near(std::hypot(x.x, x.z), 0.01, 0.01, 1e-9));
            CHECK(x.y >= -0.01 - 1e-9);
            CHECK(x.y <= 0.03 + 1e-9);
        }
}

TEST_CASE("the body that holds the powder is seen through, one that stands in it is not") {
    Case c = mini();
    c.canister.reset();
    c.world.walls.clear();
    c.world.coil.reset();
    RigidBody drum, rod, floor;
    drum.shapes = {geometry::Cone{{0, 0, -20e-3}, {0, 0, 1}, 20e-3, 20e-3, 60e-3}};
    rod.shapes = {geometry::Ball{Vec3(0, 12e-3, 3e-3), 1e-3}};  // hides one of three particles from the side
    rod.course.start.origin = {-8e-3, 0, 0};
    floor.shapes = {geometry::Plane{{0, -5e-3, 0}, {0, 1, 0}}};
    c.world.bodies = {drum, rod, floor};
    const Frame f = someFrame();
    std::vector<DrawnBody> bodies = bodiesOf(c);
    const Box content = render::contentOf(c, f, bodies);
    // As large as the drum, with a margin; the floor goes on for ever and takes no part.
    CHECK(near(content.high.y, 20e-3, 20e-3, 0.15));
    CHECK(near(content.low.z, -20e-3, 20e-3, 0.15));
    lookThrough(bodies, c, f, {-1, 0, 0}, content);
    CHECK(bodies[0].seeThrough);
    CHECK(bodies[1].hidden == 1);
    CHECK_FALSE(bodies[1].seeThrough);
    CHECK_FALSE(bodies[2].seeThrough);
    std::vector<DrawnBody> below = bodiesOf(c);
    lookThrough(below, c, f, {0, -1, 0}, content);
    CHECK(below[2].seeThrough);

    Studio studio;
    PictureSpec spec;
    std::tie(spec.width, spec.height) = kQuick;
    spec.bodies = bodies;
    spec.scale = scaleFor(Quantity::Speed, c, {});
    const std::vector<Panel> panels{{&f, valuesOf(Quantity::Speed, c, f, nullptr), ""}};
    const Canvas canvas = drawPicture(studio.caster(), c, spec, content, panels);
    const Layout layout = layoutOf(spec, content, 1);
    const auto at = [&](const Vec3& x) {
        const render::Camera::Place p = layout.camera.project(x);
        return canvas.colourAt(int(layout.panels[0].x + p.x), int(layout.panels[0].y + p.y));
    };
    CHECK(isGrey(at({-9e-3, 12e-3, 3e-3})));  // the rod
    CHECK_FALSE(isGrey(at(f.particles.position[2])));
    CHECK(at({0, -4e-3, 0}).x > 0.75);  // nothing but the drum's pane
}
