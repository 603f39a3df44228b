// A powder's draws in element tests: which tests, with which parameters, and what of it goes into the powder's file.
#include "host/study/powder_confirm.h"

#include <cmath>

#include "host/core/error.h"
#include "host/study/member.h"
#include "tests/support/catch.h"
#include "tests/support/folder.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

const std::filesystem::path kTables = std::filesystem::path(VKDOSE_SOURCE_DIR) / "cases/powders/table";

const std::string kPowder = R"(# My powder.
title = "Sheet"
draws = "draws.csv"
[particles]
density = 963.0     # measured in air
[particles.size]
distribution = "fixed"
radius_mm = 1.1
[contact]
k = 1000.0
k1_over_k = 0.2
plasticity_depth = 0.05
bond_number = 3.0
restitution = 0.5
friction = 0.5
[[laboratory]]
figure = "bulk"
value = 520.0
error = 5.0
source = "given"
fitted = true
[[laboratory]]
figure = "density"
value = 963.0
source = "given"
fitted = true
[[laboratory]]
figure = "repose"
value = 33.0
source = "another laboratory"
[[laboratory]]
figure = "colour"
value = 3.0
source = "given"
[[held]]
test = "elements/bulk.toml"
figure = "of earlier"
measured = 1.0
simulated = 2.0
[[held]]                # by somebody else
test = "elements/orifice.toml"
figure = "rate"
measured = 1.0
simulated = 2.0
)";

PowderFile made(const Folder& folder, const std::string& text = kPowder) {
    folder.write("draws.csv", "contact.friction,contact.bond_number\n0.4,2\n0.5,3\n0.6,4\n");
    return readPowderFile(folder.write("powder.toml", text));
}

}  // namespace

TEST_CASE("the figures of a powder's laboratory that element tests have become aims") {
    const Folder folder;
    const PowderFile powder = made(folder);
    const LaboratorySheet sheet = sheetOf(powder);
    REQUIRE(sheet.values.size() == 3);  // not the colour
    CHECK(sheet.find("density")->error == Approx(0.03 * 963));
    CHECK(sheet.find("repose")->error == 2);
    const auto aims = aimsOf(sheet);
    REQUIRE(aims.size() == 2);
    CHECK(std::string(aims[0].figure->name) == "poured");
    CHECK(aims[0].goal.target == Approx(520.0 / 963));
    CHECK(aims[0].goal.tolerance == Approx(520.0 / 963 * std::hypot(5.0 / 520, 0.03)));
    CHECK(aims[0].fitted);
    CHECK_FALSE(aims[1].fitted);
    CHECK(testsOf(aims) == std::vector<std::string>{"bulk", "heap"});

    CHECK_THROWS_WITH(
        sheetOf(made(folder, kPowder + "[[laboratory]]\nfigure = \"repose\"\nvalue = 34\nsource = \"x\"\n")),
        Catch::Contains("laboratory[4].value = 34: repose is there twice"));
    CHECK_THROWS_WITH(
        sheetOf(made(folder, kPowder + "[[laboratory]]\nfigure = \"ffc\"\nvalue = 0\nsource = \"x\"\n")),
        Catch::Contains("laboratory[4].value = 0: ffc is no value of this figure; give one value above 0"));
}

TEST_CASE("the members of a test have the powder, the density of the table and the draws") {
    const Folder folder;
    const PowderFile powder = made(folder);
    const Study study = confirmingStudy(powder, sheetOf(powder), kTables, "bulk", 2);
    CHECK(study.base.filename() == "bulk.toml");
    REQUIRE(study.axes.front().points.size() == 2);
    const Case c = loadResolvedCase(
        memberAt(study, 0, std::nullopt, {{"contact.friction", study.axes[0].points[0][0]}}).caseText, "case.toml");
    CHECK(c.world.density() == loadCase(study.base).world.density());
    CHECK(c.filling.size.kind == SizeDistribution::Kind::Fixed);
    CHECK_THROWS_WITH(confirmingStudy(powder, sheetOf(powder), kTables, "bulk", 4), Catch::Contains("has 3 rows"));
}

TEST_CASE("figures of runs are judged by the errors of both") {
    const Folder folder;
    const auto aims = aimsOf(sheetOf(made(folder)));
    const auto of = [&](const std::string& rows) {
        return confirmedFigures(
            aims, "bulk",
            Table::read(folder.write("figures.csv", "member,poured.solid_fraction\n" + rows), LastLine::Whole));
    };
    const auto near = of("0,0.55\n1,0.57\n2,\n");
    REQUIRE(near.size() == 1);  // the heap is another test
    CHECK(near[0].values == std::vector<double>{0.55, 0.57});
    CHECK(near[0].mean == Approx(0.56));
    CHECK(near[0].standardError == Approx(0.01));
    CHECK(near[0].met());
    CHECK_FALSE(of("0,0.58\n1,0.6\n2,0.59\n")[0].met());
    CHECK_FALSE(of("0,\n")[0].met());
    // A figure that no run has has no column.
    const auto none =
        confirmedFigures(aims, "heap", Table::read(folder.write("figures.csv", "member\n0\n"), LastLine::Whole));
    REQUIRE(none.size() == 1);
    CHECK(none[0].values.empty());
    CHECK_FALSE(none[0].met());
}

TEST_CASE("what was held takes the place of what the file had of the same test") {
    const Folder folder;
    const auto aims = aimsOf(sheetOf(made(folder)));
    ConfirmedFigure poured{aims[0], {0.55, 0.57}, 0.56, 0.01}, repose{aims[1], {}, std::nan(""), std::nan("")};
    const std::string text = withHeld(kPowder, "elements/bulk.toml", {poured, repose}, "six draws");
    CHECK(text.starts_with(kPowder.substr(0, kPowder.find("[[held]]"))));
    CHECK_THAT(text, Catch::Contains("[[held]]                # by somebody else\n") && !Catch::Contains("of earlier"));
    const PowderFile again = made(folder, text);
    REQUIRE(again.held.size() == 2);
    CHECK(again.held[1].figure == "poured volume fraction");
    CHECK(again.held[1].simulated == 0.56);
    CHECK(again.held[1].simulatedError == 0.01);
    CHECK(again.held[1].measured == Approx(520.0 / 963).epsilon(1e-5));
    CHECK(again.held[1].fitted);
    CHECK(again.held[1].note == "six draws");
    CHECK(withHeld(text, "elements/bulk.toml", {poured, repose}, "six draws") == text);
}
