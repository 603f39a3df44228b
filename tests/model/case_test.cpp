#include "host/model/case.h"

#include <cmath>

#include "host/core/error.h"
#include "tests/model/case_files.h"
#include "tests/model/same_case.h"
#include "tests/support/catch.h"

using namespace vkdose;
using test::checkSame;
using test::Folder;
using test::kFreeCase;
using test::kGoodCase;
using test::replaced;
using test::shippedCase;

TEST_CASE("the paper's case, value by value") {
    const Case c = loadCase(shippedCase("paper-48g.toml"));
    const ContactParameters& p = c.dosingLaw.of(ContactClass::ParticleParticle);
    CHECK(p.k2Max == 24067.0);
    CHECK(p.k1 == Approx(4813.4).epsilon(1e-14));
    CHECK(p.kc == Approx(0.873 * 24067).epsilon(1e-14));
    CHECK(p.plasticityDepth == 0.05);
    CHECK(p.gamma == 0.0827);
    CHECK(p.kt == Approx(6883.162).epsilon(1e-14));
    CHECK(p.kr == Approx(6883.162).epsilon(1e-14));
    CHECK(p.gammaT == Approx(0.0236522).epsilon(1e-14));
    CHECK(p.gammaR == Approx(0.0236522).epsilon(1e-14));
    CHECK(p.mu == 0.5);
    CHECK(p.muR == 0.5);
    CHECK(p.muTo == 0);
    CHECK(c.dosingLaw.of(ContactClass::ParticleWall).mu == 0.2);
    CHECK(c.dosingLaw.of(ContactClass::ParticleCoil).mu == 0.2);
    CHECK(c.dosingLaw.of(ContactClass::ParticleCoil).k2Max == 24067.0);
    for (const ContactParameters& q : test::classesOf(c.settlingLaw)) CHECK(q.kc == Approx(0.3 * 24067).epsilon(1e-14));
    CHECK(c.dosingLaw.between(0, 0).coulombLimit == CoulombLimit::Absolute);
    CHECK(c.world.maxOverlapRatio == 1);
    CHECK(c.dosingLaw.rollingLever == RollingLever::Full);
    CHECK(c.world.density() == 1427);
    CHECK(c.world.gravity == Vec3(0, -9.81, 0));
    CHECK(c.world.timeStep == 2.26e-6);
    REQUIRE(c.world.coil);
    CHECK(c.world.coil->pitch == Approx(8.75e-3).epsilon(1e-14));
    CHECK(c.world.coil->radius == Approx(10.4e-3).epsilon(1e-14));
    CHECK(c.world.coil->wireRadius == 1e-3);
    CHECK(c.world.coil->hand == 1);
    CHECK(c.world.throatZ == 0.06);
    CHECK(c.world.outletZ == Approx(0.07).epsilon(1e-14));
    CHECK(c.filling.mass == 0.048);
    CHECK(c.schedule.coilSpeed == Approx(9.42477796).epsilon(1e-8));
    CHECK(c.schedule.settleTime == 2);
    CHECK(c.schedule.rotateTime == 2);
    CHECK(c.schedule.restTime == 0.5);
    CHECK(c.schedule.stop.threshold == 0.15e-3);
    CHECK(c.schedule.stop.doses == 3);
    // 0.01 s / 2.26e-6 s = 4424.8 steps
    CHECK(c.sensorInterval / c.world.timeStep == Approx(4425).epsilon(1e-12));
    REQUIRE(c.world.walls.size() == 3);
    CHECK(std::get<geometry::Trough>(c.world.walls[0].shape).halfWidth == 11.5e-3);
    CHECK(std::get<geometry::Plane>(c.world.walls[1].shape).normal == Vec3(0, 0, 1));
    CHECK(std::get<geometry::Front>(c.world.walls[2].shape).holeRadius == 11.5e-3);
}

