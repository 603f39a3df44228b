#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/core/error.h"
#include "host/model/case.h"
#include "tests/model/case_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using test::Folder;
using test::kFreeCase;
using test::kGoodCase;
using test::replaced;
using test::shippedCase;

namespace {

/// Smallest gap between any two spheres, as a fraction of the smaller radius; -1 when a number is not finite.
double smallestGap(const Particles& p) {
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < p.size(); ++i)
        for (std::size_t j = i + 1; j < p.size(); ++j) {
            const double gap = glm::distance(p.position[i], p.position[j]) - p.radius[i] - p.radius[j];
            if (!std::isfinite(gap)) return -1;
            smallest = std::min(smallest, gap / std::min(p.radius[i], p.radius[j]));
        }
    return smallest;
}

double massOf(const Particles& p, double density) {
    double mass = 0;
    for (const double r : p.radius) mass += density * 4.0 / 3.0 * kPi * std::pow(r, 3);
    return mass;
}

}  // namespace

TEST_CASE("how loose and how high the filling starts is the case's choice") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);
    const Particles usual = insertParticles(loadCase(file)).particles;
    const auto lowest = [](const Particles& p) {
        double y = std::numeric_limits<double>::infinity();
        for (const Vec3& x : p.position) y = std::min(y, x.y);
        return y;
    };
    const Particles dropped = insertParticles(loadCase(file, {"particles.drop_mm=7"})).particles;
    REQUIRE(dropped.size() == usual.size());
    for (std::size_t i = 0; i < usual.size(); ++i) {
        REQUIRE(dropped.radius[i] == usual.radius[i]);
        REQUIRE(dropped.position[i].y - usual.position[i].y == Approx(7e-3).epsilon(1e-9));
    }
    const Case loose = loadCase(file, {"particles.grid_gap=0.6"});
    const Insertion filled = insertParticles(loose);
    CHECK(filled.particles.radius == usual.radius);
    CHECK(smallestGap(filled.particles) > 0);
    CHECK(filled.fillHeight > 1.5 * insertParticles(loadCase(file)).fillHeight);
    // The lowest layer lies half a pitch over the coil, shifted by no more than a quarter of the play.
    const double pitch = 2.6e-3 * 1.6, coilTop = 6.7e-3;
    CHECK(std::abs(lowest(filled.particles) - coilTop - pitch / 2) <= 0.25 * 0.6 * 2.6e-3);
    CHECK(insertParticles(loadResolvedCase(loose.resolved, file)).particles.position == filled.particles.position);
}

TEST_CASE("the paper's filling: mass, number, room") {
    const Case c = loadCase(shippedCase("paper-48g.toml"));
    const Insertion filled = insertParticles(c);
    const Particles& p = filled.particles;
    // Met as closely as one particle allows: within half of the largest one's mass.
    const double largest = 1427 * 4.0 / 3.0 * kPi * std::pow(1.875e-3, 3);
    CHECK(std::abs(filled.mass - 0.048) <= largest / 2);
    CHECK(filled.targetMass == 0.048);
    CHECK(massOf(p, 1427) == Approx(filled.mass).epsilon(1e-12));
    // 48 g over a mean mass of 10 r_min^3 4/3 pi rho: 3290; the draw's deviation is 0.75 sqrt(3290) = 43.
    CHECK(static_cast<double>(p.size()) == Approx(3290).margin(3 * 43));
    CHECK(smallestGap(p) > 0);
    const double coilTop = 11.4e-3;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double r = p.radius[i];
        REQUIRE(std::abs(p.position[i].x) + r < 11.5e-3);
        REQUIRE(p.position[i].y - r > coilTop);
        REQUIRE(p.position[i].y + r <= filled.fillHeight);
        REQUIRE((p.position[i].z - r > 0 && p.position[i].z + r < 60e-3));
        REQUIRE(p.velocity[i] == Vec3(0));
        REQUIRE(p.spin[i] == Vec3(0));
    }
    CHECK(filled.fillHeight < c.world.domain.high.y);
    // Not a crystal: neighbours of the grid do not share coordinates.
    CHECK(p.position[0].y != p.position[1].y);
}

TEST_CASE("the same case gives the same particles, another seed gives others") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);
    const Particles a = insertParticles(loadCase(file)).particles;
    const Particles b = insertParticles(loadCase(file)).particles;
    const Particles other = insertParticles(loadCase(file, {"seed=4"})).particles;
    CHECK(a.position == b.position);
    CHECK(a.radius == b.radius);
    CHECK(a.radius[0] != other.radius[0]);
    CHECK(a.position[0] != other.position[0]);
}

TEST_CASE("a higher fill raises the domain, not an error") {
    const Case c = loadCase(shippedCase("paper-100g.toml"));
    const Insertion filled = insertParticles(c);
    CHECK(filled.fillHeight > c.canister->height - c.canister->width / 2);
    CHECK(c.world.domain.high.y > filled.fillHeight);
    CHECK(static_cast<double>(filled.particles.size()) == Approx(6854).margin(3 * 62));
}

