// contact.soften: spheres that are s times as soft bear the same loads with overlaps s times as large. The claims are
// those of physics.md, "Similar softer spheres", where they hold and where they end.

#include <array>
#include <cmath>

#include "host/backend/reference/contact.h"
#include "host/law/luding.h"
#include "host/model/case.h"
#include "tests/law/setups.h"
#include "tests/support/catch.h"
#include "tests/support/folder.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr double kFactors[] = {2, 4, 8};

/// The parameters of the paper as a case has them when it is softened by `s`.
ContactLaw softLaw(double s, const std::vector<std::string>& more = {}) {
    const Folder folder;
    folder.write("two.csv", "x,y,z,r\n0,0,0,1.25e-3\n0,5e-3,0,1.25e-3\n");
    const auto file = folder.write("case.toml", R"(boundaries = "none"
gravity = [0, 0, 0]
[particles]
density = 1427.0
list = "two.csv"
[contact]
k = 24067.0
k1_over_k = 0.2
kc_over_k = 0.873
plasticity_depth = 0.05
damping = 0.0827
friction = 0.5
rolling_friction = 0.5
torsion_friction = 0.1
[settle]
time_s = 0.01
)");
    std::vector<std::string> overrides{"contact.soften=" + std::to_string(s)};
    overrides.insert(overrides.end(), more.begin(), more.end());
    return loadCase(file, overrides).dosingLaw;
}

ContactParameters soft(double s, const std::vector<std::string>& more = {}) {
    return softLaw(s, more).of(ContactClass::ParticleParticle);
}

/// Speed ratio of two mean spheres after they met head-on at `speed` each; 0 if they stick.
double restitution(const ContactParameters& p, double speed, double dt) {
    RuledWorld world = freeWorld(p, dt);
    world.maxOverlapRatio = 1;
    Particles two;
    two.add(Vec3(0), kRadius, Vec3(speed, 0, 0));
    two.add(Vec3(2.0001 * kRadius, 0, 0), kRadius, Vec3(-speed, 0, 0));
    auto backend = makeReferenceBackend();
    backend->load(world, two);
    for (int n = 0; n < 200; ++n) {
        backend->advance(200, 0);
        const Particles now = backend->particles();
        if (backend->contacts().empty() && now.velocity[0].x < 0) return -now.velocity[0].x / speed;
    }
    return 0;
}

double collisionStep(const ContactParameters& p) {
    return 1e-3 * kPi * std::sqrt(massOf(kRadius) / 2 / p.k2Max);
}

}  // namespace

TEST_CASE("soften: every path of overlaps that is s times as wide gives the same force, to the pull-off and back") {
    const ContactParameters hard = soft(1);
    const double limit = 1.25 * 0.05 * kRadius;
    // Loading, unloading through zero to the adhesive branch, reloading, beyond the plastic limit, and off.
    const double path[] = {0.1, 0.5, 0.45, 0.3, 0.2, 0.1, 0.4, 0.9, 0.7, 1.3, 2, 1.5, 0.9, 0.5, 0.2, 0.05};
    for (const double s : kFactors) {
        const ContactParameters p = soft(s);
        double hardMax = 0, softMax = 0, strongest = 0;
        for (const double part : path) {
            const double overlap = part * limit, f = normalForce(hard, overlap, kRadius, hardMax);
            const double g = normalForce(p, s * overlap, kRadius, softMax);
            CAPTURE(s, part);
            CHECK(near(g, f, hard.k1 * limit, kRounding));
            CHECK(near(softMax, s * hardMax, s * limit, kRounding));
            strongest = std::max(strongest, -f);
        }
        CHECK(strongest > 0.1 * hard.k1 * limit);  // there was a pull to compare
    }
}

TEST_CASE("soften: friction, rolling and torsion of a slow motion are the same, under both limits") {
    for (const CoulombLimit limit : {CoulombLimit::Luding, CoulombLimit::Absolute}) {
        ContactLaw hard = softLaw(1);
        hard.limitFriction(limit);
        for (const double s : kFactors) {
            ContactLaw law = softLaw(s);
            law.limitFriction(limit);
            reference::History a, b;
            const double overlap = 2e-6;
            for (int n = 0; n < 40; ++n) {
                // The springs advance by the motion times the time: s times the way, in so many steps of a second. The
                // speeds of some 10 nm/s make the dashpots' part 1e-6 of the springs'.
                const auto touch = [&](double wider) {
                    reference::Touch t{};
                    t.normal = Vec3(0, 1, 0);
                    t.overlap = wider * overlap;
                    t.reduced = t.smaller = kRadius;
                    t.velocity = wider * Vec3(2e-8, 0, 1e-8 * (n % 3));
                    t.spin = wider * Vec3(3e-5, 1e-5, 0);
                    return t;
                };
                const auto f = reference::contactResponse(hard, pairOf(ContactClass::ParticleParticle), touch(1), 1, a);
                const auto g = reference::contactResponse(law, pairOf(ContactClass::ParticleParticle), touch(s), 1, b);
                CAPTURE(s, n);
                CHECK(near(g.force, f.force, kK1 * overlap, 1e-6));
                CHECK(near(g.couple, f.couple, kK1 * overlap * kRadius, 1e-6));
                CHECK(near(b.sliding, s * a.sliding, s * overlap, 1e-6));
            }
        }
    }
}