TEST_CASE("every shipped case loads, says why it exists and survives being resolved") {
    int count = 0;
    for (const std::filesystem::path& file : test::shippedCases()) {
        INFO(file);
        ++count;
        const Case c = loadCase(file);
        CHECK(c.name == file.stem().string());
        CHECK(c.reason.size() > 20);
        const Folder folder;
        const Case again = loadCase(folder.write("resolved.toml", c.resolved));
        checkSame(c, again);
        CHECK(again.resolved == c.resolved);
    }
    CHECK(count >= 21);
}

TEST_CASE("a resolved case keeps the sign of a zero") {
    const Case c = test::loadText(
        replaced(replaced(kFreeCase, "gravity = [0, 0, 0]", "gravity = [-0.0, -9.81, 0.0]"), "list = \"two.csv\"",
                 "mass_g = 0.2\n[particles.size]\ndistribution = \"fixed\"\nradius_mm = 1\n[particles.region]\n"
                 "low = [0, 0, 0]\nhigh = [0.01, 0.02, 0.01]"));
    CHECK_THAT(c.resolved, Catch::Contains("gravity = [-0.0, -9.81, 0]"));
    const Case again = loadResolvedCase(c.resolved, "again.toml");
    CHECK(again.resolved == c.resolved);
    CHECK(std::signbit(again.world.gravity.x));
}

TEST_CASE("a resolved case with a list, planes and words of its own loads again") {
    const Folder folder;
    std::filesystem::create_directory(folder.path() / "deep");
    folder.write("deep/two.csv", "x,y,z,r,vx,vy,vz\n0,2e-3,0,1e-3,0.1,0,0\n0,5e-3,0,0.7e-3,0,0,0\n");
    const std::string text =
        replaced(kFreeCase, "boundaries = \"none\"", "reason = 'a \"quoted\" \\ word'\nboundaries = \"list\"") +
        "[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 3, 0]\n[[plane]]\npoint = [0.1, 0, 0]\nnormal = [-1, 0, 0]\n"
        "[[cylinder]]\nbase = [0, 0, 0]\naxis = [0, 0, 2]\nradius_mm = 9\ninside = true\n";
    const Case c = loadCase(folder.write("deep/case.toml", text));
    CHECK(c.reason == "a \"quoted\" \\ word");
    REQUIRE(c.world.walls.size() == 3);
    CHECK(std::get<geometry::Plane>(c.world.walls[0].shape).normal == Vec3(0, 1, 0));
    CHECK(std::get<geometry::Tube>(c.world.walls[2].shape).radius == 9e-3);
    CHECK(std::isinf(std::get<geometry::Tube>(c.world.walls[2].shape).length));
    // Elsewhere than the original: the path of the list must still hold.
    const Case again = loadCase(folder.write("resolved.toml", c.resolved));
    checkSame(c, again);
    CHECK(insertParticles(again).particles.velocity[0] == Vec3(0.1, 0, 0));
}

TEST_CASE("overrides are TOML values or bare words, the last one wins") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);
    const Case c = loadCase(file, {"contact.friction=0.1", "contact.friction = 0.3", "coil.hand=left", "seed=9",
                                   "gravity=[0, -1.62, 0]", "contact.coil.friction=0.7", "name=other-name"});
    CHECK(c.dosingLaw.of(ContactClass::ParticleParticle).mu == 0.3);
    CHECK(c.dosingLaw.of(ContactClass::ParticleWall).mu == 0.2);
    CHECK(c.dosingLaw.of(ContactClass::ParticleCoil).mu == 0.7);
    CHECK(c.world.coil->hand == -1);
    CHECK(c.seed == 9);
    CHECK(c.world.gravity.y == -1.62);
    CHECK(c.name == "other-name");
    CHECK_THAT(c.resolved, Catch::Contains("hand = \"left\"") && Catch::Contains("friction = 0.3"));
}

