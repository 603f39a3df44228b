// Elastic adhesive spheres: contacts that hold on beyond touch, on the device as in the reference.

#include <cmath>
#include <functional>

#include "host/law/jkr.h"
#include "host/sim/energy_ledger.h"
#include "tests/scene/body_beds.h"
#include "tests/support/catch.h"
#include "tests/support/records.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr double kSphere = 1.25e-3;

/// So sticky and soft that contacts reach a fiftieth of a radius beyond touch, and so damped that a sphere hangs still.
ContactParameters gluey(double restitution = 0.05) {
    ContactParameters rest;
    rest.mu = 0.4, rest.muR = 0.2, rest.muTo = 0.1;
    rest.kr = rest.kTo = 0.3;
    rest.gammaR = rest.gammaTo = 0.2;
    rest.surfaceEnergy = 2;
    return elasticAdhesive({2e6, 0.25}, {2e6, 0.25}, restitution, rest);
}

RuledWorld glueyWorld(double restitution = 0.05) {
    RuledWorld w = emptyWorld();
    w.law.pairs.fill(gluey(restitution));
    w.law.limitFriction(CoulombLimit::Luding);
    w.energyBook = true;
    return w;
}

/// What spheres may hang from at y = 0.
struct Ceiling {
    const char* name;
    std::function<void(RuledWorld&)> put;
};

const std::vector<Ceiling>& ceilings() {
    static const geometry::Block block{Vec3(-4e-3, 0, -4e-3), Vec3(4e-3, 3e-3, 4e-3)};
    static const std::vector<Ceiling> all{
        {"a plane",
         [](RuledWorld& w) {
             w.walls = {geometry::Plane{Vec3(0), Vec3(0, -1, 0)}};
         }},
        {"a block", [](RuledWorld& w) { w.bodies = {bodyOf("block", {block})}; }},
        {"triangles", [](RuledWorld& w) { w.bodies = {bodyOf("mesh", {meshOf(block, 2.1e-3)})}; }}};
    return all;
}

/// Two equal spheres, one hanging from the other and this from the ceiling: both contacts are as near to their limits.
Particles hanging(double pressed) {
    Particles p;
    const double a = single(kSphere), b = a;
    p.add({0.3e-3, -a + pressed, 0.2e-3}, a);
    p.add({0.3e-3, -2 * a - b + 2 * pressed, 0.2e-3}, b);
    return p;
}

/// Gravity under which the more strained of the two contacts bears this share of its pull-off force [m/s2].
double gravityFor(double share, const RuledWorld& w, const Particles& p) {
    const double a = p.radius[0], b = p.radius[1];
    const double above = JkrContact(w.law.between(0, 1), 2 * a).pullOff,
                 below = JkrContact(w.law.between(0, 0), 2 * a * b / (a + b)).pullOff;
    const double lower = sphereMass(w.density(), b), both = lower + sphereMass(w.density(), a);
    return share / std::max(both / above, lower / below);
}

double gapBelow(const Particles& p) {
    return glm::distance(p.position[0], p.position[1]) - p.radius[0] - p.radius[1];
}

}  // namespace

TEST_CASE("elastic adhesive spheres hang from a ceiling and from each other until the pull is too strong") {
    for (const Ceiling& ceiling : ceilings())
        for (const bool reference : {true, false})
            for (const double share : {0.95, 1.06}) {
                CAPTURE(ceiling.name, reference, share);
                RuledWorld w = glueyWorld();
                ceiling.put(w);
                const Particles p = hanging(1e-8);
                w.gravity = Vec3(0, -gravityFor(share, w, p), 0);
                w.regions.clear();
                const auto backend = made(reference);
                backend->load(w, p);
                for (int call = 0; call < 8; ++call) backend->advance(1000, 0);
                const Particles now = backend->particles();
                const auto contacts = backend->contacts();
                if (share > 1) {
                    CHECK(contacts.size() < 2);
                    CHECK(gapBelow(now) - now.position[0].y - now.radius[0] > 1e-3);
                    continue;
                }
                REQUIRE(contacts.size() == 2);
                CHECK(gapBelow(now) > 3e-6);  // held beyond touch, and farther than the slack of a sphere at rest
                CHECK(-now.position[0].y - now.radius[0] > 3e-6);
                const auto fresh = made(reference);  // which must make its lists anew
                fresh->load(w, p);
                fresh->restore(backend->snapshot());
                fresh->advance(50, 0);
                CHECK(fresh->contacts().size() == 2);
                const double weight = sphereMass(w.density(), p.radius[1]) * glm::length(w.gravity);
                for (const Contact& c : contacts)
                    if (c.kind == ContactClass::ParticleParticle) CHECK(nearRelative(-c.force.y, weight, 2e-2));
                CHECK(near(now.velocity[1], Vec3(0), 0.1, 2e-2));
                if (!reference) requireClean(*backend);
            }
}

TEST_CASE("elastic adhesive spheres go on after a restart with the same bits, in contacts beyond touch") {
    for (const Ceiling& ceiling : ceilings())
        for (const bool reference : {true, false}) {
            CAPTURE(ceiling.name, reference);
            RuledWorld w = glueyWorld(0.1);
            ceiling.put(w);
            const Particles p = hanging(1e-8);
            w.gravity = Vec3(10, -gravityFor(0.94, w, p), 4);
            const auto whole = made(reference), second = made(reference);
            whole->load(w, p);
            int beyond = 0;
            for (int call = 0; call < 40; ++call) {
                whole->advance(37, 0);
                if (gapBelow(whole->particles()) <= 0 || whole->contacts().size() < 2) continue;
                if (++beyond > 3) break;
                const Record taken = whole->snapshot();
                second->load(w, p);
                second->restore(taken);
                checkSameArrays(taken, second->snapshot());
                const Sensors a = whole->advance(211, 0), b = second->advance(211, 0);
                CHECK(sameBits(whole->particles(), second->particles()));
                CHECK(sameBits(whole->contacts(), second->contacts()));
                CHECK(a.energy->elasticNormal == b.energy->elasticNormal);
                CHECK(a.energy->adhesive == b.energy->adhesive);
            }
            CHECK(beyond > 0);
        }
}

