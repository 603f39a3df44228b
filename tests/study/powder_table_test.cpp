// Powders by their laboratory figures, from tables that are made up: what they say is known at every point.

#include "host/study/powder_table.h"

#include <fmt/format.h>
#include <cmath>
#include <functional>
#include <random>

#include "host/core/file.h"
#include "host/model/powder_file.h"
#include "host/study/element_tables.h"
#include "tests/support/catch.h"
#include "tests/support/folder.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// Friction, rolling friction, Bond number, restitution.
using Truth = Parameters;

double repose(const Truth& p) {
    return 15 + 25 * std::sqrt(p[0]) + 20 * p[1] + 0.4 * p[2];
}
double poured(const Truth& p) {
    return 0.62 - 0.06 * p[0] - 0.1 * p[1] - 0.003 * p[2];
}
double tapped(const Truth& p) {
    return poured(p) + 0.03 + 0.002 * p[2];
}
constexpr double kLoad = 1000;
double strength(const Truth& p, double stress = kLoad) {
    return p[2] * kLoad / stress / 60;
}
double effective(const Truth& p) {
    return 20 + 20 * p[0];
}

constexpr const char* kStudy = "base = \"" VKDOSE_SOURCE_DIR R"(/cases/elements/bulk.toml"
[[axis]]
keys = ["contact.friction", "contact.rolling_friction", "contact.bond_number", "contact.restitution"]
low = [0.05, 0.0, 0.0, 0.2]
high = [1.0, 0.5, 30.0, 0.9]
points = 60
)";

/// Tables of 60 points, each with the scatter of a test.
void makeTables(const Folder& folder) {
    std::mt19937_64 random(4);
    std::normal_distribution<double> scatter(0, 1);
    std::uniform_real_distribution<double> even(0, 1);
    const char* keys = "contact.friction,contact.rolling_friction,contact.bond_number,contact.restitution";
    std::string bulk = fmt::format("{},poured.solid_fraction,tapped.solid_fraction\n", keys);
    std::string heap = fmt::format("{},outline.angle_deg\n", keys);
    std::string shear = fmt::format(
        "{},ring-shear.ffc,ring-shear.cohesion_Pa,ring-shear.effective_friction_angle_deg,"
        "ring-shear.pre_shear_normal_stress_Pa,ring-shear.pre_shear_stress_Pa\n",
        keys);
    for (int i = 0; i < 60; ++i) {
        const Truth p{0.05 + 0.95 * even(random), 0.5 * even(random), 30 * even(random), 0.2 + 0.7 * even(random)};
        const std::string at = fmt::format("{},{},{},{}", p[0], p[1], p[2], p[3]);
        bulk += fmt::format("{},{},{}\n", at, poured(p) + 0.002 * scatter(random), tapped(p) + 0.002 * scatter(random));
        heap += fmt::format("{},{}\n", at, repose(p) + 0.7 * scatter(random));
        // A powder that hardly sticks has no strength by its yield locus.
        const double s = strength(p) + 0.01 * scatter(random);
        shear += fmt::format("{},{},{},{},{},{}\n", at, s > 0.02 ? fmt::format("{}", 1 / s) : "", s > 0.02 ? 100 : -3,
                             effective(p) + 0.3 * scatter(random), kLoad, 600);
    }
    for (const auto& [name, text] :
         {std::pair("bulk", bulk), std::pair("heap", heap), std::pair("ring-shear", shear)}) {
        folder.write(std::string(name) + ".toml", kStudy);
        folder.write(std::string(name) + ".csv", text);
    }
}

LaboratorySheet sheetOf(const std::vector<std::tuple<std::string, double, double>>& figures) {
    LaboratorySheet sheet;
    for (const auto& [name, value, error] : figures)
        for (const SheetFigure& f : kSheetFigures)
            if (name == f.name) sheet.values.push_back({&f, value, error});
    return sheet;
}

bool holds(const Interval& i, double value) {
    return i.low <= value && value <= i.high;
}

}  // namespace

TEST_CASE("of powders that are known the table's intervals hold the parameters") {
    const Folder folder;
    makeTables(folder);
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> even(0.1, 0.9);
    std::normal_distribution<double> scatter(0, 1);
    int held = 0;
    for (int i = 0; i < 20; ++i) {
        const Truth p{0.05 + 0.95 * even(random), 0.5 * even(random), 30 * even(random), 0.2 + 0.7 * even(random)};
        const double grains = 1500;
        const LaboratorySheet sheet = sheetOf({{"repose", repose(p) + scatter(random), 1},
                                               {"density", grains, 1},
                                               {"bulk", grains * (poured(p) + 0.005 * scatter(random)), grains * 0.005},
                                               {"effective", effective(p) + scatter(random), 1},
                                               {"ffc", 1 / strength(p), 0.1 / strength(p)}});
        const LikePowder like = powderLike(sheet, folder.path());
        held += holds(like.finding.parameters[0].fits, p[0]);
        held += holds(like.finding.parameters[2].fits, p[2]);
        CHECK(like.finding.parameters[0].constrained());
        CHECK_FALSE(like.finding.parameters[3].constrained());  // nothing depends on restitution
        for (std::size_t g = 0; g < 4; ++g) CHECK(isReached(like.finding, g));
        CHECK(like.density == grains);
    }
    CHECK(held >= 36);  // of 40
}