TEST_CASE("an override replaces its rival") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);
    CHECK(loadCase(file, {"coil.pitch_mm=5.25"}).world.coil->pitch == 5.25e-3);
    CHECK(loadCase(file, {"coil.clearance_mm=0.5"}).world.coil->radius == Approx(5.7e-3).epsilon(1e-14));
    const Case fixed = loadCase(file, {"particles.size.distribution=fixed", "particles.size.radius_mm=1.1"});
    CHECK(fixed.filling.size.kind == SizeDistribution::Kind::Fixed);
    CHECK(fixed.filling.size.radius == Approx(1.1e-3));
    // The distribution the file has already: its keys stay.
    CHECK(loadCase(file, {"particles.size.distribution=uniform"}).filling.size.radiusMax == 1.3e-3);
}

TEST_CASE("a key of one table of a list is reached by the table's name") {
    const Folder folder;
    const std::string disc = "shape = \"disc\"\nradius_mm = 8\nat = [0, 0, 0.1]\n";
    const auto file = folder.write("case.toml", std::string(kGoodCase) + "[[body]]\nname = \"gate\"\n" + disc +
                                                    "[body.motion]\nkind = \"slide\"\nvelocity = [1, 0, 0]\n" +
                                                    "[[body]]\nname = \"lid\"\n" + disc);
    const Case c = loadCase(file, {"body.gate.motion.velocity=[2, 0, 0]", "body.gate.radius_mm=7.5"});
    CHECK_THAT(c.resolved, Catch::Contains("velocity = [2") && Catch::Contains("radius_mm = 7.5"));
    CHECK_THAT(c.resolved, Catch::Contains("radius_mm = 8"));  // the lid's
    const auto upper = folder.write("upper.toml", "base = \"case.toml\"\n[body.lid]\nradius_mm = 6.5\n");
    CHECK_THAT(loadCase(upper).resolved, Catch::Contains("radius_mm = 6.5") && Catch::Contains("radius_mm = 8"));
    for (const char* wrong : {"body.door.radius_mm=3", "body.gate=3"}) try {
            loadCase(file, {wrong});
            FAIL(wrong);
        } catch (const CaseError& error) {
            CHECK_THAT(error.what(), Catch::Contains("one of these: gate, lid"));
        }
}

TEST_CASE("a key of a table of a list is reached by the name that the table has by default") {
    const Folder folder;
    const std::string rooms = "[[region]]\nname = \"pan\"\nkind = \"beyond\"\npoint = [0, 0, 1]\nnormal = [0, 0, 1]\n";
    const auto file =
        folder.write("case.toml", std::string(kGoodCase) + rooms +
                                      "[[measure]]\nkind = \"discharge\"\nregion = \"pan\"\nfrom_s = 0.2\n"
                                      "[[field]]\npreset = \"outlet\"\n[[field]]\nstress = false\n");
    CHECK(loadCase(file, {"measure.discharge.from_s=0.25"}).measures.at(0).windows.at(0).from == 0.25);
    CHECK(loadCase(file, {"measure.discharge.name=flow"}).measures.at(0).name == "flow");
    const Case c = loadCase(file, {"field.outlet.average=true", "field.field-2.stress=true"});
    CHECK(c.fields.at(0).average);
    CHECK(c.fields.at(1).stress);
    CHECK(c.fields.at(1).name == "field-2");
    const auto upper = folder.write("upper.toml", "base = \"case.toml\"\n[measure.discharge]\nto_s = 0.4\n");
    CHECK(loadCase(upper).measures.at(0).windows.at(0).to == 0.4);
    const auto refused = [&](const std::vector<std::string>& overrides, const char* told) {
        INFO(overrides.back());
        try {
            loadCase(file, overrides);
            FAIL("was taken");
        } catch (const CaseError& error) {
            CHECK_THAT(error.what(), Catch::Contains(told));
        }
    };
    refused({"measure.content.from_s=1"}, "one of these: discharge");
    refused({"field.grid.stress=true"}, "one of these: outlet, field-2");
    refused({"measure=[{kind=\"discharge\",region=\"pan\",from_s=0.3}]", "measure.content.from_s=1"},
            "--set measure.content: is no table of the list [[measure]]; give a key of one of these: discharge");
}

