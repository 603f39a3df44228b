// One contact of every kind, GPU against reference: a sphere or two meet a wall, an edge, the coil or each other, with
// spin, friction, rolling and torsion all at work.

#include <algorithm>
#include <map>

#include "host/law/eepa.h"
#include "host/law/hertz.h"
#include "tests/scene/beds.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr double kSpeed = 0.5;  // [m/s] scale of the impacts below

/// Runs both backends through `steps` steps and returns their differences; the scene must end with a contact history
/// behind it.
Differences run(const RuledWorld& world, const Particles& particles, std::uint32_t steps, double rate = 0) {
    auto device = gpu();
    auto reference = makeReferenceBackend();
    device->load(world, particles);
    reference->load(world, particles);
    const Sensors a = device->advance(steps, rate), b = reference->advance(steps, rate);
    CHECK(b.maxOverlapRatio > 1e-5);  // there was a contact to compare
    CHECK(near(a.maxOverlapRatio, b.maxOverlapRatio, b.maxOverlapRatio, 1e-3));
    requireClean(*device);
    return differences(*device, *reference, kSpeed);
}

/// A collision lasts about 50 steps of forces that are right to a part in 1e6 (single precision, a few operations
/// deep); the velocity it leaves is right to about that. A wrong sign, lever or parameter is wrong by a part in one.
void requireClose(const Differences& d) {
    CHECK(d.unmatched == 0);
    CHECK(d.position < 1e-6);
    CHECK(d.velocity < 1e-5);
    CHECK(d.spin < 2e-5);
    CHECK(d.maxOverlap < 1e-6);
    CHECK(d.spring < 2e-6);
    CHECK(d.force < 5e-6);  // of k times 1e-3 of a radius: what an overlap that is off by 5e-9 of a radius does
}

/// Spheres aimed at `target` along `direction` (towards the surface) from just out of contact.
Particles thrown(const Vec3& target, const Vec3& direction, double radius, const Vec3& sideways) {
    Particles p;
    p.add(target - direction * (radius * 1.0005), single(radius), direction * 0.3 + sideways, Vec3(70, -40, 90));
    return p;
}

}  // namespace

TEST_CASE("two spheres of size ratio three collide off centre") {
    Particles p;
    p.add({0.031, -0.02, 0.045}, single(1.875e-3), {0.2, 0.05, 0}, {30, 60, -20});
    p.add({0.031 + 2.501e-3, -0.02, 0.045 + 1e-4}, single(0.625e-3), {-0.2, 0, 0.05}, {-80, 10, 40});
    RuledWorld w = emptyWorld();
    for (const auto limit : {CoulombLimit::Luding, CoulombLimit::Absolute})
        for (const auto lever : {RollingLever::Full, RollingLever::Half}) {
            w.law.limitFriction(limit);
            w.law.rollingLever = lever;
            for (const std::uint32_t steps : {20u, 75u}) requireClose(run(w, p, steps));
        }
}

TEST_CASE("two spheres stay stuck by adhesion") {
    Particles p;
    p.add({0, 0, 0}, single(1.25e-3), {0.5, 0, 0});
    p.add({2.5e-3, 0, 0}, single(1.25e-3), {-0.5, 0, 0});
    RuledWorld w = emptyWorld();
    w.law = paperLaw(0.873);
    w.gravity = Vec3(0);
    requireClose(run(w, p, 500));
}

TEST_CASE("an elastic law (k1 = k2) has no plastic limit to divide by") {
    Particles p;
    p.add({0, 0, 0}, single(1.25e-3), {0.1, 0, 0});
    p.add({2.5e-3, 0, 0}, single(1.25e-3), {-0.1, 0, 0});
    RuledWorld w = emptyWorld();
    for (ContactParameters& c : w.law.pairs) c.k1 = c.k2Max;
    requireClose(run(w, p, 15));
}

