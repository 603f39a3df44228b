// Cases with a law of the user's own, as they are read.

#include <filesystem>
#include <fstream>

#include "host/backend/vulkan/law_trial.h"
#include "host/model/case.h"
#include "host/model/stability.h"
#include "tests/support/folder.h"
#include "tests/support/gpu.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr const char* kSpring =
    "parameter float k, rate; // [N/m], [kg/s]\nfloat force(Contact c) { return k * c.overlap; }\n"
    "float stiffness(Contact c) { return k; }\nfloat damping(Contact c) { return rate; }\n";

constexpr const char* kCase =
    "boundaries = \"list\"\n[particles]\ndensity = 2500.0\nlist = \"two.csv\"\n[[plane]]\npoint = [0, -1e-2, 0]\n"
    "normal = [0, 1, 0]\n[contact]\nlaw = \"spring.glsl\"\nfriction = 0.3\n[contact.parameters]\nk = 1000.0\nrate = "
    "0.01\n"
    "[contact.wall.parameters]\nk = 4000.0\n[settle]\ntime_s = 0.001\n";

void write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

/// Writes the case with its law, and loads it.
Case loaded(const Folder& folder, const std::string& text = kCase) {
    write(folder.path() / "spring.glsl", kSpring);
    write(folder.path() / "two.csv", "x,y,z,r\n0,0,0,1e-3\n2.1e-3,0,0,1e-3\n");
    write(folder.path() / "case.toml", text);
    tryLawsOnDevices();
    return loadCase(folder.path() / "case.toml");
}

std::string with(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    return text.replace(at, what.size(), by);
}

}  // namespace

TEST_CASE("each class of contacts has the parameters of a user's law, or those of the class above it") {
    const Folder folder;
    const ContactLaw law = loaded(folder).dosingLaw;
    REQUIRE(law.user);
    CHECK(law.user->parameters == std::vector<std::string>{"k", "rate"});
    const auto of = [&](ContactClass c, std::size_t k) { return law.of(c).own[k]; };
    CHECK(of(ContactClass::ParticleParticle, 0) == 1000);
    CHECK(of(ContactClass::ParticleWall, 0) == 4000);
    CHECK(of(ContactClass::ParticleCoil, 0) == 4000);
    CHECK(of(ContactClass::ParticleWall, 1) == 0.01);
}

TEST_CASE("what single precision takes from a law's answers is found") {
    const auto shareOf = [](const Case& c) { return c.lawRounding ? c.lawRounding->share : 0.0; };
    const Folder folder;
    CHECK(shareOf(loaded(folder)) < 1e-6);
    CHECK(shareOf(loadCase(VKDOSE_SOURCE_DIR "/cases/laws/liquid-bridge.toml")) < 1e-5);
    // The difference of two squares that are almost the same.
    const Folder another;
    const std::string lost =
        with(kSpring, "k * c.overlap",
             "k * (pow(100.0 * c.radius + c.overlap, 2.0) - pow(100.0 * c.radius, 2.0)) / (200.0 * c.radius)");
    write(another.path() / "spring.glsl", lost);
    write(another.path() / "two.csv", "x,y,z,r\n0,0,0,1e-3\n2.1e-3,0,0,1e-3\n");
    write(another.path() / "case.toml", kCase);
    const Case c = loadCase(another.path() / "case.toml");
    CHECK(shareOf(c) > 1e-2);
    CHECK(c.lawRounding->function == "force");
}

TEST_CASE("the text of a law is read again from the resolved case, however many dots it has") {
    const Folder folder;
    std::string many = kSpring;
    for (int i = 0; i < 30; ++i) many += "// a comment ... with dots\n";
    write(folder.path() / "spring.glsl", many);
    write(folder.path() / "two.csv", "x,y,z,r\n0,0,0,1e-3\n2.1e-3,0,0,1e-3\n");
    write(folder.path() / "case.toml", kCase);
    tryLawsOnDevices();
    const Case c = loadCase(folder.path() / "case.toml");
    std::filesystem::remove(folder.path() / "spring.glsl");
    CHECK(loadResolvedCase(c.resolved, folder.path() / "case.toml").dosingLaw.user->hash == c.dosingLaw.user->hash);
}

TEST_CASE("a law that could not stand in the resolved case is refused") {
    const Folder folder;
    const auto refused = [&](const std::string& text, const char* why) {
        (void)loaded(folder);
        write(folder.path() / "spring.glsl", text);
        CHECK_THROWS_WITH(loadCase(folder.path() / "case.toml"),
                          Catch::Contains("spring.glsl") && Catch::Contains(why));
    };
    refused(kSpring + std::string("// Steifigkeit\n// Stei\xdf"), ":6: is not UTF-8; save the file as UTF-8");
    refused(kSpring + std::string(70000, ' '), "has 68 KiB; a law may have 64 KiB");
}

TEST_CASE("the time step of a user's law follows from the stiffness that a device tells") {
    const Folder folder;
    const Case c = loaded(folder);
    const double mass = sphereMass(2500, 1e-3);
    // The wall's spring is the stiffest: pi sqrt(m/k)/8; a pair's lasts sqrt(2) as long.
    const double step = kPi * std::sqrt(mass / 4000) / 8;
    CHECK(c.world.timeStep <= step);
    CHECK(c.world.timeStep > 0.99 * step);
}

TEST_CASE("parameters that a law does not declare, or that are missing, are named") {
    const Folder folder;
    CHECK_THROWS_WITH(loaded(folder, with(kCase, "rate = 0.01", "rat = 0.01")),
                      Catch::Contains("contact.parameters.rat") && Catch::Contains("no parameter of spring.glsl") &&
                          Catch::Contains("k, rate"));
    CHECK_THROWS_WITH(loaded(folder, with(kCase, "rate = 0.01\n", "")),
                      Catch::Contains("contact.parameters.rate") && Catch::Contains("is missing"));
    CHECK_THROWS_WITH(loaded(folder, with(kCase, "rate = 0.01", "rate = \"much\"")),
                      Catch::Contains("contact.parameters.rate") && Catch::Contains("not a number"));
    CHECK_THROWS_WITH(loaded(folder, with(kCase, "[contact.wall.parameters]\nk", "[contact.wall.parameters]\nm")),
                      Catch::Contains("contact.wall.parameters.m"));
    CHECK_THROWS_WITH(loaded(folder, with(kCase, "friction", "k = 2.0\nfriction")), Catch::Contains("key of the law"));
    CHECK_THROWS_WITH(loaded(folder, with(kCase, "spring.glsl", "sprung.glsl")),
                      Catch::Contains("contact.law") && Catch::Contains("there is no file"));
}

TEST_CASE("the resolved case holds the text of a user's law and needs no file") {
    const Folder folder;
    const Case first = loaded(folder);
    std::filesystem::remove(folder.path() / "spring.glsl");
    const Case again = loadResolvedCase(first.resolved, folder.path() / "case.toml");
    REQUIRE(again.dosingLaw.user);
    CHECK(again.dosingLaw.user->text == kSpring);
    CHECK(again.dosingLaw.user->hash == first.dosingLaw.user->hash);
    CHECK(again.resolved == first.resolved);
    CHECK_THROWS_WITH(loadResolvedCase(with(first.resolved, "[N/m]", "[N/mm]"), folder.path() / "case.toml"),
                      Catch::Contains("law_text") && Catch::Contains("spring.glsl"));
}