TEST_CASE("what the sheet does not have is foretold by the table") {
    const Folder folder;
    makeTables(folder);
    const Truth p{0.4, 0.2, 12, 0.5};
    const LikePowder like =
        powderLike(sheetOf({{"bulk", 600, 6}, {"tapped", 600 * tapped(p) / poured(p), 6}, {"repose", repose(p), 1}}),
                   folder.path());
    REQUIRE(like.finding.targets.size() == 2);
    CHECK(like.finding.targets[0].name == "Hausner ratio");
    bool told = false;
    for (const auto& f : like.foretold) {
        if (f.name != "poured volume fraction") continue;
        told = true;
        CHECK(std::abs(f.belief.mean - poured(p)) < 2.5 * f.belief.deviation);
        CHECK(f.belief.deviation < 0.03);
        CHECK(like.density == Approx(600 / f.belief.mean));
    }
    CHECK(told);
    CHECK(like.bulkDensity == 600.0);
    for (const auto& f : like.foretold) CHECK(f.name != "angle in the drum");  // there is no such table
}

TEST_CASE("a ring shear test at another load, or of lighter grains, is another test") {
    const Folder folder;
    makeTables(folder);
    const auto bond = [&](double load, double density) {
        const LikePowder like =
            powderLike(sheetOf({{"ffc", 6, 0.3}, {"load", load, 0}, {"density", density, 1}}), folder.path());
        CHECK(like.load == load);
        return like.finding.parameters[2].fits.median;
    };
    const double same = bond(kLoad, 1427);
    CHECK(same == Approx(10).margin(0.7));
    CHECK(bond(2 * kLoad, 1427) == Approx(2 * same).epsilon(0.07));
    CHECK(bond(kLoad, 2854) == Approx(same / 2).epsilon(0.07));
}

TEST_CASE("of grains that are known not to stick the Bond number is small") {
    const Folder folder;
    makeTables(folder);
    const Truth p{0.6, 0.2, 0, 0.5};
    const auto found = [&](bool known) {
        LaboratorySheet sheet = sheetOf({{"repose", repose(p), 1}, {"effective", effective(p), 1}});
        if (known) sheet.values.push_back({sheetOf({{"bond", 0, 0.5}}).values.front()});
        return powderLike(sheet, folder.path()).finding;
    };
    CHECK(found(false).parameters[2].fits.high > 8);
    const CalibrationFinding grains = found(true);
    CHECK(grains.parameters[2].fits.high < 3);
    CHECK(holds(grains.parameters[1].fits, p[1]));
}

TEST_CASE("where the table ends before the powder, it says so") {
    const Folder folder;
    makeTables(folder);
    const LikePowder steep = powderLike(sheetOf({{"repose", 75, 1}}), folder.path());
    REQUIRE(!steep.beyond.empty());
    CHECK_THAT(steep.beyond.front(), Catch::Contains("angle of repose 75: the table has "));
    CHECK_FALSE(isReached(steep.finding, 0));
    const LikePowder sticky = powderLike(sheetOf({{"ffc", 2.05, 0.05}}), folder.path());
    REQUIRE(!sticky.beyond.empty());
    CHECK_THAT(sticky.beyond.back(), Catch::Contains("contact.bond_number: the table ends at 30"));
    CHECK_THROWS_WITH(powderLike(sheetOf({{"bulk", 500, 5}}), folder.path()), Catch::Contains("give repose"));
    CHECK_THROWS_WITH(powderLike(sheetOf({{"drum", 40, 1}}), folder.path()), Catch::Contains("drum"));
    folder.write("heap.csv", "contact.friction\n0.3\n");
    CHECK_THROWS_WITH(powderLike(sheetOf({{"repose", 30, 1}}), folder.path()),
                      Catch::Contains("fewer than two points"));
}

TEST_CASE("the powder file of a sheet can be read, and has the parameters and the sheet") {
    const Folder folder;
    makeTables(folder);
    const LaboratorySheet sheet = sheetOf({{"bulk", 520, 10}, {"repose", 35, 1}});
    const LikePowder like = powderLike(sheet, folder.path());
    folder.write("my-draws.csv", "contact.friction\n0.3\n");
    const auto file = folder.write("my.toml", powderFileText(sheet, like, folder.path(), "my-draws.csv"));
    const PowderFile powder = readPowderFile(file);
    REQUIRE(powder.laboratory.size() == 2);
    CHECK(powder.laboratory[1].figure == "repose");
    CHECK(powder.laboratory[1].value == 35);
    const PowderSpheres spheres = spheresOf(powder);
    CHECK(spheres.density == Approx(like.density).epsilon(1e-3));
    CHECK(spheres.bulkDensity == 520.0);
    CHECK(spheres.stressScaled);
    const Case c = loadCase(VKDOSE_SOURCE_DIR "/cases/mini.toml", {"powder_file=\"" + file.string() + "\""});
    CHECK(c.dosingLaw.between(kFirstPowder, kFirstPowder).mu ==
          Approx(like.finding.parameters[0].chosen).epsilon(1e-3));
}

TEST_CASE("the manual has every figure of a laboratory sheet") {
    const std::string page = fileContent(VKDOSE_SOURCE_DIR "/cases/powders/README.md").value();
    for (const SheetFigure& f : kSheetFigures) {
        const std::string error = f.relative > 0   ? fmt::format("{:.4g} % ", 100 * f.relative)
                                  : f.absolute > 0 ? fmt::format("{:.4g} ", f.absolute)
                                                   : "";
        CHECK_THAT(page, Catch::Contains(fmt::format("| `{}` | {} | {} | {}|", f.name, f.unit, f.meaning, error)));
    }
}
