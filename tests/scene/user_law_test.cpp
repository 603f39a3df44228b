// A law that a user wrote, on the device: it does what the program's own law does whose text it repeats, to the bit.

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <set>

#include "host/core/file.h"
#include "host/model/normal_law.h"
#include "host/model/user_law.h"
#include "tests/scene/beds.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

std::shared_ptr<const UserLaw> lawOf(const std::string& text) {
    const LawReading reading = readLaw("test.glsl", text);
    for (const LawFault& fault : reading.faults) FAIL_CHECK(fault.line << ": " << fault.problem);
    REQUIRE(reading.faults.empty());
    return std::make_shared<const UserLaw>(reading.law);
}

std::shared_ptr<const UserLaw> shippedLaw(const std::string& name) {
    return lawOf(*fileContent(std::filesystem::path(VKDOSE_SOURCE_DIR) / "cases/laws" / name));
}

/// The law of `p`, whose springs are ratios of the user's stiffness already.
ContactParameters userOf(const ContactParameters& p, const UserLaw& law, const std::map<std::string, double>& values) {
    ContactParameters own = p;
    own.law = NormalLaw::User;
    REQUIRE(law.parameters.size() == values.size());
    for (std::size_t k = 0; k < law.parameters.size(); ++k) own.own[k] = values.at(law.parameters[k]);
    return own;
}

/// Three spheres over a floor and a body: pairs, surfaces and a body are touched, again and again.
RuledWorld bowl() {
    RuledWorld w = emptyWorld();
    w.surfaces = {geometry::Plane{{0, -2e-3, 0}, {0, 1, 0}}};
    RigidBody block;
    block.name = "block";
    block.shapes = {geometry::Block{Vec3(1.4e-3, -2e-3, -4e-3), Vec3(9e-3, 0, 4e-3)}};
    w.bodies = {block};
    return w;
}

Particles threeSpheres() {
    Particles p;
    p.add({0, -0.7e-3, 0}, single(1.3005e-3), {0.3, -0.3, 0.1}, {70, -40, 90});
    p.add({0.2e-3, 1.2e-3 + 0.7e-3, 0.1e-3}, single(1.1e-3), {-0.1, -0.5, 0.05}, {-80, 10, 40});
    p.add({-2.6e-3, -0.9e-3, 0}, single(1.0e-3), {0.6, -0.2, 0}, {0, 0, 0});
    return p;
}

void requireSameBits(const RuledWorld& first, const RuledWorld& second) {
    const Particles spheres = threeSpheres();
    auto a = gpu(), b = gpu();
    a->load(first, spheres);
    b->load(second, spheres);
    bool touchedAll = false;
    for (int batch = 0; batch < 40; ++batch) {
        a->advance(50, 0);
        b->advance(50, 0);
        std::set<ContactClass> kinds;
        std::size_t others = 0;
        for (const Contact& c : a->contacts()) {
            kinds.insert(c.kind);
            others = std::max<std::size_t>(others, c.other);
        }
        touchedAll = touchedAll || kinds.size() >= 2;
        const Particles p = a->particles(), q = b->particles();
        for (std::size_t i = 0; i < p.size(); ++i) {
            REQUIRE(p.position[i] == q.position[i]);
            REQUIRE(p.velocity[i] == q.velocity[i]);
            REQUIRE(p.spin[i] == q.spin[i]);
        }
    }
    CHECK(touchedAll);
    CHECK(a->particles().position[0] != spheres.position[0]);
    requireClean(*b);
}

}  // namespace

TEST_CASE("a user's law that repeats luding has luding's bits") {
    RuledWorld own = bowl();
    own.law = paperLaw(0.3);
    const auto text = shippedLaw("luding.glsl");
    RuledWorld users = own;
    users.law.user = text;
    for (std::size_t k = 0; k < kContactClasses; ++k) {
        ContactParameters& p = own.law.classes[k];
        // Powers of two, so that ratio times stiffness is the stiffness in single precision. The program's dashpots of
        // sliding act while it slips too, those of a user's law do not.
        p.k2Max = 16384, p.k1 = 4096, p.kc = 5000;
        p.kt = p.kr = p.kTo = 4096;
        p.gammaT = p.gammaR = p.gammaTo = 0;
        ContactParameters ratios = p;
        ratios.kt = ratios.kr = ratios.kTo = 0.25;
        users.law.classes[k] = userOf(ratios, *text,
                                      {{"k1", p.k1}, {"k", p.k2Max}, {"kc", p.kc}, {"depth", p.plasticityDepth},
                                       {"gamma", p.gamma}});
    }
    requireSameBits(own, users);
}

TEST_CASE("a user's law that repeats hertz-mindlin has its bits") {
    RuledWorld own = bowl();
    const auto text = shippedLaw("hertz-mindlin.glsl");
    ContactParameters elastic = hertzMindlin({2e6, 0.25}, {2e7, 0.3}, 0.7, own.law.of(ContactClass::ParticleParticle));
    elastic.kr = elastic.kTo = 0.3;
    elastic.gammaR = elastic.gammaTo = 0.2;
    own.law.classes.fill(elastic);
    RuledWorld users = own;
    users.law.user = text;
    users.law.classes.fill(userOf(elastic, *text,
                                  {{"modulus_Pa", elastic.modulus}, {"damping_ratio", kHertzDamping * elastic.dampingShare}}));
    requireSameBits(own, users);
}
