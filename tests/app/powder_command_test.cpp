// The powders that are known, and a case with one of them.
#include <nlohmann/json.hpp>

#include "host/app/find_case.h"
#include "host/core/csv_table.h"
#include "host/model/case.h"
#include "host/model/powder_file.h"
#include "host/model/size_distribution.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

const std::string kPowder = R"(title = "Made up"
draws = "draws.csv"
[particles]
density = 1427.0
[particles.size]
distribution = "uniform"
radius_min_mm = 0.9
radius_max_mm = 1.3
[contact]
k = 2000.0
k1_over_k = 0.2
kc_over_k = 0.3
plasticity_depth = 0.05
damping = 0.02
friction = 0.5
)";

const std::string kShort =
    "--set settle.time_s=0.02 --set settle.until_rest=false --set dose.rotate_s=0.02 --set dose.rest_s=0.005 --set "
    "stop.max_doses=1 --set contact.max_overlap_ratio=0.95 ";

}  // namespace

TEST_CASE("every powder that comes with the program is read, makes a case, and says where its figures are from") {
    const Sandbox box;
    const auto files = powderFiles({std::filesystem::path(VKDOSE_SOURCE_DIR) / "cases"});
    REQUIRE(!files.empty());
    const auto list = box.vkdose("powders");
    const auto json = nlohmann::json::parse(box.vkdose("powders --json").out);
    CHECK(json.size() >= 4);
    for (const auto& p : json) {
        CHECK_THAT(list.out,
                   Catch::Contains(p["name"].get<std::string>()) && Catch::Contains(p["title"].get<std::string>()));
        CHECK(p["published"].get<int>() > 0);
    }
    REQUIRE(list.code == 0);
    for (const auto& file : files) {
        CAPTURE(file);
        const PowderFile p = readPowderFile(file);
        REQUIRE(!p.laboratory.empty());
        CHECK(!p.limits.empty());
        CHECK_THAT(list.out, Catch::Contains(file.stem().string()) && Catch::Contains(p.title));
        const auto told = box.vkdose("powders " + file.stem().string());
        CHECK_THAT(told.out, Catch::Contains(p.laboratory[0].source) && Catch::Contains("limits"));
        for (const PowderFile::Held& h : p.held) CHECK(std::filesystem::exists(file.parent_path() / h.test));
        const auto check = box.vkdose("check mini --assume --powder " + file.stem().string());
        CAPTURE(check.out, check.err);
        CHECK(check.code == 0);
    }
    CHECK_THAT(box.vkdose("powders glas-beads").err, Catch::Contains("did you mean glass-beads?"));
    CHECK_THAT(box.vkdose("check mini --powder glas-beads").err, Catch::Contains("did you mean glass-beads?"));
}

TEST_CASE("draws of a powder are runs of their own, with intervals of what came out") {
    const Sandbox box;
    box.write("powder.toml", kPowder);
    box.write("draws.csv", "contact.friction,contact.kc_over_k\n0.4,0.2\n0.5,0.3\n0.6,0.4\n");
    const std::string command = "run mini --powder powder.toml --draws 3 --backend reference " + kShort;
    const auto o = box.vkdose(command);
    CAPTURE(o.out, o.err);
    REQUIRE(o.code == 0);
    CHECK_THAT(o.out, Catch::Contains("Made up: 3 draws") && Catch::Contains("coil.largest_torque_Nm"));
    const auto json = nlohmann::json::parse(readText(box / "out/mini-draws/prediction.json"));
    CHECK(json["draws"] == 3);
    double sum = 0;
    for (int m = 0; m < 3; ++m)
        sum += nlohmann::json::parse(readText(box / ("out/mini-draws/members/000" + std::to_string(m)) /
                                              "summary.json"))["bodies"][0]["largest_torque_Nm"]
                   .get<double>();
    for (const auto& figure : json["figures"])
        if (figure["name"] == "coil.largest_torque_Nm")
            CHECK(figure["mean"].get<double>() == Approx(sum / 3).epsilon(1e-12));
    const Table members = Table::read(box / "out/mini-draws/members.csv");
    CHECK(members.column("seed") == std::vector<double>{1, 2, 3});
    CHECK(members.column("contact.friction") == std::vector<double>{0.4, 0.5, 0.6});
    const Table figures = Table::read(box / "out/mini-draws/figures.csv");
    CHECK(figures.column("member") == std::vector<double>{0, 1, 2});
    CHECK(figures.column("contact.kc_over_k") == std::vector<double>{0.2, 0.3, 0.4});
    double torque = 0;
    for (const double t : figures.column("coil.largest_torque_Nm")) torque += t;
    CHECK(torque == Approx(sum).epsilon(1e-8));
    CHECK_FALSE(figures.has("cycle.mean_kg"));  // no member has it
    // It goes on without a run.
    const auto again = box.vkdose(command);
    CHECK(again.code == 0);
    CHECK(again.out.substr(again.out.find("Made up")) == o.out.substr(o.out.find("Made up")));
    const auto timed = box.vkdose(command + "--out timed --for 0.001s");
    CHECK(timed.code == 6);
    CHECK_THAT(timed.err, Catch::Contains("--draws 3 --out timed --set settle.time_s=0.02"));

    CHECK_THAT(box.vkdose("run mini --draws 3").err, Catch::Contains("--powder"));
    CHECK_THAT(box.vkdose("run mini --powder powder.toml --draws 4").err, Catch::Contains("has 3 rows"));
    CHECK_THAT(box.vkdose("run mini --powder glass-beads --draws 3").err,
               Catch::Contains("draws") && Catch::Contains("no distribution"));
}

