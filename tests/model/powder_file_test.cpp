// A powder in a file of its own.
#include "host/model/powder_file.h"

#include <algorithm>

#include "tests/model/case_files.h"
#include "tests/model/mutants.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

const std::string kBeads = R"(title = "Beads"
limits = "dry ones"
bulk_density = 1500.0
[particles]
density = 2500.0
[particles.size]
distribution = "fixed"
radius_mm = 1.1
[contact]
law = "hertz-mindlin"
youngs_modulus = 5e6
poisson_ratio = 0.25
restitution = 0.9
friction = 0.3
[contact.wall]
friction = 0.15
[[laboratory]]
figure = "angle of steady flow"
value = 23.45
error = 0.34
unit = "degrees"
method = "ring shear tester"
source = "a table"
[[held]]
test = "../elements/ring-shear.toml"
figure = "ring-shear.angle_deg"
measured = 23.45
measured_error = 0.34
simulated = 23.0
fitted = true
)";

std::string faultText(const std::filesystem::path& file) {
    try {
        loadCase(file);
        return "";
    } catch (const CaseError& error) {
        for (const Diagnostic& d : error.faults()) CHECK(unclear(d) == "");
        return error.what();
    }
}

}  // namespace

TEST_CASE("a powder's file takes the place of the powder that a case has") {
    const Folder folder;
    folder.write("beads.toml", kBeads);
    const std::string settled = replaced(kGoodCase, "time_s = 0.15\n", "time_s = 0.15\nkc_over_k = 0.1\n");
    const auto file = folder.write("case.toml", settled + "[time]\nstep_s = 1e-6\n");
    const Case before = loadCase(file);
    REQUIRE(before.world.timeStep == 1e-6);
    const Case c = loadCase(file, {"powder_file=" + (folder / "beads.toml").string()});
    CHECK(c.world.density() == 2500);
    CHECK(c.filling.size.radius == Approx(1.1e-3));
    CHECK(c.filling.mass == before.filling.mass);
    CHECK(c.bulkDensity == 1500);
    CHECK(c.dosingLaw.between(0, 0).law == NormalLaw::HertzMindlin);
    CHECK(c.dosingLaw.between(0, 0).mu == 0.3);
    CHECK(c.dosingLaw.between(0, 1).mu == 0.15);
    CHECK(c.dosingLaw.between(0, 2).mu == 0.15);
    CHECK(c.dosingLaw.between(0, 0).muR == 0);  // nothing of the former powder is left
    CHECK(c.world.timeStep > 1e-6);
    CHECK(c.world.coil->radius == before.world.coil->radius);
    // The resolved case needs no file, and neither does the case as it was given.
    CHECK_THAT(c.resolved, !Catch::Contains("powder_file"));
    CHECK_THAT(c.given, !Catch::Contains("powder_file"));
    CHECK(loadResolvedCase(c.resolved, file).resolved == c.resolved);
    CHECK(loadResolvedCase(c.given, file).resolved == c.resolved);
    CHECK(std::find(c.files.begin(), c.files.end(), folder / "beads.toml") != c.files.end());
}

TEST_CASE("what a case or an override states beside its powder's file comes on top of it") {
    const Folder folder;
    std::filesystem::create_directory(folder / "powders");
    folder.write("powders/beads.toml", kBeads);
    folder.write("good.toml", kGoodCase);
    // The path is relative to the file that names it.
    const auto file = folder.write("case.toml",
                                   "base = \"good.toml\"\npowder_file = \"powders/beads.toml\"\n[contact]\n"
                                   "friction = 0.4\n[particles]\nmass_g = 1.0\n");
    const Case c = loadCase(file);
    CHECK(c.dosingLaw.between(0, 0).mu == 0.4);
    CHECK(c.dosingLaw.between(0, 0).dampingShare > 0);
    CHECK(c.filling.mass == Approx(1e-3));
    CHECK(loadCase(file, {"contact.friction=0.5"}).dosingLaw.between(0, 0).mu == 0.5);
    CHECK(loadCase(file, {"contact.max_overlap_ratio=0.3", "powder_file=" + (folder / "powders/beads.toml").string()})
              .dosingLaw.between(0, 0)
              .mu == 0.3);
    // A case without a base may have one too.
    const auto alone = folder.write(
        "alone.toml", "powder_file = \"powders/beads.toml\"\n" + kGoodCase.substr(0, kGoodCase.find("[particles]")) +
                          "[particles]\nmass_g = 0.9\n" + kGoodCase.substr(kGoodCase.find("[canister]")));
    CHECK(loadCase(alone).world.density() == 2500);
}