TEST_CASE("a table of a list keeps its name when it takes another shape") {
    const Folder folder;
    const auto file = folder.write("case.toml", std::string(kGoodCase) +
                                                    "[[body]]\nname = \"gate\"\nshape = \"disc\"\nradius_mm = 8\n"
                                                    "at = [0, 0, 0.1]\n");
    const Case c = loadCase(file, {"body.gate.shape=box", "body.gate.size_mm=[9, 9, 9]", "body.gate.at=[0, 0, 0.2]"});
    CHECK(c.world.bodies.at(0).name == "gate");
}

TEST_CASE("a case with a base does not take its name, and with it its output folder") {
    const Folder folder;
    folder.write("base.toml", kGoodCase);
    folder.write("middle.toml", "base = \"base.toml\"\nname = \"own\"\nseed = 4\n");
    const auto top = folder.write("top.toml", "base = \"middle.toml\"\n[coil]\npitch_mm = 6\n");
    CHECK(loadCase(folder.path() / "base.toml").name == "good");
    CHECK(loadCase(folder.path() / "middle.toml").name == "own");
    const Case c = loadCase(top);
    CHECK(c.name == "top");
    CHECK(c.seed == 4);
    CHECK_THAT(c.given, Catch::Contains("name = \"top\""));
    CHECK_THAT(c.resolved, Catch::Contains("name = \"top\""));
    CHECK(loadCase(top, {"name=said"}).name == "said");
}

TEST_CASE("a base file is overridden key by key, faults name the file they stand in") {
    const Folder folder;
    std::filesystem::create_directory(folder.path() / "variants");
    const auto base = folder.write("base.toml", kGoodCase);
    const auto middle = folder.write("variants/middle.toml", "base = \"../base.toml\"\n[contact]\nfriction = 0.4\n");
    const auto top =
        folder.write("variants/top.toml", "base = \"middle.toml\"\nname = \"top\"\n[coil]\npitch_mm = 6\n");
    const Case c = loadCase(top);
    CHECK(c.name == "top");
    CHECK(c.dosingLaw.of(ContactClass::ParticleParticle).mu == 0.4);
    CHECK(c.dosingLaw.of(ContactClass::ParticleWall).mu == 0.2);
    CHECK(c.world.coil->pitch == 6e-3);
    CHECK(c.resolved.find("base") == std::string::npos);

    const auto bad = folder.write("variants/bad.toml", "base = \"middle.toml\"\n\n[contact]\nkc_over_k = -1\n");
    try {
        loadCase(bad);
        FAIL("accepted");
    } catch (const CaseError& error) {
        REQUIRE(error.faults().size() == 1);
        CHECK(error.faults()[0].file == bad.string());
        CHECK(error.faults()[0].line == 4);
    }
    folder.write("base.toml", replaced(kGoodCase, "damping = 0.02", "damping = -0.02"));
    try {
        loadCase(top);
        FAIL("accepted");
    } catch (const CaseError& error) {
        REQUIRE(error.faults().size() == 1);
        CHECK(std::filesystem::equivalent(error.faults()[0].file, base));
        CHECK(error.faults()[0].line == 16);
    }
    CHECK(std::filesystem::exists(middle));
}

TEST_CASE("what a choice leaves without a value is missing where the choice stands, not where its table began") {
    const Folder folder;
    folder.write("base.toml",
                 kGoodCase + "[[body]]\nname = \"gate\"\nshape = \"ball\"\nat = [0, 0, 0]\nradius_mm = 2\n");
    for (const char* choice : {"[contact]\nlaw = \"hertz-mindlin\"\n", "[body.gate]\nshape = \"box\"\n"}) {
        CAPTURE(choice);
        const auto upper = folder.write("upper.toml", std::string("base = \"base.toml\"\n") + choice);
        try {
            loadCase(upper);
            FAIL("accepted");
        } catch (const CaseError& error) {
            for (const Diagnostic& fault : error.faults()) {
                CAPTURE(error.what());
                CHECK(fault.problem == "is missing");
                CHECK(fault.file == upper.string());
                CHECK(fault.line == 3);
            }
        }
    }
}

