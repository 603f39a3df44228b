// Materials: pairs of them, and the figures that are judged over all pairs.
#include <set>

#include "host/law/jkr.h"
#include "host/model/case.h"
#include "host/model/stability.h"
#include "tests/support/catch.h"

using namespace vkdose;

namespace {

constexpr int kSecond = 3, kPlate = 4;

/// Two powders in a box of plates and on a floor, and a coil.
World twoPowders() {
    World w;
    w.density() = 1000;
    w.materials.push_back({"salt", true, 2000});
    w.materials.push_back({"plate", false, 0});
    w.walls = {geometry::Plane{{0, 0, 0}, {0, 1, 0}}};
    return w;
}

std::set<std::string> pairNames(const World& w) {
    std::set<std::string> names;
    for (const MaterialPair& pair : occurringPairs(w)) CHECK(names.insert(nameOf(w, pair)).second);
    return names;
}

}  // namespace

TEST_CASE("materials: every pair has one place, whichever comes first") {
    std::set<std::size_t> places;
    for (int a = 0; a < kMostMaterials; ++a)
        for (int b = 0; b <= a; ++b) {
            CHECK(PairTable::index({a, b}) == PairTable::index({b, a}));
            CHECK(places.insert(PairTable::index({a, b})).second);
        }
    CHECK(*places.rbegin() == places.size() - 1);
    ContactLaw law;
    law.between(0, 2).mu = 0.5;
    law.pairs.resize(5);
    law.between(4, 1).mu = 0.25;
    CHECK(law.between(2, 0).mu == 0.5);
    CHECK(law.of(ContactClass::ParticleCoil).mu == 0.5);
    CHECK(law.between(1, 4).mu == 0.25);
    CHECK_THROWS_AS(law.between(0, 5), std::out_of_range);
}

TEST_CASE("materials: pairs occur of powders with powders, and with what there is of walls and bodies") {
    World w = twoPowders();
    CHECK(pairNames(w) ==
          std::set<std::string>{"particle-particle", "particle-salt", "particle-wall", "salt-salt", "salt-wall"});
    w.walls.front().material = kPlate;
    w.coil = geometry::Coil{};
    CHECK(pairNames(w) == std::set<std::string>{"particle-particle", "particle-salt", "particle-plate", "particle-coil",
                                                "salt-salt", "salt-plate", "salt-coil"});
    RigidBody ball;
    ball.material = kSecond;  // a body made of what a powder is made of
    w.bodies.push_back(ball);
    CHECK(pairNames(w).size() == 7);
    ball.material = kWallMaterial;
    w.bodies.push_back(ball);
    CHECK(pairNames(w).count("salt-wall") == 1);
    World usual;
    CHECK(pairNames(usual) == std::set<std::string>{"particle-particle"});
}

TEST_CASE("materials: particles carry theirs") {
    Particles p, more;
    p.add(Vec3(0), 1e-3);
    more.add(Vec3(1), 2e-3, Vec3(0), Vec3(0), kSecond);
    p.append(more);
    CHECK(p.material == std::vector<std::uint8_t>{0, kSecond});
    const World w = twoPowders();
    CHECK(massOf(w, p, 1) == sphereMass(2000, 2e-3));
    const PowderSizes sizes = powderSizes(w, p);
    CHECK(sizes[0].largest == 1e-3);
    CHECK(sizes[kSecond].smallest == 2e-3);
    CHECK(sizes[kSecond].mean == 2e-3);
    CHECK(std::isinf(sizes[kPlate].smallest));
    CHECK(overall(sizes).smallest == 1e-3);
    CHECK(overall(sizes).largest == 2e-3);
}

TEST_CASE("materials: the modes of a contact are those of its pair and of the smallest spheres of both powders") {
    const World w = twoPowders();
    const double a = 1e-3, b = 0.5e-3;
    PowderSizes sizes(w.materials.size());
    sizes[0] = {a, 2e-3, 1.5e-3};
    sizes[kSecond] = {b, 2e-3, 1e-3};
    ContactLaw law;
    law.pairs.resize(5);
    const auto spring = [](double k) {
        ContactParameters p;
        p.k1 = p.k2Max = k;
        return p;
    };
    law.between(0, 0) = spring(1000);
    ContactParameters& pair = law.between(0, kSecond) = spring(3000);
    pair.mu = 0.5, pair.kt = 900;
    pair.muR = 0.1, pair.kr = 700;
    law.between(kSecond, kSecond) = spring(500);
    law.between(0, 1) = spring(800);
    law.between(kSecond, 1) = spring(600);
    const auto modes = contactModes(w, law, sizes);
    const double ma = sphereMass(1000, a), mb = sphereMass(2000, b), both = ma * mb / (ma + mb);
    const auto duration = [&](const std::string& name) {
        for (const ContactMode& mode : modes)
            if (mode.name == name) return mode.duration;
        return 0.0;
    };
    CHECK(modes.size() == 7);
    CHECK(duration("particle-particle normal") == Approx(kPi * std::sqrt(ma / 2 / 1000)));
    CHECK(duration("particle-salt normal") == Approx(kPi * std::sqrt(both / 3000)));
    CHECK(duration("particle-salt sliding") == Approx(kPi * std::sqrt(both / 3.5 / 900)));
    CHECK(duration("particle-salt rolling") == Approx(kPi * std::sqrt(0.1 * mb / 700)));
    CHECK(duration("salt-salt normal") == Approx(kPi * std::sqrt(mb / 2 / 500)));
    CHECK(duration("particle-wall normal") == Approx(kPi * std::sqrt(ma / 800)));
    CHECK(duration("salt-wall normal") == Approx(kPi * std::sqrt(mb / 600)));
    sizes[kSecond] = {};  // a powder of which no particle comes
    CHECK(contactModes(w, law, sizes).size() == 2);
}

TEST_CASE("materials: a contact's reach is the longest of all pairs that occur") {
    const World w = twoPowders();
    ContactLaw law;
    law.pairs.resize(5);
    ContactParameters rest;
    rest.surfaceEnergy = 0.1;
    const ContactParameters sticky = elasticAdhesive({1e6, 0.3}, {1e6, 0.3}, 0.5, rest);
    law.between(1, kPlate) = sticky;  // two walls
    CHECK(longestReach(w, law, 1e-3) == 0);
    law.between(0, kSecond) = sticky;
    CHECK(longestReach(w, law, 1e-3) == reachOf(sticky, 2e-3));
}