TEST_CASE("soften: a stack at rest bears its weight with overlaps s times as large") {
    const double weight = massOf(kRadius) * kGravity;
    for (const double s : {1.0, 4.0}) {
        const ContactParameters p = soft(s);
        RuledWorld world = planeWorld(p, 2e-6 * std::sqrt(s));
        world.gravity = Vec3(0, -kGravity, 0);
        Particles two;
        two.add(Vec3(0, kRadius, 0), kRadius);
        two.add(Vec3(0, 3 * kRadius, 0), kRadius);
        auto backend = makeReferenceBackend();
        backend->load(world, two);
        backend->advance(100000, 0);  // 0.2 s, of which damping needs some 0.01
        const auto contacts = backend->contacts();
        REQUIRE(contacts.size() == 2);
        double lower = 0, upper = 0;
        for (const Contact& c : contacts) (c.kind == ContactClass::ParticleWall ? lower : upper) = c.force.y;
        CHECK(near(lower, 2 * weight, weight, 1e-6));
        CHECK(near(std::abs(upper), weight, weight, 1e-6));
        // The floor is two weights deep on k1 at least; from loading it swung once to twice that, and unloads on k2.
        const double depth = kRadius - backend->particles().position[0].y;
        const double loaded = s * 2 * weight / kK1;
        CHECK(depth > 0.9 * loaded);
        CHECK(depth < 2.1 * loaded);
        if (s > 1) continue;
        const ContactParameters q = soft(4);
        RuledWorld softer = world;
        softer.law = lawOf(q);
        softer.timeStep *= 2;
        auto twin = makeReferenceBackend();
        twin->load(softer, two);
        twin->advance(100000, 0);
        // Falling in from rest is similar too: gravity's part of the motion is the same, over twice the time.
        CHECK(nearRelative(kRadius - twin->particles().position[0].y, 4 * depth, 1e-3));
    }
}

TEST_CASE(
    "soften: after an elastic settling a sphere pulls as strongly as its weight asks for, however soft and fast") {
    const double weight = massOf(kRadius) * kGravity;
    for (const double s : {1.0, 4.0})
        for (const double speed : {0.1, 0.4}) {
            const ContactLaw plastic = softLaw(s);
            const ContactParameters& p = plastic.of(ContactClass::ParticleWall);
            ContactLaw elastic = plastic;
            for (ContactParameters& c : elastic.pairs) c.k2Max = c.k1;
            RuledWorld world = planeWorld(p, collisionStep(p));
            world.gravity = Vec3(0, -kGravity, 0);
            world.maxOverlapRatio = 1;
            Particles one;
            one.add(Vec3(0, 1.001 * kRadius, 0), kRadius, Vec3(0, -speed, 0));
            auto backend = makeReferenceBackend();
            backend->load(world, elastic, one);
            const auto steps = static_cast<std::uint32_t>(0.5 / world.timeStep);
            const double deepest = backend->advance(steps, 0).maxOverlapRatio * kRadius;
            backend->setLaw(plastic);
            backend->advance(100, 0);
            const auto contacts = backend->contacts();
            REQUIRE(contacts.size() == 1);
            CAPTURE(s, speed);
            CHECK(near(contacts[0].force.y, weight, weight, 1e-3));
            CHECK(deepest > 20 * contacts[0].maxOverlap);
            CHECK(nearRelative(pullOff(p, 2 * kRadius, contacts[0].maxOverlap), pullOffUnder(p, 2 * kRadius, weight),
                               1e-3));
        }
}

TEST_CASE("soften: without plasticity a head-on collision keeps its restitution at any speed, by the closed form") {
    const double m12 = massOf(kRadius) / 2;
    for (const double s : {1.0, 2.0, 8.0}) {
        const ContactParameters p = soft(s, {"contact.k1_over_k=1", "contact.kc_over_k=0"});
        const double eta = p.gamma / (2 * m12), expected = std::exp(-eta * kPi / std::sqrt(p.k1 / m12 - eta * eta));
        CHECK(expected < 0.9);
        CHECK(nearRelative(restitution(p, 0.1, collisionStep(p)), expected, 2e-3));  // damping is of first order
        const double hardEta = 0.0827 / (2 * m12);
        CHECK(nearRelative(expected, std::exp(-hardEta * kPi / std::sqrt(24067 / m12 - hardEta * hardEta)), 1e-12));
    }
}

TEST_CASE(
    "soften: with plasticity a collision is similar to one that is √s times as slow, so the same speed is weaker") {
    // Luding's restitution without damping, kappa = k2/k1 at the largest overlap, chi = kc/k1.
    const auto closedForm = [](const ContactParameters& p, double speed) {
        const double deepest = 2 * speed * std::sqrt(massOf(kRadius) / 2 / p.k1);
        const double limit = p.k2Max / (p.k2Max - p.k1) * p.plasticityDepth * kRadius;
        REQUIRE(deepest < limit);
        const double kappa = (p.k1 + (p.k2Max - p.k1) * deepest / limit) / p.k1, chi = p.kc / p.k1;
        return std::sqrt(1 / kappa - chi * (kappa - 1) * (kappa - 1) / (kappa * (kappa + chi)));
    };
    const std::vector<std::string> undamped{"contact.damping=0", "contact.kc_over_k=0.1"};
    const double speed = 0.1;
    const ContactParameters hard = soft(1, undamped), four = soft(4, undamped);
    const double e = closedForm(hard, speed);
    CHECK(nearRelative(closedForm(four, 2 * speed), e, 1e-12));
    CHECK(closedForm(four, speed) > 1.05 * e);
    CHECK(nearRelative(restitution(hard, speed, collisionStep(hard)), e, 2e-3));
    CHECK(nearRelative(restitution(four, 2 * speed, collisionStep(four)), e, 2e-3));
    CHECK(nearRelative(restitution(four, speed, collisionStep(four)), closedForm(four, speed), 2e-3));
}
