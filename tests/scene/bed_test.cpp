// Many particles in a canister, GPU against reference, and the GPU against itself.

#include "tests/scene/agreement.h"
#include "tests/scene/beds.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// Two calls of different length, the second with the coil turning.
std::unique_ptr<Backend> played(const RuledWorld& w, const Particles& p, const VulkanOptions& options = {}) {
    auto device = gpu(options);
    device->load(w, p);
    device->advance(1201, 0);
    device->advance(1600, -9.42);
    return device;
}

}  // namespace

namespace {

/// The way by which rounding displaces a particle, in mean radii: 7e-7 in the first 400 steps on lavapipe, at random,
/// so that ten times as many steps make it three times as much.
constexpr double kRounding = 3e-6;

/// The particles, each displaced by up to kRounding.
Particles twinOf(const Particles& original, unsigned seed) {
    Particles p = original;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (Vec3& x : p.position) {
        const double dx = unit(random), dy = unit(random), dz = unit(random);
        x += kRounding * 1.25e-3 * Vec3(dx, dy, dz);
    }
    return p;
}

/// The sensors of 4000 steps, after a first 400.
Sensors late(const RuledWorld& w, const Particles& p) {
    const auto reference = makeReferenceBackend();
    reference->load(w, p);
    reference->advance(400, -9.42);
    return reference->advance(4000, -9.42);
}

}  // namespace

TEST_CASE("a bed of odd size follows the reference through its first contacts, then in its sums", "[every-driver]") {
    const RuledWorld w = canisterWorld();
    const Particles p = thrownIn(131);
    auto device = gpu();
    auto reference = makeReferenceBackend();
    device->load(w, p);
    reference->load(w, p);
    // Short: rounding of one part in 1e7 a step has met a few collisions, none of them chaotic yet. A contact turns a
    // displacement into a speed at its frequency, 3e4/s.
    device->advance(400, -9.42);
    reference->advance(400, -9.42);
    const Differences early = differences(*device, *reference, 0.2);
    CHECK(early.unmatched == 0);
    CHECK(early.position < kRounding);
    CHECK(early.velocity < kRounding * 1.25e-3 * 3e4 / 0.2);
    CHECK(reference->contacts().size() > 5);
    // Longer: single contacts come or do not, but energy, torque and ledger belong to all particles. How much of them
    // hangs on rounding is what twins of the reference, displaced by as much, differ by.
    const Sensors a = device->advance(4000, -9.42), b = reference->advance(4000, -9.42);
    double energySpread = 0, torqueSpread = 0;
    for (const unsigned seed : {1, 2, 3, 4, 5}) {
        const Sensors twin = late(w, twinOf(p, seed));
        energySpread = std::max(energySpread, std::abs(twin.kineticEnergy / b.kineticEnergy - 1));
        torqueSpread = std::max(torqueSpread, std::abs(twin.coilTorque / b.coilTorque - 1));
    }
    CAPTURE(energySpread, torqueSpread);
    CHECK(energySpread < 1e-2);  // more would be a packing in which sums say little
    CHECK(torqueSpread < 3e-2);
    CHECK(a.count == b.count);
    CHECK(nearRelative(a.kineticEnergy, b.kineticEnergy, 3 * energySpread));
    CHECK(nearRelative(a.coilTorque, b.coilTorque, 3 * torqueSpread));
    CHECK(b.maxOverlapRatio > 1e-3);
    for (int r = 0; r < kRegions; ++r) CHECK(near(a.mass[r], b.mass[r], b.mass[0], 1e-6));
    CHECK(a.rebuilds > 2);
    requireClean(*device);
}

TEST_CASE("history follows the pair: how often the rows are rebuilt does not change a bit") {
    RuledWorld w = canisterWorld();
    const Particles p = thrownIn(97);
    w.skin = 0.05e-3;
    const auto often = played(w, p);
    w.skin = 0.6e-3;
    const auto seldom = played(w, p);
    CHECK(often->advance(0, 0).rebuilds > 3 * seldom->advance(0, 0).rebuilds);
    CHECK(often->contacts().size() > 20);
    CHECK(sameBits(often->particles(), seldom->particles()));
    CHECK(sameBits(often->contacts(), seldom->contacts()));
}

