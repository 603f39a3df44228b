// What the host makes of a user's law without a device.

#include "host/law/user_law.h"

#include <fmt/format.h>

#include <functional>

#include "host/law/law_checks.h"
#include "host/model/user_law_trial.h"
#include "tests/model/case_files.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

const std::string kSpring =
    "parameter float k;\nfloat force(Contact c) { return k * c.overlap; }\n"
    "float stiffness(Contact c) { return k; }\n";

constexpr std::size_t kPoints = 96;  // of a loading: 64 pressed and drawn apart, 32 beyond touch

/// What a law answers at a point, as a device tells it.
LawPoint answerAt(const LawLoading& loading, std::size_t point, double reach) {
    LawPoint p;
    p.overlap = point < 64 ? loading.deepest : -reach;
    p.force = loading.own[0] * p.overlap;
    p.stiffness = loading.own[0];
    p.reach = reach;
    return p;
}

/// The device of a trial: its answer to a loading at a point. A value-initialised one stands for none.
using Answer = std::function<LawPoint(const LawLoading&, std::size_t point)>;

/// Loads a case of two spheres with the spring, tried on such a device.
Case loadOn(const Answer& answer, double secondRadius = 1e-3, const std::vector<std::string>& overrides = {}) {
    const Folder folder;
    folder.write("spring.glsl", kSpring);
    folder.write("two.csv", fmt::format("x,y,z,r\n0,0,0,1e-3\n0.02,0,0,{}\n", secondRadius));
    setLawTrial([&](const UserLaw&, const std::vector<LawLoading>& loadings) {
        std::vector<std::vector<LawPoint>> answers;
        for (const LawLoading& loading : loadings) {
            answers.emplace_back(kPoints);
            for (std::size_t k = 0; k < kPoints; ++k) answers.back()[k] = answer(loading, k);
        }
        return answers;
    });
    const auto file =
        folder.write("case.toml",
                     "boundaries = \"none\"\n[particles]\ndensity = 2500.0\nlist = \"two.csv\"\n[contact]\nlaw = "
                     "\"spring.glsl\"\nfriction = 0.3\n[contact.parameters]\nk = 1000.0\n[settle]\ntime_s = 0.001\n");
    try {
        Case c = loadCase(file, overrides);
        setLawTrial({});
        return c;
    } catch (...) {
        setLawTrial({});
        throw;
    }
}

/// The same, whose trial ends after some points, or at once.
void loadTried(std::size_t answered, double reach = 0, const std::vector<std::string>& overrides = {}) {
    const auto some = [&](const LawLoading& loading, std::size_t k) {
        return k < answered ? answerAt(loading, k, reach) : LawPoint{};
    };
    (void)loadOn(some, 1e-3, overrides);
}

}  // namespace

TEST_CASE("what single precision changes of a law's answers is told by its size and place") {
    const auto shifted = [](double by) {
        return [by](const LawLoading& loading, std::size_t k) {
            LawPoint p = answerAt(loading, k, 0);
            p.force += by * loading.own[0] * loading.deepest;
            return p;
        };
    };
    const Case exact = loadOn(shifted(0));
    CHECK_FALSE(exact.lawRounding);
    const Case wrong = loadOn(shifted(0.01));
    REQUIRE(wrong.lawRounding);
    CHECK(wrong.lawRounding->function == "force");
    CHECK(wrong.lawRounding->pair == "particle-particle");
    CHECK(near(wrong.lawRounding->share, 0.01, 0.01, 1e-3));
    CHECK(near(wrong.lawRounding->device, 1.01 * wrong.lawRounding->exact, wrong.lawRounding->exact, 1e-3));
}

TEST_CASE("a trial that the device does not make, or not to its end, is a fault of the law") {
    CHECK_NOTHROW(loadTried(kPoints));
    CHECK_NOTHROW(loadTried(kPoints, 1e-6));
    for (const std::size_t answered : {0, 1, 40, 63})
        CHECK_THROWS_WITH(loadTried(answered), Catch::Contains("spring.glsl:2") && Catch::Contains("did not answer"));
}