TEST_CASE("elastic spheres of Hertz and Mindlin collide off centre, and graze a floor", "[every-driver]") {
    RuledWorld w = emptyWorld();
    const ContactParameters usual = w.law.of(ContactClass::ParticleParticle);
    ContactParameters elastic = hertzMindlin({2e6, 0.25}, {2e7, 0.3}, 0.7);
    elastic.mu = usual.mu, elastic.muR = usual.muR, elastic.muTo = usual.muTo;
    elastic.kr = elastic.kTo = 0.3;
    elastic.gammaR = elastic.gammaTo = 0.2;
    w.law.pairs.fill(elastic);
    w.walls = {geometry::Plane{{0, -2e-3, 0}, {0, 1, 0}}};
    Particles p;
    p.add({0.031, 0.02, 0.045}, single(1.875e-3), {0.2, 0.05, 0}, {30, 60, -20});
    p.add({0.031 + 2.501e-3, 0.02, 0.045 + 1e-4}, single(0.625e-3), {-0.2, 0, 0.05}, {-80, 10, 40});
    p.add({0, -0.7e-3, 0}, single(1.3005e-3), {0.3, -0.3, 0.1}, {70, -40, 90});
    for (const std::uint32_t steps : {20u, 75u}) requireClose(run(w, p, steps));
}

TEST_CASE("elasto-plastic adhesive spheres collide off centre, and graze a floor", "[every-driver]") {
    RuledWorld w = emptyWorld();
    const ContactParameters usual = w.law.of(ContactClass::ParticleParticle);
    ContactParameters rest;
    rest.mu = usual.mu, rest.muR = usual.muR, rest.muTo = usual.muTo;
    rest.kr = rest.kTo = 0.3;
    rest.gammaR = rest.gammaTo = 0.2;
    struct Adhesion {
        const char* name;
        double ratio, energy, pull, exponent;
    };
    for (const Adhesion& a : {Adhesion{"plastic alone", 0.5, 0, 0, 1.5},
                              {"pull of the patch", 0.5, 2, 0, 1.5},
                              {"pull at its limit, which fades slowly", 0.6, 500, 0, 1},
                              {"pull that fades soon, and a constant one", 0.3, 1, 2e-4, 4}})
        DYNAMIC_SECTION(a.name) {
            rest.plasticityRatio = a.ratio;
            rest.surfaceEnergy = a.energy;
            rest.constantPull = a.pull;
            rest.adhesionExponent = a.exponent;
            w.law.pairs.fill(elastoPlasticAdhesive({2e6, 0.25}, {2e7, 0.3}, 0.7, rest));
            w.law.limitFriction(a.pull > 0 ? CoulombLimit::Luding : CoulombLimit::Absolute);
            w.walls = {geometry::Plane{{0, -2e-3, 0}, {0, 1, 0}}};
            Particles p;
            p.add({0.031, 0.02, 0.045}, single(1.875e-3), {0.2, 0.05, 0}, {30, 60, -20});
            p.add({0.031 + 2.501e-3, 0.02, 0.045 + 1e-4}, single(0.625e-3), {-0.2, 0, 0.05}, {-80, 10, 40});
            p.add({0, -0.7e-3, 0}, single(1.3005e-3), {0.3, -0.3, 0.1}, {70, -40, 90});
            for (const std::uint32_t steps : {20u, 75u, 140u}) requireClose(run(w, p, steps));
        }
}

TEST_CASE("an elasto-plastic adhesive law without plasticity moves spheres as Hertz does") {
    RuledWorld plastic = emptyWorld(), elastic = emptyWorld();
    plastic.law.pairs.fill(elastoPlasticAdhesive({2e6, 0.25}, {2e7, 0.3}, 0.7, {}));
    elastic.law.pairs.fill(hertzMindlin({2e6, 0.25}, {2e7, 0.3}, 0.7));
    Particles p;
    p.add({0, 0, 0}, single(1.25e-3), {0.2, 0, 0});
    p.add({2.5005e-3, 0, 0}, single(1.25e-3), {-0.2, 0, 0});
    auto a = gpu(), b = gpu();
    a->load(plastic, p);
    b->load(elastic, p);
    a->advance(400, 0);
    b->advance(400, 0);
    CHECK(a->contacts().empty());
    CHECK(near(a->particles().velocity[0], b->particles().velocity[0], kSpeed, 1e-5));
}