TEST_CASE("the same case gives the same bits, whatever the workgroup and the way of reading") {
    const RuledWorld w = canisterWorld();
    const Particles p = thrownIn(131);
    const auto first = played(w, p);
    VulkanOptions other;
    SECTION("again") {}
    SECTION("workgroups of 32") {
        other.workgroup = 32;
    }
    SECTION("workgroups of 128") {
        other.workgroup = 128;
    }
    SECTION("storage reads only") {
        other.reads = VulkanOptions::Reads::Storage;
    }
    SECTION("tables reached by address") {
        other = byAddress();
    }
    SECTION("tables reached by address, storage reads only") {
        other = byAddress();
        other.reads = VulkanOptions::Reads::Storage;
    }
    SECTION("dispatches in layers of two workgroups") {
        other.mostGroups = 2;
    }
    const auto second = played(w, p, other);
    CHECK(sameBits(first->particles(), second->particles()));
    CHECK(sameBits(first->contacts(), second->contacts()));
}

TEST_CASE("the bits do not depend on how the steps are cut into calls") {
    const RuledWorld w = canisterWorld();
    const Particles p = thrownIn(65);
    const auto whole = played(w, p);
    auto cut = gpu();
    cut->load(w, p);
    for (const std::uint32_t n : {1u, 200u, 1000u}) cut->advance(n, 0);
    for (const std::uint32_t n : {3u, 597u, 1000u}) cut->advance(n, -9.42);
    CHECK(whole->coilAngle() == Approx(cut->coilAngle()).epsilon(1e-12));
    CHECK(sameBits(whole->contacts(), cut->contacts()));
    CHECK(sameBits(whole->particles(), cut->particles()));
}

TEST_CASE("an isolated cluster keeps its momentum") {
    RuledWorld w = emptyWorld();
    w.gravity = Vec3(0);
    Particles p;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int x = 0; x < 4; ++x)
        for (int y = 0; y < 4; ++y)
            for (int z = 0; z < 4; ++z)
                p.add(2.3e-3 * Vec3(x, y, z), single(1.1e-3 + 1e-4 * unit(random)),
                      0.3 * Vec3(unit(random), unit(random), unit(random)) - 0.1 * Vec3(x - 1.5, y - 1.5, z - 1.5));
    const auto momentum = [&](const Particles& q) {
        Vec3 sum(0);
        for (std::size_t i = 0; i < q.size(); ++i)
            sum += w.density() * 4 / 3 * kPi * std::pow(q.radius[i], 3) * q.velocity[i];
        return sum;
    };
    auto device = gpu();
    device->load(w, p);
    const double scale = w.density() * 4 / 3 * kPi * std::pow(1.1e-3, 3) * 0.3 * 64;
    device->advance(4000, 0);
    CHECK(device->contacts().size() > 20);
    // Pair forces cancel to the last bit; what is left is each velocity's own rounding, 6e-8 a step at random.
    CHECK(near(momentum(device->particles()), momentum(p), scale, 2e-6));
}

TEST_CASE("a slow particle moves on though its step is below a float's resolution", "[every-driver]") {
    RuledWorld w = emptyWorld();
    w.gravity = Vec3(0);
    Particles p;
    p.add({0.1, 0.05, -0.1}, single(1e-3), {1e-3, -5e-4, 3e-4});
    auto device = gpu();
    device->load(w, p);
    device->advance(20000, 0);
    const Vec3 expected = p.position[0] + 20000 * w.timeStep * p.velocity[0];
    // A plain float would stand still: half an ulp at 0.1 m is 3.7 nm, the step 2.3 nm, the way 45 um.
    CHECK(near(device->particles().position[0], expected, 45e-6, 1e-4));
}

TEST_CASE("the switch of the law keeps state and history", "[every-driver]") {
    const RuledWorld w = canisterWorld();
    const Particles p = thrownIn(65);
    auto device = gpu();
    device->load(w, p);
    device->advance(1500, 0);
    const auto before = device->contacts();
    REQUIRE(before.size() > 5);
    device->setLaw(paperLaw(0.873));
    CHECK(sameBits(device->contacts(), before));
    auto kept = gpu();
    kept->load(w, p);
    kept->advance(1500, 0);
    device->advance(800, 0);
    kept->advance(800, 0);
    CHECK_FALSE(sameBits(device->particles(), kept->particles()));  // the new adhesion acts
}