TEST_CASE("new: a case with a powder's file has its contacts, and its sizes as far as the device allows") {
    const Sandbox box;
    box.write("powder.toml", kPowder);
    box.write("draws.csv", "contact.friction\n0.4\n");
    const std::string device = " --canister 80x50x100mm --coil 5x15mm --fill 100g ";
    const auto o = box.vkdose("new plain.toml --powder powder.toml" + device);
    CAPTURE(o.out, o.err);
    REQUIRE(o.code == 0);
    CHECK_THAT(o.out, Catch::Contains("Made up (powder.toml)") && Catch::Contains("bulk_density of the powder's file"));
    Case c = loadCase(box / "plain.toml");
    CHECK(c.dosingLaw.of(ContactClass::ParticleParticle).mu == 0.5);
    CHECK(c.world.density() == 1427);
    CHECK(c.bulkDensity == Approx(0.46 * 1427).epsilon(0.01));
    CHECK(c.filling.mass == Approx(0.1));
    CHECK(meanRadius(c.filling.size) == Approx(1.1e-3 * c.filling.size.scaleUp));
    // 12500 spheres as they are; so they are larger, and their contacts do not follow.
    CHECK(c.filling.size.scaleUp > 1.3);
    CHECK_THAT(o.out, Catch::Contains("its contacts do not follow"));

    // Grains of a tenth of a millimetre, with contacts that follow.
    std::string fine = kPowder;
    fine.replace(fine.find("distribution"), fine.find("[contact]") - fine.find("distribution"),
                 "distribution = \"quantiles\"\nd10_um = 90\nd50_um = 120\nd90_um = 500\n");
    box.write("fine.toml", fine + "scaling = \"stress\"\n");
    const auto scaled = box.vkdose("new sub/fine.toml --powder fine.toml" + device);
    CHECK(scaled.code == 5);  // there is no such folder
    std::filesystem::create_directory(box / "sub");
    const auto enlarged = box.vkdose("new sub/fine.toml --powder fine.toml" + device);
    CAPTURE(enlarged.out, enlarged.err);
    REQUIRE(enlarged.code == 0);
    CHECK_THAT(enlarged.out, !Catch::Contains("do not follow"));
    c = loadCase(box / "sub/fine.toml");
    const double s = c.filling.size.scaleUp;
    CHECK(s > 5);
    CHECK(c.dosingLaw.of(ContactClass::ParticleParticle).k2Max == Approx(2000 * s));
    CHECK(largestRadius(c.filling.size) <= 3.01 * smallestRadius(c.filling.size));
    CHECK(largestRadius(c.filling.size) == Approx(coarsestRadius(c.filling.size)).epsilon(1e-5));

    CHECK_THAT(box.vkdose("new no.toml --powder fine.toml --flow free" + device).err,
               Catch::Contains("--flow is told by the file of --powder"));
    CHECK_THAT(box.vkdose("new no.toml --screw --powder glass-beads").err, Catch::Contains("vkdose run"));
    box.write("bad.toml", "title = \"x\"\n[particles]\ndensity = -1.0\n[particles.size]\n[contact]\nk = 1.0\n");
    const auto bad = box.vkdose("new no.toml --powder bad.toml" + device);
    CHECK(bad.code == 2);
    CHECK_THAT(bad.err,
               Catch::Contains("bad.toml:3: particles.density") && Catch::Contains("particles.size.distribution"));
    CHECK_FALSE(std::filesystem::exists(box / "no.toml"));
}