TEST_CASE("a sphere meets every surface", "[every-driver]") {
    RuledWorld w = emptyWorld();
    const double a = single(1.25e-3), s = std::sqrt(0.5);
    struct Shot {
        const char* name;
        geometry::Surface surface = geometry::Plane{Vec3(0), Vec3(0, 1, 0)};
        Vec3 target, direction;
    };
    const double rho = 0.0115;
    const geometry::Front front{0.06, rho, 0.01};
    const Shot shots[] = {
        {"plane", geometry::Plane{{0, -0.01, 0}, {0, 1, 0}}, {0.02, -0.01, 0.03}, {0, -1, 0}},
        {"oblique plane", geometry::Plane{{0.01, -0.01, 0}, {-s, s, 0}}, {0.01, -0.01, 0.03}, {s, -s, 0}},
        {"trough bottom", geometry::Trough{rho}, {rho * 0.6, -rho * 0.8, 0.02}, {0.6, -0.8, 0}},
        {"trough wall", geometry::Trough{rho}, {rho, 0.02, 0.02}, {1, 0, 0}},
        {"other trough wall", geometry::Trough{rho}, {-rho, 0.02, 0.02}, {-1, 0, 0}},
        {"front wall", front, {0, 0.02, 0.06}, {0, 0, 1}},
        {"throat", front, {rho * 0.8, rho * 0.6, 0.065}, {0.8, 0.6, 0}},
        {"rim of the hole", front, {0, rho, 0.06}, {0, s, s}},
        {"tube from inside", geometry::Tube{{0, 0, 0}, {0, 1, 0}, rho, 0.05, true}, {rho, 0.03, 0}, {1, 0, 0}},
        {"tube from outside", geometry::Tube{{0, 0, 0}, {s, s, 0}, rho, 0.05, false}, {0.02, 0.02, rho}, {0, 0, -1}},
        {"endless tube behind its base", geometry::Tube{{0, 0, 0}, {0, 1, 0}, rho}, {rho, -0.03, 0}, {1, 0, 0}},
        {"end of a plane", geometry::Plane{{0, -0.01, 0}, {0, 1, 0}, 0.03}, {0.004, -0.01, 0.03}, {0, -s, -s}},
        {"end of the trough", geometry::Trough{rho, 0.03}, {rho * 0.6, -rho * 0.8, 0.03}, {s * 0.6, s * -0.8, -s}},
        {"end of the trough's side", geometry::Trough{rho, 0.03}, {rho, 0.02, 0.03}, {s, 0, -s}},
        {"edge of a tube", geometry::Tube{{0, 0, 0}, {0, 0, 1}, rho, 0.05, true}, {rho, 0, 0}, {s, 0, s}},
    };
    for (const Shot& shot : shots) {
        DYNAMIC_SECTION(shot.name) {
            w.walls = {shot.surface};
            const Vec3 sideways = 0.1 * Vec3(shot.direction.y, shot.direction.z, shot.direction.x);
            requireClose(run(w, thrown(shot.target, shot.direction, a, sideways), 100));
        }
    }
    SECTION("not the end of a tube along x from a place on its axis") {
        w.walls = {geometry::Tube{{0, 0, 0}, {1, 0, 0}, 0.01, 0.05, true}};
        Particles p;
        p.add({0.06, 0, 0}, a, Vec3(0));
        auto device = gpu();
        device->load(w, p);
        device->advance(1, 0);
        CHECK(device->contacts().empty());
    }
    SECTION("behind surfaces whose kind no constant holds") {
        for (int i = 0; i < 9; ++i) w.walls.push_back(geometry::Plane{{0, -0.5, 0}, {0, 1, 0}});
        w.walls.push_back(geometry::Trough{rho});
        requireClose(run(w, thrown({rho, 0.02, 0.02}, {1, 0, 0}, a, {0, 0.1, 0.2}), 100));
    }
}

