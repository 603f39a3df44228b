#pragma once
// A simulation of a fake backend, and calls that wait for it.

#include <algorithm>
#include <limits>

#include "host/play/simulation.h"
#include "tests/sim/fake_backend.h"

namespace vkdose::test {

/// smallCase with ten listed particles of 1 g, as the fake weighs them.
inline Case listedCase() {
    Case c = smallCase();
    c.filling.list = smallFilling().particles;
    c.world.density() = 1e-3 / sphereMass(1, 1e-3);
    return c;
}

struct Led {
    FakeBackend* backend;  ///< of the simulation
    std::unique_ptr<Simulation> simulation;

    void wait() const {
        while (!simulation->awaitRest(std::chrono::minutes(1))) {
        }
    }
    void advance(double seconds) const {
        simulation->advance(seconds);
        wait();
    }
    void toDose() const {
        simulation->advanceToDose();
        wait();
    }
};

inline std::uint64_t someDosed(std::uint64_t step) {
    return std::min<std::uint64_t>(10, step / 60);
}

inline Led led(
    const Case& c, const std::function<void(FakeBackend&)>& prepare = [](FakeBackend&) {}) {
    auto fake = std::make_unique<FakeBackend>();
    fake->dosed = someDosed;
    prepare(*fake);
    FakeBackend* seen = fake.get();
    return {seen, std::make_unique<Simulation>(c, std::move(fake))};
}

inline constexpr double kToEnd = std::numeric_limits<double>::infinity();

inline bool same(const std::vector<FakeBackend::Call>& a, const std::vector<FakeBackend::Call>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
        return x.firstStep == y.firstStep && x.steps == y.steps && x.rate == y.rate && x.kc == y.kc;
    });
}

}  // namespace vkdose::test
