// Colours: values of particles, scales and their ticks, the colour map.

#include <cmath>
#include <limits>
#include <stdexcept>

#include "host/law/user_law.h"
#include "host/render/colour.h"
#include "host/render/quantity.h"
#include "tests/support/catch.h"
#include "tests/support/mini_case.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;
using render::Quantity;
using render::Scale;

namespace {

std::vector<std::string> texts(const Scale& scale) {
    std::vector<std::string> all;
    for (const Scale::Tick& tick : scale.ticks()) all.push_back(tick.text);
    return all;
}

}  // namespace

TEST_CASE("the colour map rises in even steps of lightness and never leaves sRGB") {
    const double step = (render::lightness(render::mapColour(1)) - render::lightness(render::mapColour(0))) / 50;
    CHECK(step > 0.008);
    for (int i = 0; i < 50; ++i) {
        const Vec3 a = render::mapColour(i / 50.0), b = render::mapColour((i + 1) / 50.0);
        // A colour outside of sRGB would be cut off and miss its lightness; one that is just at its edge by 1 in 500.
        CHECK(near(render::lightness(b) - render::lightness(a), step, step, 0.15));
    }
    CHECK(render::mapColour(0).z > 2 * render::mapColour(0).x);  // blue
    CHECK(render::mapColour(1).x > 2 * render::mapColour(1).z);  // yellow
    CHECK(render::mapColour(-3) == render::mapColour(0));
    CHECK(render::mapColour(std::numeric_limits<double>::infinity()) == render::mapColour(1));
    const Vec3 grey = render::mapColour(std::numeric_limits<double>::quiet_NaN());
    CHECK(grey.x == grey.y);
    CHECK(grey.y == grey.z);
}

TEST_CASE("sRGB is decoded as its standard says") {
    CHECK(near(render::linearLight(Vec3(0.5)).x, 0.21404114, 1, 1e-8));
    CHECK(near(render::linearLight(Vec3(0.02)).y, 0.02 / 12.92, 1, 1e-12));
    CHECK(near(render::lightness(Vec3(1)), 1, 1, 1e-6));
}

TEST_CASE("values of particles") {
    const Case c = mini();
    Frame frame;
    frame.particles.add({0, 0, 0}, 1e-3, {0.03, 0, 0.04});
    frame.particles.add({0, 0.01, 0}, 2e-3);
    Particles fill = frame.particles;
    fill.position[0].y = 0.012;
    const auto value = [&](Quantity q) { return render::valuesOf(q, c, frame, &fill)[0]; };
    const double mass = c.world.density() * 4 / 3 * kPi * 1e-9;
    CHECK(nearRelative(value(Quantity::KineticEnergy), mass * 0.00125, 1e-12));
    CHECK(nearRelative(value(Quantity::Speed), 0.05, 1e-12));
    CHECK(value(Quantity::Radius) == 1e-3);
    CHECK(value(Quantity::FillLayer) == 0.012);
    CHECK(std::isnan(render::valuesOf(Quantity::FillLayer, c, frame, nullptr)[0]));
    // A particle that was not there then: a list of other length.
    frame.particles.add({0, 0.02, 0}, 1e-3);
    CHECK(std::isnan(render::valuesOf(Quantity::FillLayer, c, frame, &fill)[2]));
}