TEST_CASE("the overlap that stops a run is the case's choice") {
    const std::string file = std::string(VKDOSE_SOURCE_DIR) + "/cases/mini.toml";
    CHECK(loadCase(file, {"contact.max_overlap_ratio=0.35"}).world.maxOverlapRatio == 0.35);
    CHECK_THROWS_AS(loadCase(file, {"contact.max_overlap_ratio=0"}), CaseError);
    CHECK_THROWS_AS(loadCase(file, {"contact.wall.max_overlap_ratio=0.3"}), CaseError);
}

TEST_CASE("softer spheres: every class, settling included, once and not again when the resolved case is read") {
    const Folder folder;
    const auto file = folder.write(
        "case.toml",
        replaced(kGoodCase, "[contact.wall]\n", "[contact.coil]\nk = 3000.0\n[contact.wall]\ndamping = 0.03\n"));
    const Case hard = loadCase(file), soft = loadCase(file, {"contact.soften=4"});
    CHECK(hard.softened == 1);
    CHECK(soft.softened == 4);
    for (int i = 0; i < kContactClasses; ++i)
        for (const auto law : {&Case::dosingLaw, &Case::settlingLaw}) {
            const ContactParameters &p = (hard.*law).between(0, i), &q = (soft.*law).between(0, i);
            CHECK(std::vector<double>{q.k1, q.k2Max, q.kc, q.kt, q.kr, q.kTo} ==
                  std::vector<double>{p.k1 / 4, p.k2Max / 4, p.kc / 4, p.kt / 4, p.kr / 4, p.kTo / 4});
            CHECK(std::vector<double>{q.gamma, q.gammaT, q.gammaR, q.gammaTo} ==
                  std::vector<double>{p.gamma / 2, p.gammaT / 2, p.gammaR / 2, p.gammaTo / 2});
            CHECK(q.plasticityDepth == 4 * p.plasticityDepth);
            CHECK(std::vector<double>{q.mu, q.muR, q.muTo} == std::vector<double>{p.mu, p.muR, p.muTo});
        }
    CHECK(soft.dosingLaw.of(ContactClass::ParticleCoil).k2Max == 750);
    // The step is cut to three digits.
    CHECK(soft.world.timeStep == Approx(2 * hard.world.timeStep).epsilon(0.011));
    CHECK(soft.world.maxOverlapRatio == hard.world.maxOverlapRatio);
    const Case again = loadResolvedCase(soft.resolved, file);
    CHECK(again.softened == 1);
    checkSame(soft, again);
    CHECK_THAT(soft.resolved, Catch::Contains("k = 500") && Catch::Contains("soften = 1\n"));
    CHECK(loadCase(file, {"contact.soften=1"}).resolved == hard.resolved);
    CHECK_THROWS_WITH(loadCase(file, {"contact.soften=0.5"}),
                      Catch::Contains("contact.soften = 0.5: makes the spheres harder"));
}

TEST_CASE("the limit of friction: walls and coil inherit it and may have their own, also while settling") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);
    const auto limits = [&](const std::vector<std::string>& overrides) {
        const Case c = loadCase(file, overrides);
        checkSame(c, loadCase(folder.write("resolved.toml", c.resolved)));
        std::vector<CoulombLimit> found;
        for (const ContactLaw* law : {&c.dosingLaw, &c.settlingLaw})
            for (const ContactClass k :
                 {ContactClass::ParticleParticle, ContactClass::ParticleWall, ContactClass::ParticleCoil})
                found.push_back(law->of(k).coulombLimit);
        return found;
    };
    const auto l = CoulombLimit::Luding, a = CoulombLimit::Absolute;
    CHECK(limits({"contact.coulomb_limit=absolute"}) == std::vector{a, a, a, a, a, a});
    CHECK(limits({"contact.coulomb_limit=luding"}) == std::vector{l, l, l, l, l, l});
    CHECK(limits({"contact.coulomb_limit=luding", "contact.wall.coulomb_limit=absolute"}) ==
          std::vector{l, a, a, l, a, a});
    CHECK(limits({"contact.coulomb_limit=absolute", "contact.coil.coulomb_limit=luding"}) ==
          std::vector{a, a, l, a, a, l});
}

