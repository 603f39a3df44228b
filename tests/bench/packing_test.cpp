// The generated packing: the same every time, and like a real one.

#include "host/bench/packing.h"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace vkdose;
using namespace vkdose::bench;

namespace {

struct Overlaps {
    double touching = 0;  ///< others that a sphere overlaps, mean
    double deepest = 0;   ///< overlap over smaller radius
    std::size_t rattlers = 0;
};

/// By looking at all pairs; `period` is that of the box, 0 in a direction without.
Overlaps overlapsOf(const Particles& p, const Vec3& period) {
    Overlaps found;
    std::vector<int> touches(p.size(), 0);
    for (std::size_t i = 0; i < p.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            Vec3 d = p.position[i] - p.position[j];
            for (glm::length_t a = 0; a < 3; ++a)
                if (period[a] > 0) d[a] -= period[a] * std::round(d[a] / period[a]);
            const double overlap = p.radius[i] + p.radius[j] - glm::length(d);
            if (overlap <= 0) continue;
            ++touches[i];
            ++touches[j];
            found.deepest = std::max(found.deepest, overlap / std::min(p.radius[i], p.radius[j]));
        }
    for (const int t : touches) {
        found.touching += double(t) / double(p.size());
        if (t == 0) ++found.rattlers;
    }
    return found;
}

}  // namespace

TEST_CASE("the tile is the same for the same seed and another for another") {
    const Packing a = relaxedTile(1), b = relaxedTile(1), c = relaxedTile(2);
    CHECK(a.particles.position == b.particles.position);
    CHECK(a.particles.radius == b.particles.radius);
    CHECK(a.particles.radius != c.particles.radius);
}

TEST_CASE("the tile is a dense packing of the paper's sizes") {
    const Packing tile = relaxedTile(1);
    REQUIRE(tile.particles.size() == 3375);
    const auto [smallest, largest] = std::minmax_element(tile.particles.radius.begin(), tile.particles.radius.end());
    CHECK(*smallest >= kRadiusMin);
    CHECK(*largest <= kRadiusMax);
    CHECK(*largest / *smallest > 2.9);  // the paper's 3, nearly reached by so many draws

    double volume = 0;
    for (const double r : tile.particles.radius) volume += 4.0 / 3.0 * kPi * r * r * r;
    CHECK(volume / (tile.size.x * tile.size.y * tile.size.z) == Approx(0.66).epsilon(1e-9));
    for (const Vec3& x : tile.particles.position)
        for (glm::length_t a = 0; a < 3; ++a) {
            REQUIRE(x[a] >= 0);
            REQUIRE(x[a] <= tile.size[a]);
        }

    const Overlaps found = overlapsOf(tile.particles, tile.size);
    INFO("touching " << found.touching << ", deepest " << found.deepest << ", rattlers " << found.rattlers);
    // Frictionless spheres hold each other by six contacts; more where they are pressed together.
    CHECK(found.touching > 5);
    CHECK(found.touching < 8);
    CHECK(found.deepest < 0.2);
    CHECK(found.rattlers < tile.particles.size() / 10);
}

TEST_CASE("tiles fit together") {
    const Packing tile = relaxedTile(1), two = tiled(tile, 1, 1, 2);
    REQUIRE(two.particles.size() == 2 * tile.particles.size());
    CHECK(two.size.z == Approx(2 * tile.size.z).epsilon(1e-12));
    // Periodic over both: every contact of the tile there twice, and none that the tile has not.
    CHECK(overlapsOf(two.particles, two.size).touching ==
          Approx(overlapsOf(tile.particles, tile.size).touching).epsilon(1e-9));
}