TEST_CASE("a run allows a law the stiffness of its largest spheres, and the time step is that of the smallest") {
    const auto growing = [](const LawLoading& loading, std::size_t k) {
        LawPoint p = answerAt(loading, k, 0);
        p.stiffness = 1e6 * loading.radius;
        return p;
    };
    const Case c = loadOn(growing, 8e-3);
    const ContactParameters& pair = c.dosingLaw.of(ContactClass::ParticleParticle);
    CHECK(pair.k2Max == Approx(500));  // reduced radius 0.5 mm
    CHECK(pair.kMost == Approx(4000));
}

TEST_CASE("law_hash pins the text of a law's file") {
    CHECK_NOTHROW(loadTried(kPoints, 0, {"contact.law_hash=\"" + lawHash(kSpring) + "\""}));
    CHECK_THROWS_WITH(loadTried(kPoints, 0, {"contact.law_hash=\"" + lawHash(kSpring + " ") + "\""}),
                      Catch::Contains("spring.glsl is not the law that law_hash was made of"));
}

TEST_CASE("the line of a law's function is that of its name") {
    CHECK(lineOfFunction(kSpring, "force") == 2);
    CHECK(lineOfFunction(kSpring, "stiffness") == 3);
    CHECK(lineOfFunction("// float force(Contact c)\nfloat\n  force (Contact c) { return 1.0; }\n", "force") == 3);
    CHECK(lineOfFunction(kSpring, "pull") == 1);
}

TEST_CASE("a mark of the byte order before a law counts as nothing") {
    const LawReading plain = readLaw("a.glsl", kSpring), marked = readLaw("a.glsl", "\xef\xbb\xbf" + kSpring);
    CHECK(marked.faults.empty());
    CHECK(marked.law.parameters == plain.law.parameters);
    CHECK(marked.law.text != plain.law.text);
    CHECK_FALSE(readLaw("a.glsl", kSpring + "\xef\xbb\xbf").faults.empty());
}

TEST_CASE("a law's functions may return in each branch, and its variables take their values one after the other") {
    const std::string branches =
        kSpring +
        "float damping(Contact c) {\n  const float a = 1.0, b = max(a, 2.0);\n"
        "  if (c.overlap > 0.0) { return b; } else if (c.speed > 0.0) return 0x1F; else { return .5e-3; }\n}\n";
    CHECK(readLaw("a.glsl", branches).faults.empty());
}

TEST_CASE("what a slip in the name of a law's function was meant to be is asked") {
    const LawReading reading = readLaw("a.glsl", kSpring + "float dampning(Contact c) { return 1.0; }\n");
    REQUIRE(reading.faults.size() == 1);
    CHECK(reading.faults[0].line == 4);
    CHECK_THAT(reading.faults[0].remedy, Catch::Contains("damping"));
}

TEST_CASE("a property of particles is declared, read and flows, and a slip in it is told") {
    const std::string law = kSpring + "particle float heat, charge;\n";
    const LawReading reading =
        readLaw("heat.glsl", law + "float flow_charge(Contact c) { return charge.y - charge.x; }\n");
    REQUIRE(reading.faults.empty());
    CHECK(reading.law.properties == std::vector<std::string>{"heat", "charge"});
    CHECK(reading.law.flows == std::vector<char>{0, 1});
    CHECK_THAT(reading.law.shader, Catch::Contains("vec2 Userheat, Usercharge;") &&
                                       Catch::Contains("Usercharge = vec2(i.y, j.y);") &&
                                       Catch::Contains("return vec4(0.0, Userflow_charge(c), 0.0, 0.0);"));
    const auto told = [](const std::string& text) {
        const LawReading bad = readLaw("heat.glsl", text);
        REQUIRE(bad.faults.size() == 1);
        return bad.faults[0].problem + "; " + bad.faults[0].remedy;
    };
    CHECK_THAT(told(law + "float flow_charg(Contact c) { return 0.0; }\n"),
               Catch::Contains("nobody calls the function flow_charg; did you mean flow_charge?"));
    CHECK_THAT(
        told(law + "float pull(Contact c) { heat.x = 1.0; return 0.0; }\n"),
        Catch::Contains("heat is a property of particles, and pull changes it; say by float flow_heat(Contact c)"));
    CHECK_THAT(told("particle float radius;\n" + kSpring), Catch::Contains("particles have a radius already"));
    CHECK_THAT(told("particle float a, b, c, d, e;\n" + kSpring), Catch::Contains("there is room for 4"));
    CHECK_THAT(told(law + "float damping(Contact c) { particle float x; return 0.0; }\n"),
               Catch::Contains("a particle is declared inside of damping"));
    CHECK_THAT(told(law + "float flow_heat(float x) { return x; }\n"),
               Catch::Contains("flow_heat has another signature; write float flow_heat(Contact c) { ... }"));
}