TEST_CASE("whether contacts see the coil's surface move is the case's choice, and survives being resolved") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);
    CHECK(loadCase(file).world.coilSurfaceMoves);
    const Case still = loadCase(file, {"coil.surface_velocity=false"});
    CHECK_FALSE(still.world.coilSurfaceMoves);
    CHECK_FALSE(still.world.coilWireCurved);
    CHECK(loadCase(file, {"coil.wire_curvature=true"}).world.coilWireCurved);
    checkSame(still, loadResolvedCase(still.resolved, file));
}

TEST_CASE("stop rules") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);
    CHECK(loadCase(file).schedule.stop.threshold == 0.15e-3);
    const Case simulation = loadCase(file, {"stop.rule=simulation", "stop.doses=5"});
    CHECK(simulation.schedule.stop.kind == StopRule::Kind::Simulation);
    CHECK(simulation.schedule.stop.threshold == 0);
    CHECK(simulation.schedule.stop.doses == 5);
    const Case none = loadCase(file, {"stop.rule=none", "stop.end_time_s=1.5"});
    CHECK(none.schedule.stop.kind == StopRule::Kind::None);
    CHECK(none.schedule.stop.endTime == 1.5);
    CHECK_THROWS_AS(loadCase(file, {"stop.rule=simulation", "stop.threshold_g=0.1"}), CaseError);
}

TEST_CASE("a lid closes the canister at its height, or above a fill that starts out higher") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);
    const std::size_t open = loadCase(file).world.walls.size();
    const Case low = loadCase(file, {"canister.lid=true"});
    REQUIRE(low.world.walls.size() == open + 1);
    const auto& lid = std::get<geometry::Plane>(low.world.walls.at(open - 1).shape);  // before the front wall
    CHECK(lid.point.y == low.canister->height - low.canister->width / 2);
    CHECK(lid.normal == Vec3(0, -1, 0));
    CHECK(low.world.domain.high.y > lid.point.y);

    const Case high = loadCase(file, {"canister.lid=true", "canister.height_mm=16"});
    const double top = std::get<geometry::Plane>(high.world.walls.at(open - 1).shape).point.y;
    CHECK(top == insertParticles(high).fillHeight);
    CHECK(top > high.canister->height - high.canister->width / 2);
}

TEST_CASE("flat floor and free boundaries") {
    const Folder folder;
    const Case flat = loadCase(folder.write("case.toml", kGoodCase), {"canister.floor=flat"});
    CHECK(flat.canister->flatFloor);
    REQUIRE(flat.world.walls.size() == 5);
    CHECK(std::get<geometry::Plane>(flat.world.walls[2].shape).point.y == -7e-3);

    folder.write("two.csv", "x,y,z,r\n0,0,0,1e-3\n0,3e-3,0,1e-3\n");
    const Case free = loadCase(folder.write("free.toml", kFreeCase));
    CHECK(free.world.walls.empty());
    CHECK_FALSE(free.world.coil);
    CHECK_FALSE(free.canister);
    CHECK(std::isinf(free.world.outletZ));
    CHECK(free.world.gravity == Vec3(0));
    CHECK(free.schedule.stop.kind == StopRule::Kind::None);
    CHECK(free.world.domain.low.x <= -20e-3);
    CHECK(free.world.domain.high.y >= 23e-3);
}