TEST_CASE("a powder is found by its laboratory figures, and written as a file that cases take") {
    const Sandbox box;
    const auto o = box.vkdose("powders --like bulk=520 tapped=600+-10 --out my.toml");
    CAPTURE(o.out, o.err);
    REQUIRE(o.code == 0);
    CHECK_THAT(o.out, Catch::Contains("tapped 600 +- 10") && Catch::Contains("bulk 520 +- 16") &&
                          Catch::Contains("Hausner ratio") && Catch::Contains("foretold   poured volume fraction"));
    CHECK(Table::read(box / "my-draws.csv").rows() == 200);
    CHECK(box.vkdose("check mini --assume --powder my.toml").code == 0);
    CHECK(box.vkdose("run mini --powder my.toml --draws 2 --backend reference " + kShort).code == 0);
    const auto again = box.vkdose("powders --like bulk=520 tapped=600+-10 --out my.toml");
    CHECK(again.code == 2);
    CHECK_THAT(again.err, Catch::Contains("my.toml"));

    const auto refused = [&](const std::string& figures, const std::string& why) {
        const auto r = box.vkdose("powders --like " + figures);
        CAPTURE(figures, r.err);
        CHECK(r.code != 0);
        CHECK_THAT(r.err, Catch::Contains(why));
    };
    refused("repos=40", "there is no such figure; give some of density, bulk");
    refused("repose", "has no value; write repose=48");
    refused("repose=-4", "no number above 0");
    refused("repose=40+-0", "has an error that is no number above 0");
    refused("repose=40 repose=41", "given twice");
    refused("bulk=600 tapped=500", "bulk = 600 is not below tapped = 500");
    refused("bulk=500 tapped=600 hausner=1.2", "give two of the three");
    refused("bulk=520", "give repose, drum");
    CHECK(box.files().size() == 3);  // my.toml, my-draws.csv, out
}

TEST_CASE("a powder's draws are run in the element tests of its figures, and its file keeps what they said") {
    const Sandbox box;
    // An element test and its study, as those that come with the program: this folder's are found first.
    for (const char* folder : {"cases/elements", "cases/powders/table"})
        std::filesystem::create_directories(box / folder);
    box.write("cases/elements/bulk.toml",
              "base = \"" VKDOSE_SOURCE_DIR
              "/cases/elements/bulk.toml\"\n[particles]\nmass_g = 2.0\n[particles.region]\nlow = [-8.2e-3, 0.2e-3, "
              "-8.2e-3]\nhigh = [8.2e-3, 40e-3, 8.2e-3]\n[settle]\ntime_s = 0.11\n[frames]\ninterval_s = 0.01\n"
              "[[measure]]\nkind = \"bulk_density\"\nname = \"poured\"\nradius_mm = 12.0\ntime_s = 0.1\n");
    box.write("cases/powders/table/bulk.toml",
              "base = \"../../elements/bulk.toml\"\n[[axis]]\nkeys = [\"contact.friction\", \"contact.kc_over_k\"]\n"
              "low = [0, 0]\nhigh = [1, 1]\npoints = 3\n");
    const std::string laboratory =
        "[[laboratory]]\nfigure = \"density\"\nvalue = 1427\nsource = \"given\"\nfitted = true\n";
    box.write("powder.toml", kPowder + laboratory +
                                 "[[laboratory]]\nfigure = \"bulk\"\nvalue = 10\nsource = \"given\"\nfitted = true\n");
    box.write("draws.csv", "contact.friction,contact.kc_over_k\n0.4,0.2\n0.5,0.3\n");
    const auto o = box.vkdose("powders powder.toml --confirm 2 --backend reference");
    CAPTURE(o.out, o.err);
    CHECK(o.code == 1);  // no powder is as light as that
    CHECK_THAT(o.out, Catch::Contains("poured volume fraction") && Catch::Contains("by 2 runs: not met"));
    const PowderFile p = readPowderFile(box / "powder.toml");
    REQUIRE(p.held.size() == 1);
    CHECK(p.held[0].test == "cases/elements/bulk.toml");
    CHECK(p.held[0].fitted);
    double sum = 0;
    for (const char* m : {"0000", "0001"})
        sum += nlohmann::json::parse(readText(box / "out/powder-bulk/members" / m /
                                              "summary.json"))["measures"]["poured"]["solid_fraction"]
                   .get<double>();
    CHECK(p.held[0].simulated == Approx(sum / 2).epsilon(1e-5));
    // With the figure that they have it is met, and the runs are there already.
    std::string text = readText(box / "powder.toml");
    const std::string was = "value = 10\n";
    text.replace(text.find(was), was.size(), "value = " + std::to_string(1427 * sum / 2) + "\n");
    box.write("powder.toml", text);
    const auto again = box.vkdose("powders powder.toml --confirm 2 --backend reference");
    CAPTURE(again.out, again.err);
    CHECK(again.code == 0);
    CHECK(readPowderFile(box / "powder.toml").held.size() == 1);

    box.write("powder.toml", kPowder + laboratory);
    CHECK_THAT(box.vkdose("powders powder.toml --confirm 2").err, Catch::Contains("has no figure of an element test"));
    CHECK_THAT(box.vkdose("powders glass-beads --confirm 2").err, Catch::Contains("draws: is missing"));
    CHECK_THAT(box.vkdose("powders --confirm 2").err, Catch::Contains("--confirm requires"));
}