TEST_CASE("spheres pressed against the coil wherever it is") {
    // The wire's phase is good to 3e-7 rad in single precision, of 10.4 mm: overlaps to 3e-9 m, a part in 700 of the 2
    // um the spheres are pressed in. The way they then go, some 20 um, is off by that part: 3e-8 m or 4e-5 of a radius.
    // Where a contact is pulled back on the adhesive branch, delta_max answers to the overlap with a slope of
    // (k2 + kc)/(k2 - k1), 40 at this depth: 1.2e-7 m or 2e-4 of a radius.
    RuledWorld w = canisterWorld();
    w.walls.clear();
    w.gravity = Vec3(0);
    std::size_t most = 0;
    for (const int hand : {1, -1}) {
        for (const double pitch : {0.00875, 0.0035, 0.0175}) {
            w.coil->hand = hand;
            w.coil->pitch = pitch;
            CAPTURE(hand, pitch);
            const Particles p = aroundTheWire(*w.coil, single(0.9e-3));
            REQUIRE(p.size() > 20);
            const Differences d = run(w, p, 60, -hand * 9.42);
            CHECK(d.unmatched == 0);
            CHECK(d.position < 1e-4);
            CHECK(d.velocity < 5e-3);
            CHECK(d.maxOverlap < 5e-4);
            CHECK(d.spring < 1e-4);
            // While all are in touch: overlaps good to 3e-9 m, on k2, against k times 1e-3 of a radius. What a sphere
            // between two turns gets from one and from the other differs by 0.07 of that.
            const Differences early = run(w, p, 5, -hand * 9.42);
            CHECK(early.force < 4e-3);
            auto reference = makeReferenceBackend();
            reference->load(w, p);
            reference->advance(1, 0);
            std::map<std::uint32_t, std::size_t> turns;
            for (const Contact& c : reference->contacts()) most = std::max(most, ++turns[c.particle]);
        }
    }
    CHECK(most >= 2);  // two turns were touched at once somewhere
}

TEST_CASE("spheres against a coil whose surface they see at rest, or whose wire they see curved") {
    RuledWorld w = canisterWorld();
    w.walls.clear();
    w.gravity = Vec3(0);
    const Particles p = aroundTheWire(*w.coil, single(0.9e-3));
    auto usual = makeReferenceBackend(), other = makeReferenceBackend();
    usual->load(w, p);
    SECTION("at rest") {
        w.coilSurfaceMoves = false;
    }
    SECTION("curved") {
        w.coilWireCurved = true;
    }
    other->load(w, p);
    usual->advance(30, -9.42);
    other->advance(30, -9.42);
    CHECK(differences(*usual, *other, kSpeed).velocity > 0.01);  // a mix-up would show
    // Tolerances as for any sphere pressed against the coil, above.
    const Differences d = run(w, p, 60, -9.42);
    CHECK(d.unmatched == 0);
    CHECK(d.position < 1e-4);
    CHECK(d.velocity < 5e-3);
    CHECK(d.maxOverlap < 5e-4);
    CHECK(d.spring < 1e-4);
    CHECK(run(w, p, 5, -9.42).force < 4e-3);
}

TEST_CASE("the comparison of two backends sees what it is there to see") {
    Particles p = thrown({0.02, -0.01, 0.03}, {0, -1, 0}, single(1.25e-3), {0.1, 0, 0.05});
    RuledWorld w = emptyWorld();
    w.walls = {geometry::Plane{{0, -0.01, 0}, {0, 1, 0}}};
    const auto played = [](const RuledWorld& world, const Particles& particles) {
        auto backend = makeReferenceBackend();
        backend->load(world, particles);
        backend->advance(30, 0);
        return backend;
    };
    const auto sound = played(w, p);
    RuledWorld other = w;
    other.law.of(ContactClass::ParticleWall).mu *= 1.001;
    CHECK(differences(*played(other, p), *sound, kSpeed).velocity > 1e-5);
    other = w;
    other.law.of(ContactClass::ParticleWall).muR *= 1.01;
    CHECK(differences(*played(other, p), *sound, kSpeed).spin > 2e-5);
    other = w;
    other.walls.clear();
    CHECK(differences(*played(other, p), *sound, kSpeed).unmatched == 1);
    CHECK(differences(*played(w, p), *sound, std::nan("")).velocity == INFINITY);
}