TEST_CASE("scales follow the coil where it turns, and what is there where it does not") {
    Case c = mini();
    const double speed = c.schedule.coilSpeed * c.world.coil->radius;  // 74 mm/s
    REQUIRE(near(speed, 0.0741, 0.1, 1e-3));
    CHECK(render::scaleFor(Quantity::Speed, c, {}).high == Approx(0.1));
    // Of a mean sphere of 1.1 mm at 74 mm/s: 23 nJ, so 100 nJ and three decades down.
    const Scale energy = render::scaleFor(Quantity::KineticEnergy, c, {5.0});
    CHECK(energy.high == Approx(1e-7));
    CHECK(energy.low == Approx(1e-10));
    CHECK(texts(energy) == std::vector<std::string>{"0.1", "1", "10", "100"});
    CHECK(energy.place(1e-8) == Approx(2.0 / 3));
    CHECK(energy.colour(0) == render::mapColour(0));

    c.world.coil.reset();
    CHECK(render::scaleFor(Quantity::Speed, c, {0.011, 0.019, 0}).high == Approx(0.02));
    CHECK(render::scaleFor(Quantity::Speed, c, {}).high > 0);
    const Scale radius = render::scaleFor(Quantity::Radius, c, {1e-3, 2e-3, 1.5e-3});
    CHECK(radius.place(1.5e-3) == Approx(0.5));
    CHECK(texts(radius) == std::vector<std::string>{"1", "1.2", "1.4", "1.6", "1.8", "2"});
    const Scale equal = render::scaleFor(Quantity::Radius, c, {1e-3, 1e-3});
    CHECK(equal.place(1e-3) == Approx(0.5));
}

TEST_CASE("layers are bands of one colour") {
    const Scale s = render::scaleFor(Quantity::FillLayer, mini(), {0.0, 0.08});
    CHECK(s.bands == 8);
    CHECK(s.place(0.001) == s.place(0.009));
    CHECK(s.place(0.009) != s.place(0.011));
    CHECK(s.place(0) == Approx(1.0 / 16));
    CHECK(s.place(0.08) == Approx(15.0 / 16));
    CHECK(texts(s) == std::vector<std::string>{"0", "20", "40", "60", "80"});
}

TEST_CASE("a range is taken in the unit of the bar, an empty one refused") {
    const Case c = mini();
    const Scale s = render::scaleFor(Quantity::Speed, c, {}, {5.0, 20.0});
    CHECK(s.low == Approx(0.005));
    CHECK(s.high == Approx(0.02));
    CHECK_THROWS_WITH(render::scaleFor(Quantity::Speed, c, {}, {20.0, 20.0}),
                      Catch::Contains("20 to 20") && Catch::Contains("empty"));
    CHECK_THROWS_WITH(render::scaleFor(Quantity::KineticEnergy, c, {}, {0.0, {}}), Catch::Contains("logarithmic"));
    CHECK_THROWS_AS(render::scaleFor(Quantity::Speed, c, {}, {std::nan(""), {}}), std::invalid_argument);
    CHECK_FALSE(render::quantityNamed("temperature"));
    CHECK(render::quantityNamed("fill-layer") == Quantity::FillLayer);
}

TEST_CASE("what a user's law gives each particle is a quantity too, from its least to its largest value") {
    Case c = mini();
    c.world.properties = {"charge", "heat"};
    Frame frame;
    frame.particles.add({0, 0, 0}, 1e-3);
    frame.particles.add({0.01, 0, 0}, 1e-3);
    frame.particles.properties = {{1, 20}, {2, 30}};
    const auto heat = render::quantityNamed("heat", c.world.properties);
    REQUIRE(heat);
    CHECK(render::valuesOf(*heat, c, frame, nullptr) == std::vector<double>{20, 30});
    const Scale s = render::scaleFor(*heat, c, {20, 30});
    CHECK(s.title == "heat");
    CHECK(s.low == 20);
    CHECK(s.high == 30);
    CHECK_FALSE(render::quantityNamed("cold", c.world.properties));
    frame.particles.properties.clear();
    CHECK(std::isnan(render::valuesOf(*heat, c, frame, nullptr)[1]));
}

TEST_CASE("no property of a user's law has the name of another colour") {
    const std::string law = "float force(Contact c) { return 1.0; }\nfloat stiffness(Contact c) { return 1.0; }\n";
    for (const std::string name : render::kQuantityNames) {
        CAPTURE(name);
        CHECK(readLaw("heat.glsl", "particle float " + name + ";\n" + law).faults.size() == 1);
    }
}