TEST_CASE("elastic adhesive spheres part from walls, bodies and each other on the device as in the reference",
          "[every-driver]") {
    for (const Ceiling& ceiling : ceilings()) {
        RuledWorld w = glueyWorld(0.8);
        ceiling.put(w);
        Particles p = hanging(5e-6);
        p.velocity = {Vec3(0.2, 0.1, 0), Vec3(-0.1, -0.9, 0.2)};
        p.spin = {Vec3(30, 60, -20), Vec3(-80, 10, 40)};
        auto device = gpu();
        auto reference = makeReferenceBackend();
        device->load(w, p);
        reference->load(w, p);
        bool beyond = false, parted = false;
        for (int call = 0; call < 60; ++call) {
            CAPTURE(ceiling.name, call);
            const Sensors a = device->advance(5, 0), b = reference->advance(5, 0);
            const double gap = gapBelow(reference->particles());
            const bool held = reference->contacts().size() == 2;
            beyond = beyond || (held && gap > 0);
            parted = parted || reference->contacts().size() < 2;
            const Differences d = differences(*device, *reference, 1);
            CHECK(d.unmatched == 0);
            CHECK(d.position < 2e-6);
            CHECK(d.velocity < 1e-4);
            CHECK(d.spin < 1e-3);
            CHECK(d.maxOverlap < 2e-6);
            const EnergyBook &x = *a.energy, &y = *b.energy;
            for (double EnergyBook::*term : {&EnergyBook::adhesive, &EnergyBook::plastic, &EnergyBook::viscous,
                                             &EnergyBook::sliding, &EnergyBook::elasticNormal, &EnergyBook::numerical})
                CHECK(near(x.*term, y.*term, y.kinetic, 1e-4));
        }
        CHECK(beyond);
        CHECK(parted);
        requireClean(*device);
    }
}

TEST_CASE("the lists know of contacts beyond touch: many adhesive spheres that are shaken apart") {
    RuledWorld w = glueyWorld(0.3);
    w.walls = {geometry::Plane{Vec3(0, -3.25e-3, 0), Vec3(0, 1, 0)}};
    Particles p;
    for (int n = 0; n < 27; ++n) {
        const Vec3 at = Vec3(n % 3 - 1, n / 9 - 1 + 0.2, n / 3 % 3 - 1) * (1.9992 * kSphere);
        const Vec3 jitter = Vec3(n % 4 - 1.5, n % 3 - 1.0, n % 5 - 2.0) * 0.02;
        p.add(at, single(kSphere * (1 - 0.0002 * (n % 5))), 100.0 * at + jitter);
    }
    auto device = gpu();
    auto reference = makeReferenceBackend();
    device->load(w, p);
    reference->load(w, p);
    std::size_t beyond = 0;
    EnergyLedger a, b;
    for (int call = 0; call < 12; ++call) {
        a.add(*device->advance(25, 0).energy);
        b.add(*reference->advance(25, 0).energy);
        const Particles now = reference->particles();
        const auto contacts = reference->contacts();
        for (const Contact& c : contacts)
            if (c.kind == ContactClass::ParticleParticle &&
                glm::distance(now.position[c.particle], now.position[c.other]) >
                    now.radius[c.particle] + now.radius[c.other])
                ++beyond;
        const Differences d = differences(*device, *reference, 1);
        CHECK(d.unmatched == 0);
        CHECK(d.position < 1e-5);
        CHECK(near(a.residual(), 0, b.sum.loaded, 1e-4));
        CHECK(near(b.residual(), 0, b.sum.loaded, 1e-10));
        CHECK(near(a.sum.adhesive, b.sum.adhesive, b.sum.loaded, 1e-3));
    }
    CHECK(beyond > 10);
    requireClean(*device);
}

TEST_CASE("a sphere within the reach of six faces, of which it touches one, is pulled by that one alone") {
    for (const bool reference : {true, false})
        for (const double pressed : {-4e-6, 4e-6}) {
            CAPTURE(reference, pressed);
            RuledWorld w = glueyWorld();
            w.gravity = Vec3(0);
            const double half = kSphere + 4e-6;
            w.bodies = {bodyOf("cell", {meshOf(geometry::Block{Vec3(-half), Vec3(half)}, half)})};
            Particles p;
            p.add(Vec3(0, 0, 4e-6 + pressed), single(kSphere));
            const auto backend = made(reference);
            backend->load(w, p);
            const bool touches = pressed > 0;
            backend->advance(1, 0);
            CHECK(backend->contacts().size() == (touches ? 1 : 0));
            backend->advance(300, 0);
            CHECK(backend->contacts().size() == (touches ? 1 : 0));
            const Vec3 at = backend->particles().position[0];
            CHECK(std::hypot(at.x, at.y) < (touches ? 1e-8 : 1e-12));
            if (!touches) CHECK(at.z == p.position[0].z);
            if (!reference) requireClean(*backend);
        }
}