TEST_CASE("properties come from the case's tables and from a list, and walls have none unless they state them") {
    const Folder folder;
    folder.write("heat.glsl", kSpring + "particle float heat, charge;\n");
    folder.write("two.csv", "x,y,z,r,charge\n0,0,0,1e-3,7\n0.02,0,0,1e-3,8\n");
    const auto answering = [](const UserLaw&, const std::vector<LawLoading>& loadings) {
        std::vector<std::vector<LawPoint>> answers;
        for (const LawLoading& loading : loadings) {
            answers.emplace_back();
            for (std::size_t k = 0; k < kPoints; ++k) answers.back().push_back(answerAt(loading, k, 0));
        }
        return answers;
    };
    const std::string text =
        "boundaries = \"none\"\n[particles]\ndensity = 2500.0\nlist = \"two.csv\"\n[contact]\nlaw = \"heat.glsl\"\n"
        "friction = 0.3\n[contact.parameters]\nk = 1000.0\n[contact.properties]\nheat = 20.0\ncharge = 1.0\n"
        "[contact.coil.properties]\nheat = 90.0\n[settle]\ntime_s = 0.001\n";
    const auto load = [&](const std::vector<std::string>& overrides = {}) {
        setLawTrial(answering);
        try {
            Case c = loadCase(folder.write("case.toml", text), overrides);
            setLawTrial({});
            return c;
        } catch (...) {
            setLawTrial({});
            throw;
        }
    };
    const Case c = load();
    CHECK(c.world.properties == std::vector<std::string>{"heat", "charge"});
    CHECK(c.world.materials[kWallMaterial].properties == LawProperties{});
    CHECK(c.world.materials[kCoilMaterial].properties == LawProperties{90, 0});
    const Particles p = insertParticles(c).particles;
    CHECK(p.properties == std::vector<LawProperties>{{20, 7}, {20, 8}});
    CHECK(load({"contact.wall.properties.heat=50"}).world.materials[kCoilMaterial].properties == LawProperties{90, 0});
    CHECK_THROWS_WITH(load({"contact.properties.heat=\"warm\""}), Catch::Contains("contact.properties.heat"));
    CHECK_THROWS_WITH(
        load({"contact.properties.hot=1"}),
        Catch::Contains("contact.properties.hot = 1: is no property of particles of heat.glsl; it declares "
                        "heat, charge"));
    folder.write("two.csv", "x,y,z,r,mood\n0,0,0,1e-3,7\n0.02,0,0,1e-3,8\n");
    CHECK_THROWS_WITH(load(), Catch::Contains("mood: unknown column"));
    // The resolved case holds the law's text and the properties, and gives the same particles.
    folder.write("two.csv", "x,y,z,r,charge\n0,0,0,1e-3,7\n0.02,0,0,1e-3,8\n");
    const std::string resolved = load().resolved;
    setLawTrial(answering);
    const Case again = loadResolvedCase(resolved, "case.toml");
    setLawTrial({});
    CHECK(insertParticles(again).particles.properties == p.properties);
    // Of two powders, and in the table of a pair that is no material's.
    folder.write("two.csv", "x,y,z,r,powder\n0,0,0,1e-3,powder\n0.02,0,0,1e-3,sugar\n");
    const std::string sugar = "powder=[{name=\"sugar\", density=1500.0}]";
    CHECK(insertParticles(load({sugar})).particles.properties == std::vector<LawProperties>{{20, 1}, {20, 1}});
    CHECK(insertParticles(load({sugar, "contact.sugar-sugar.properties.heat=60"})).particles.properties ==
          std::vector<LawProperties>{{20, 1}, {60, 1}});
    CHECK_THROWS_WITH(load({sugar, "contact.sugar-wall.properties.heat=60"}),
                      Catch::Contains("contact.sugar-wall.properties: is of one material, not of this pair"));
}