TEST_CASE("a powder of the same law leaves nothing of the one before, and the limit of overlaps and pairs stay") {
    const Folder folder;
    const std::string soft =
        "title = \"soft\"\n[particles]\ndensity = 1000.0\n[particles.size]\n"
        "distribution = \"fixed\"\nradius_mm = 1.0\n[contact]\nk = 500.0\nk1_over_k = 1.0\n"
        "kc_over_k = 0.0\ndamping = 0.01\nfriction = 0.1\n";
    folder.write("soft.toml", soft);
    const std::string text = replaced(kGoodCase, "[contact]\n", "[contact]\nmax_overlap_ratio = 0.7\n") + kSugar +
                             "[contact.powder-sugar]\nfriction = 0.77\n";
    const Case c = loadCase(folder.write("case.toml", text), {"powder_file=" + (folder / "soft.toml").string()});
    CHECK(c.dosingLaw.between(0, 0).muR == 0);
    CHECK(c.dosingLaw.between(0, 1).mu == 0.1);  // not the wall's 0.2 of before
    CHECK(c.world.maxOverlapRatio == 0.7);
    CHECK(c.dosingLaw.between(0, 3).mu == 0.77);
}

TEST_CASE("the file tells what was measured and what it was held against") {
    const Folder folder;
    folder.write("draws.csv", "contact.friction\n0.3\n");
    const PowderFile p = readPowderFile(folder.write("beads.toml", "draws = \"draws.csv\"\n" + kBeads));
    CHECK(p.title == "Beads");
    CHECK(p.limits == "dry ones");
    REQUIRE(p.laboratory.size() == 1);
    CHECK(p.laboratory[0].value == 23.45);
    CHECK(p.laboratory[0].error == 0.34);
    CHECK(p.laboratory[0].source == "a table");
    REQUIRE(p.held.size() == 1);
    CHECK(p.held[0].fitted);
    CHECK(p.held[0].figure == "ring-shear.angle_deg");
    CHECK(!p.held[0].simulatedError);
    CHECK(*p.draws == folder / "draws.csv");
    CHECK(p.spheres.children.size() == 3);
}

TEST_CASE("a powder's file that is none is refused by line and key") {
    const Folder folder;
    const auto file = folder.write("case.toml", "base = \"good.toml\"\npowder_file = \"beads.toml\"\n");
    folder.write("good.toml", kGoodCase);
    CHECK_THAT(faultText(file), Catch::Contains("case.toml:2: powder_file") && Catch::Contains("there is no file"));
    struct Fault {
        std::string from, to, says;
    };
    for (const Fault& row : std::vector<Fault>{
             {"title = \"Beads\"\n", "", "title: is missing"},
             {"title", "titel", "did you mean title?"},
             {"source = \"a table\"\n", "", "laboratory[0].source: is missing"},
             {"value = 23.45", "value = \"steep\"", "laboratory[0].value"},
             {"measured_error = 0.34", "measured_error = -1", "held[0].measured_error"},
             {"fitted = true", "fitted = 1", "held[0].fitted"},
             {"title = \"Beads\"\n", "title = \"Beads\"\ndraws = \"none.csv\"\n", "draws"},
             {"[contact]", "[kontact]", "contact"},
             {"friction = 0.3", "frictoin = 0.3", "did you mean friction?"},
             // The case has these keys; the powder takes their place and lacks them.
             {"friction = 0.3\n", "", "beads.toml:10: contact.friction: is missing"},
             {"distribution = \"fixed\"\n", "", "beads.toml:6: particles.size.distribution: is missing"},
             {"title = \"Beads\"\n", "title = \"Beads\"\n[coil]\nturns = 3\n", "coil"},
             // The mass stands in the case, and what makes it too little or too much in the powder's file.
             {"density = 2500.0", "density = 25e8", "good.toml:6: particles.mass_g = 0.9: is less than half"},
             {"radius_mm = 1.1", "radius_mm = 1.1e-3", "particles.mass_g = 0.9: takes about"},
         }) {
        CAPTURE(row.from, row.to);
        folder.write("beads.toml", replaced(kBeads, row.from, row.to));
        CHECK_THAT(faultText(file), Catch::Contains(row.says) && Catch::Contains("beads.toml"));
    }
    CHECK_THAT(faultText(folder.write("case.toml", "base = \"good.toml\"\npowder_file = 3\n")),
               Catch::Contains("case.toml:2: powder_file = 3: must be a string"));
    // A case is no powder's file.
    CHECK_THAT(faultText(folder.write("case.toml", "base = \"good.toml\"\npowder_file = \"good.toml\"\n")),
               Catch::Contains("good.toml"));
}
