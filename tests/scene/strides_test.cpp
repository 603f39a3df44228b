// Where strides end and lists are made anew follows from the number of the step and the state alone, and no bit of a
// result depends on where it is.

#include <random>

#include "host/law/jkr.h"
#include "tests/scene/body_beds.h"
#include "tests/support/catch.h"
#include "tests/support/records.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

struct Scene {
    RuledWorld world;
    Particles particles;
    double rate;  ///< of the drive [rad/s]
};

/// Spheres between a drum that turns and a rod at rest, which shear them.
Scene shearFlow(NormalLaw law = NormalLaw::Luding) {
    RuledWorld w = emptyWorld();
    const Vec3 z(0, 0, 1);
    w.domain = {Vec3(-0.02, -0.02, -0.01), Vec3(0.02, 0.02, 0.02)};
    w.maxOverlapRatio = 1;
    w.walls = {geometry::Plane{{0, 0, 0}, {0, 0, 1}}, geometry::Plane{{0, 0, 10e-3}, {0, 0, -1}}};
    w.bodies.push_back(
        bodyOf("drum", {geometry::Cone{Vec3(0), z, 14e-3, 14e-3, 10e-3}}, geometry::Turn{z, Vec3(0), 40}));
    w.bodies.push_back(
        bodyOf("vane", {meshOf(geometry::Block{Vec3(-2e-3, -9e-3, -1e-3), Vec3(2e-3, 4e-3, 11e-3)}, 3e-3)}));
    if (law == NormalLaw::Jkr) {
        ContactParameters sticky;
        sticky.surfaceEnergy = 0.5;
        w.law.pairs.fill(elasticAdhesive({2e6, 0.25}, {2e6, 0.25}, 0.7, sticky));
    }
    Particles p;
    std::mt19937 random(29);
    std::uniform_real_distribution<double> radius(0.95e-3, 1.15e-3), speed(-0.3, 0.3);
    for (int x = -5; x <= 5; ++x)
        for (int y = -5; y <= 5; ++y)
            for (int layer = 0; layer < 4; ++layer) {
                const Vec3 at(2.31e-3 * x, 2.31e-3 * y, 1.3e-3 + 2.4e-3 * layer);
                if (std::hypot(at.x, at.y) > 12.8e-3 || (std::abs(at.x) < 3.2e-3 && at.y > -10.2e-3 && at.y < 5.2e-3))
                    continue;
                p.add(at, single(radius(random)), {speed(random), speed(random), speed(random)});
            }
    return {w, p, 0};
}

/// Bodies that turn, shake and follow the drive.
Scene amongBodies() {
    RuledWorld w = deviceWorld();
    w.maxOverlapRatio = 1;
    Particles p = layers(61);
    std::mt19937 random(31);
    std::uniform_real_distribution<double> speed(-2, 2);
    for (Vec3& v : p.velocity) v += Vec3(speed(random), speed(random), speed(random));
    return {w, p, kDrive};
}

Scene inCanister() {
    RuledWorld w = canisterWorld();
    w.maxOverlapRatio = 1;
    return {w, thrownIn(103), -9.5};
}

/// A body that the spheres push away.
Scene withFreeBody() {
    Scene s = amongBodies();
    s.world.bodies.push_back(bodyOf("float", {geometry::Ball{Vec3(0, -10e-3, 2.6e-3), 2e-3}},
                                    geometry::Free{2e-5, Vec3(0, 0.2, 0.1)}, Clock::Forces));
    return s;
}

/// Small, slow spheres far from the origin, where a float knows places to a thousandth of a radius, which is more than
/// they go in many steps.
Scene farOff() {
    RuledWorld w = emptyWorld();
    w.domain = {Vec3(0.89), Vec3(0.91)};
    w.gravity = Vec3(0);
    w.maxOverlapRatio = 1;
    w.timeStep = 1e-8;
    w.skin = 5e-6;
    const double a = single(50e-6);
    w.walls = {geometry::Plane{Vec3(0.9 - 3e-4), {0, 1, 0}}, geometry::Plane{Vec3(0.9 - 3e-4), {1, 0, 0}},
               geometry::Plane{Vec3(0.9 - 3e-4), {0, 0, 1}}};
    for (ContactParameters& c : w.law.pairs) {
        c.k1 /= 5;
        c.k2Max /= 5;
        c.gamma = c.gammaT = c.gammaR = c.gammaTo = 0;
    }
    // Along x two and two come nearer, all as fast as each other, so that all use up their slack together. It is just
    // more than two units of the last place, so that they may go two and a half.
    constexpr double kSpeed = 0.0415;
    Particles p;
    std::mt19937 random(17);
    std::uniform_real_distribution<double> jitter(-2.5e-7, 2.5e-7);
    for (int x = 0; x < 4; ++x)
        for (int y = 0; y < 14; ++y)
            for (int z = 0; z < 14; ++z)
                p.add(Vec3(0.9 - 2.4e-4) + 1.01e-4 * Vec3(x, 1.2 * y, 1.2 * z) + Vec3(jitter(random)), a,
                      Vec3(x % 2 == 0 ? kSpeed : -kSpeed, 0, 0));
    return {w, p, 0};
}

