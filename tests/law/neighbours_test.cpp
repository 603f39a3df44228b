// The neighbour list against all pairs.

#include "host/backend/reference/neighbours.h"

#include <random>

#include "tests/support/catch.h"

using namespace vkdose;
using reference::Neighbours;

namespace {

Particles cloud(std::size_t count, double width, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    Particles particles;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = unit(random), y = unit(random), z = unit(random);
        particles.add(width * Vec3(x, 0.3 * y, 5 * z), (0.5 + unit(random)) * 1e-3);
    }
    return particles;
}

std::vector<std::uint32_t> allPairs(const Particles& particles, std::size_t i, double skin) {
    std::vector<std::uint32_t> row;
    for (std::size_t j = i + 1; j < particles.size(); ++j) {
        const double distance = glm::length(particles.position[i] - particles.position[j]);
        const bool active = particles.status[i] == Status::Active && particles.status[j] == Status::Active;
        if (active && distance < particles.radius[i] + particles.radius[j] + skin)
            row.push_back(static_cast<std::uint32_t>(j));
    }
    return row;
}

}  // namespace

TEST_CASE("neighbours: the list holds exactly the pairs in reach, in ascending order") {
    for (const std::size_t count : {0u, 1u, 2u, 37u, 501u})
        for (const double width : {1e-3, 8e-3, 30e-3, 2.0})
            for (const auto& [skin, reach] : {std::pair(0.0, 0.0), {0.4e-3, 0.0}, {0.2e-3, 0.3e-3}}) {
                Particles particles = cloud(count, width, 5 + count);
                for (std::size_t i = 3; i < count; i += 7) particles.status[i] = Status::Dosed;
                Neighbours neighbours;
                neighbours.reset(skin, reach);
                neighbours.update(particles);
                bool same = true;
                for (std::size_t i = 0; i < count; ++i)
                    same &= neighbours.after(i) == allPairs(particles, i, skin + reach);
                CAPTURE(count, width, skin, reach);
                CHECK(same);
            }
}

TEST_CASE("neighbours: rebuilt when, and only when, a particle has moved more than half the skin") {
    Particles particles = cloud(50, 8e-3, 1);
    Neighbours neighbours;
    neighbours.reset(1e-3, 0);
    neighbours.update(particles);
    neighbours.update(particles);
    CHECK(neighbours.builds() == 1);
    particles.position[20].y += 0.4e-3;
    neighbours.update(particles);
    CHECK(neighbours.builds() == 1);
    particles.position[20].y += 0.2e-3;
    neighbours.update(particles);
    CHECK(neighbours.builds() == 2);
    CHECK(neighbours.after(20) == allPairs(particles, 20, 1e-3));
    particles.status[7] = Status::Dosed;  // what a removed particle does asks for nothing
    particles.position[7].x += 1;
    neighbours.update(particles);
    CHECK(neighbours.builds() == 2);
    neighbours.reset(1e-3, 0);
    CHECK(neighbours.builds() == 0);
}