TEST_CASE("a fill of any mass and seed that reaches up to the lid fits under it") {
    const Folder folder;
    const auto small = folder.write("case.toml", kGoodCase);
    const std::string lid = "canister.lid=true";
    const auto accepted = [](const std::filesystem::path& file, const std::vector<std::string>& overrides) {
        CAPTURE(overrides);
        CHECK_NOTHROW(loadCase(file, overrides));
    };
    // From fills below the canister's height to fills above it.
    for (int tenths = 200; tenths <= 340; ++tenths)
        accepted(shippedCase("quickstart.toml"), {lid, "particles.mass_g=" + std::to_string(tenths / 10.0)});
    for (int seed = 0; seed < 60; ++seed)
        accepted(small, {lid, "canister.height_mm=16", "seed=" + std::to_string(seed)});
    // A lid at the very height of the fill.
    const Insertion filled = insertParticles(loadCase(small));
    const double half = loadCase(small).canister->width / 2;
    double highest = 0;
    for (std::size_t i = 0; i < filled.particles.size(); ++i)
        highest = std::max(highest, filled.particles.position[i].y + filled.particles.radius[i]);
    for (int ulps = -20; ulps <= 20; ++ulps) {
        const double height = (highest + half) * (1 + ulps * std::numeric_limits<double>::epsilon()) * 1e3;
        accepted(small, {lid, fmt::format("canister.height_mm={}", height)});
    }
}

TEST_CASE("quantiles: what was cut is reported") {
    const Folder folder;
    const Case c = loadCase(folder.write("case.toml", kGoodCase),
                            {"particles.size.distribution=quantiles", "particles.size.d10_um=31.55",
                             "particles.size.d50_um=184", "particles.size.d90_um=979.19", "particles.size.scale_up=10",
                             "particles.size.radius_min_mm=0.7", "particles.size.radius_max_mm=1.5"});
    const Insertion filled = insertParticles(c);
    // By hand, d(volume)/d(ln r) = 0.4 / ln(184/31.55) and 0.4 / ln(979.19/184) about r50 = 0.92 mm:
    CHECK(filled.cutBelow == Approx(0.5 + 0.4 * std::log(0.7 / 0.92) / std::log(184 / 31.55)));
    CHECK(filled.cutAbove == Approx(0.5 - 0.4 * std::log(1.5 / 0.92) / std::log(979.19 / 184)));
    CHECK(filled.mass == Approx(0.9e-3).epsilon(0.02));
    CHECK(*std::min_element(filled.particles.radius.begin(), filled.particles.radius.end()) >= 0.7e-3);
    CHECK(*std::max_element(filled.particles.radius.begin(), filled.particles.radius.end()) <= 1.5e-3);
    CHECK(smallestGap(filled.particles) > 0);
}

TEST_CASE("a region of its own, with free boundaries") {
    const Folder folder;
    const std::string text = replaced(kFreeCase, "list = \"two.csv\"\n",
                                      "mass_g = 0.1\n[particles.size]\ndistribution = \"fixed\"\nradius_mm = 1\n"
                                      "[particles.region]\nlow = [0, 0, 0]\nhigh = [0.01, 0.01, 0.01]\n");
    const Case c = loadCase(folder.write("case.toml", text));
    const Insertion filled = insertParticles(c);
    CHECK(filled.particles.size() == 17);  // 0.1 g / 5.977 mg = 16.7
    CHECK(smallestGap(filled.particles) > 0);
    for (const Vec3& x : filled.particles.position)
        REQUIRE((glm::all(glm::greaterThan(x, Vec3(1e-3))) && glm::all(glm::lessThan(x, Vec3(9e-3)))));
    try {
        loadCase(folder.write("case.toml", text), {"particles.mass_g=1"});
        FAIL("accepted");
    } catch (const CaseError& error) {
        CHECK_THAT(error.what(), Catch::Contains("particles.region: has 64 sites"));
    }
}

TEST_CASE("a list is taken as it is") {
    const Folder folder;
    folder.write("two.csv", "x,y,z,r,vx,vy,vz,wx,wy,wz\n0,0,0,1e-3,1,2,3,4,5,6\n0,3e-3,0,2e-3,0,0,0,0,0,0\n");
    const Insertion filled = insertParticles(loadCase(folder.write("case.toml", kFreeCase)));
    REQUIRE(filled.particles.size() == 2);
    CHECK(filled.particles.velocity[0] == Vec3(1, 2, 3));
    CHECK(filled.particles.spin[0] == Vec3(4, 5, 6));
    CHECK(filled.mass == Approx(1427 * 4.0 / 3.0 * kPi * 9e-9));
    CHECK(filled.targetMass == filled.mass);
    CHECK(filled.fillHeight == Approx(5e-3));
}
