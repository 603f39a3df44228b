// What a case may ask for until the bed is at rest.

#include "host/model/case.h"
#include "tests/model/case_files.h"
#include "tests/model/same_case.h"
#include "tests/support/catch.h"

using namespace vkdose;
using test::checkSame;
using test::checkSameLaw;
using test::Folder;
using test::kGoodCase;

TEST_CASE("settling adhesion: for every class without one of its own") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);
    const Case plain = loadCase(file);  // no settling value: the doses' law from the start
    CHECK(plain.settlingLaw.between(0, 0).kc == plain.dosingLaw.between(0, 0).kc);
    const Case c = loadCase(file, {"settle.kc_over_k=0.3", "contact.wall.kc_over_k=0.1"});
    CHECK(c.settlingLaw.of(ContactClass::ParticleParticle).kc == Approx(600));
    CHECK(c.settlingLaw.of(ContactClass::ParticleWall).kc == Approx(200));
    CHECK(c.settlingLaw.of(ContactClass::ParticleCoil).kc == Approx(200));
    CHECK(c.dosingLaw.of(ContactClass::ParticleCoil).kc == Approx(200));
    const Case d = loadCase(file, {"settle.kc_over_k=0.3", "settle.coil_kc_over_k=0"});
    CHECK(d.settlingLaw.of(ContactClass::ParticleWall).kc == Approx(600));
    CHECK(d.settlingLaw.of(ContactClass::ParticleCoil).kc == 0);
}

TEST_CASE("damping while settling: a factor on the dashpot of the normal direction, which may need a shorter step") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);
    const Case usual = loadCase(file), damped = loadCase(file, {"settle.damping_factor=3"});
    checkSameLaw(usual.dosingLaw, damped.dosingLaw);
    for (int i = 0; i < kContactClasses; ++i) {
        const ContactParameters &p = usual.settlingLaw.between(0, i), &q = damped.settlingLaw.between(0, i);
        CHECK(q.gamma == 3 * p.gamma);
        CHECK(std::vector<double>{q.gammaT, q.gammaR, q.gammaTo} == std::vector<double>{p.gammaT, p.gammaR, p.gammaTo});
        CHECK(q.k2Max == p.k2Max);
        CHECK(q.kc == p.kc);
    }
    checkSame(damped, loadResolvedCase(damped.resolved, file));
    const Case overdamped = loadCase(file, {"settle.damping_factor=60"});
    CHECK(overdamped.world.timeStep < 0.2 * usual.world.timeStep);
}

TEST_CASE("gravity while settling: a factor on that of the case, which stays as it is") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);
    const Case usual = loadCase(file), gentle = loadCase(file, {"settle.gravity_factor=0.25"});
    CHECK(gentle.world.gravity == usual.world.gravity);
    CHECK(usual.settlingGravity() == usual.world.gravity);
    CHECK(gentle.settlingGravity() == 0.25 * usual.world.gravity);
    CHECK(gentle.settlingWorld().gravity == gentle.settlingGravity());
    checkSame(gentle, loadResolvedCase(gentle.resolved, file));
    CHECK(loadResolvedCase(gentle.resolved, file).settlingGravity() == gentle.settlingGravity());
    for (const char* bad : {"0", "-1", "true"})
        CHECK_THROWS_WITH(loadCase(file, {std::string("settle.gravity_factor=") + bad}),
                          Catch::Contains("settle.gravity_factor"));
    CHECK_THROWS_WITH(loadCase(file, {"settle.gravity_factor=1e12"}), Catch::Contains("tenth of its radius"));
}

TEST_CASE("elastic settling: springs of stiffness k1 in every class, and nothing else is changed") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);
    const Case usual = loadCase(file), elastic = loadCase(file, {"settle.elastic=true"});
    checkSameLaw(usual.dosingLaw, elastic.dosingLaw);
    ContactLaw law = usual.settlingLaw;
    for (const MaterialPair pair : occurringPairs(usual.world)) {
        ContactParameters& p = law.between(pair.a, pair.b);
        REQUIRE(p.k2Max > p.k1);
        p.k2Max = p.k1;
    }
    checkSameLaw(law, elastic.settlingLaw);
    CHECK(elastic.world.timeStep == usual.world.timeStep);
    checkSame(elastic, loadResolvedCase(elastic.resolved, file));
    checkSame(usual, loadCase(file, {"settle.elastic=false"}));
    const Case soft = loadCase(file, {"settle.elastic=true", "contact.soften=4"});
    for (int i = 0; i < kContactClasses; ++i) {
        CHECK(soft.settlingLaw.between(0, i).k2Max == soft.settlingLaw.between(0, i).k1);
        CHECK(soft.settlingLaw.between(0, i).k1 == Approx(usual.settlingLaw.between(0, i).k1 / 4));
    }
    checkSame(soft, loadResolvedCase(soft.resolved, file));
}