std::unique_ptr<Backend> begun(const Scene& scene, std::uint32_t batch = 0) {
    VulkanOptions options;
    options.batch = batch;
    auto backend = gpu(options);
    backend->load(scene.world, scene.particles);
    return backend;
}

void checkSame(const Backend& a, const Backend& b) {
    CHECK(sameBits(a.particles(), b.particles()));
    CHECK(sameBits(a.contacts(), b.contacts()));
}

/// Cuts `steps` at random into calls of at most `most`, and calls `after` behind each.
template <class After>
void advanceInPieces(Backend& backend, std::uint32_t steps, std::uint32_t most, double rate, std::mt19937& random,
                     After after) {
    while (steps > 0) {
        const std::uint32_t piece = std::min(steps, std::uint32_t(1 + random() % most));
        backend.advance(piece, rate);
        steps -= piece;
        if (steps > 0) after();
    }
}

/// Makes rows and contact lists anew before the next step.
void forceLists(Backend& backend, const Scene& scene) {
    backend.addParticles(scene.particles.size(), {});
}

void listsFallAtTheSameSteps(const Scene& scene) {
    const auto whole = begun(scene), cut = begun(scene), small = begun(scene, 5);
    std::mt19937 random(41);
    std::uint32_t before = 0;
    std::size_t contacts = 0;
    for (int call = 0; call < 8; ++call) {
        const std::uint32_t steps = 257 + 31 * std::uint32_t(call);
        const Sensors sensors = whole->advance(steps, scene.rate);
        advanceInPieces(*cut, steps, call % 2 == 0 ? 7 : 90, scene.rate, random, [] {});
        CHECK(small->advance(steps, scene.rate).rebuilds == sensors.rebuilds);
        CHECK(refreshes(*cut) == refreshes(*whole));
        CHECK(refreshes(*small) == refreshes(*whole));
        CHECK(cut->advance(0, 0).rebuilds == sensors.rebuilds);
        checkSame(*cut, *whole);
        checkSame(*small, *whole);
        CHECK(refreshes(*whole) > before);
        before = refreshes(*whole);
        contacts += whole->contacts().size();
    }
    CHECK(contacts > 50);
    requireClean(*cut);
}

/// No list misses a contact: lists that are always new have no more than those that are kept as long as they hold.
void listsMissNothing(const Scene& scene, std::uint32_t steps) {
    const auto kept = begun(scene), always = begun(scene), forced = begun(scene);
    std::mt19937 random(43);
    std::size_t contacts = 0;
    for (int call = 0; call < 10; ++call) {
        kept->advance(steps, scene.rate);
        for (std::uint32_t step = 0; step < steps; ++step) {
            forceLists(*always, scene);
            always->advance(1, scene.rate);
        }
        advanceInPieces(*forced, steps, 200, scene.rate, random, [&] {
            if (random() % 2 == 0) forceLists(*forced, scene);
        });
        checkSame(*always, *kept);
        checkSame(*forced, *kept);
        contacts += kept->contacts().size();
    }
    CHECK(refreshes(*always) >= 10 * steps);
    CHECK(refreshes(*kept) < 5 * steps);
    CHECK(contacts > 20);
    requireClean(*forced);
}

}  // namespace

TEST_CASE("contact lists are made anew at the same steps however a run is cut into calls and batches") {
    SECTION("sheared") {
        listsFallAtTheSameSteps(shearFlow());
    }
    SECTION("among bodies") {
        listsFallAtTheSameSteps(amongBodies());
    }
    SECTION("with a body that moves freely") {
        listsFallAtTheSameSteps(withFreeBody());
    }
    SECTION("in a canister") {
        listsFallAtTheSameSteps(inCanister());
    }
}

TEST_CASE("lists that are kept miss no contact that lists made in every step have") {
    SECTION("sheared") {
        listsMissNothing(shearFlow(), 150);
    }
    SECTION("sheared, under JKR") {
        listsMissNothing(shearFlow(NormalLaw::Jkr), 150);
    }
    SECTION("among bodies") {
        listsMissNothing(amongBodies(), 150);
    }
    SECTION("far from the origin") {
        listsMissNothing(farOff(), 180);
    }
}

TEST_CASE("a long shear flow has the same bits when lists are forced and calls are cut at random") {
    const Scene scene = shearFlow();
    constexpr std::uint32_t kSteps = 12'000;
    const auto whole = begun(scene);
    whole->advance(kSteps, 0);
    REQUIRE(whole->contacts().size() > 100);
    std::mt19937 random(47);
    const auto cut = begun(scene, 13);
    advanceInPieces(*cut, kSteps, 400, 0, random, [&] {
        if (random() % 3 == 0) forceLists(*cut, scene);
    });
    checkSame(*cut, *whole);

    // Resumed at any step, a run goes on with the same bits, and its strides end where they did.
    auto resumed = begun(scene);
    for (std::uint32_t left = kSteps; left > 0;) {
        const std::uint32_t piece = std::min(left, std::uint32_t(1 + random() % 4'000));
        resumed->advance(piece, 0);
        left -= piece;
        const Record taken = resumed->snapshot();
        resumed = begun(scene);
        resumed->restore(taken);
    }
    CHECK(sameBits(resumed->particles(), whole->particles()));
}
