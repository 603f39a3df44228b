// `vkdose new`: from a device and a powder to a case that runs.

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/app/backends.h"
#include "host/app/exit_code.h"
#include "host/app/measures.h"
#include "host/app/new_study.h"
#include "host/app/new_template.h"
#include "host/model/body_form.h"
#include "host/model/case.h"
#include "tests/app/sandbox.h"
#include "tests/model/case_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;
namespace fs = std::filesystem;

namespace {

/// The device that the manual shows, one of milligrams and one of kilograms, with powders that flow differently.
const std::string kTechnologist = "--canister 80x30x100mm --coil 6x5mm";
const std::string kTiny =
    "--canister 8x5x12mm --coil 1.5mm --fill 60mg --bulk-density 0.35g/cm3 --sizes 40/80/140um --flow cohesive";
const std::string kLarge =
    "--canister 400x250x500mm --coil 6x80mm --outlet 20cm --wire 10mm --fill 12kg --bulk-density 650kg/m3 "
    "--sizes 1.5mm --flow free";

nlohmann::json checked(const Sandbox& box, const std::string& file) {
    const auto o = box.vkdose("check --json " + file);
    CAPTURE(o.err);
    REQUIRE(o.code == 0);
    return nlohmann::json::parse(o.out);
}

std::string refusal(Measure kind, const std::string& text) {
    try {
        measuresOf(kind, "--it", text, 'x', "5mm");
    } catch (const UsageError& e) {
        return e.what();
    }
    return "not refused";
}

}  // namespace

TEST_CASE("measures are read with their units, and nothing is guessed") {
    CHECK(measuresOf(Measure::Length, "", "80 x 30x100mm", 'x', "") == std::vector<double>{0.08, 0.03, 0.1});
    const auto mixed = measuresOf(Measure::Length, "", "8cmx30mmx0.1m", 'x', "");
    CHECK(mixed[0] == Approx(0.08));
    CHECK(mixed[1] == Approx(0.03));
    CHECK(measureOf(Measure::Mass, "", "2.5kg", "") == 2.5);
    CHECK(measureOf(Measure::Mass, "", "60 mg", "") == Approx(60e-6));
    CHECK(measureOf(Measure::Density, "", "0.5 g/cm3", "") == Approx(500));
    CHECK(measureOf(Measure::Speed, "", "60rpm", "") == Approx(6.283185307));
    CHECK(countOf("", "12", 20, "") == 12);
    for (const char* bad : {"", "mm", "80", "80x30", "-5mm", "0mm", "5 furlongs", "nanmm", "1e9m", "80xmm", "5mmx"})
        CHECK_THAT(refusal(Measure::Length, bad), Catch::StartsWith("--it") && Catch::Contains("; write 5mm"));
    CHECK_THAT(refusal(Measure::Length, "7,5mm"), Catch::Contains("a decimal point is meant, not a comma"));
    CHECK_THAT(refusal(Measure::Length, "80"), Catch::Contains("lacks the unit (mm, cm, m, um)"));
    CHECK_THROWS_AS(countOf("", "2.5", 20, ""), UsageError);
}

TEST_CASE("figures are rounded to digits that can be read") {
    CHECK(figureText(0.012345) == "0.0123");
    CHECK(figureText(1234.0) == "1230");
    CHECK(roundedUp(1.201, 2) == 1.3);
    CHECK(roundedUp(1.2, 2) == 1.2);
    CHECK(roundedUp(0.1 * 3, 1) == 0.3);  // 0.30000000000000004
    CHECK(roundedDown(0.1999, 2) == 0.19);
    CHECK(lengthText(0.03) == "30 mm");
    CHECK(lengthText(9e-5) == "90 um");
    CHECK(massText(6e-5) == "60 mg");
    CHECK(massText(12) == "12 kg");
}

TEST_CASE("new: devices that are ready are cases that check has nothing against") {
    const Sandbox box;
    for (const DeviceTemplate& device : kDeviceTemplates) {
        const std::string name = device.name;
        INFO(name);
        const auto made = box.vkdose("new my-" + name + ".toml --" + name);
        CAPTURE(made.err);
        REQUIRE(made.code == kOk);
        CHECK_THAT(made.out, Catch::Contains(device.about) && Catch::Contains("vkdose render my-" + name + ".toml") &&
                                 !Catch::Contains("warning"));
        const nlohmann::json told = checked(box, "my-" + name + ".toml");
        CHECK(told.at("warnings").empty());
        CHECK_THAT(readText(box / ("my-" + name + ".toml")), Catch::StartsWith("# A"));
    }

    const auto refused = [&](const std::string& arguments, const std::string& why) {
        INFO(arguments);
        const auto told = box.vkdose("new " + arguments);
        CHECK(told.code == kBadInput);
        CHECK_THAT(told.err, Catch::Contains(why));
    };
    refused("my-screw.toml --screw", "is there already");
    CHECK_THAT(readText(box / "my-dosator.toml"), Catch::Contains("\"my-dosator-tube.csv\""));
    CHECK_THAT(readText(box / "my-dosator-tube.csv"), Catch::StartsWith("time_s,x,y"));
    box.write("your-piston.csv", "mine");
    refused("your.toml --dosator", "your-piston.csv is there already");
    CHECK(readText(box / "your-piston.csv") == "mine");
    CHECK_FALSE(std::filesystem::exists(box / "your-tube.csv"));
    refused("a.toml --screw --tray", "--tray and --screw");
    refused("a.toml --screw --speed 20rpm", "--screw and --speed");
}

TEST_CASE("new: studies over a case are ready to run") {
    const Sandbox box;
    REQUIRE(box.vkdose("new tray.toml --tray").code == kOk);
    fs::create_directory(box / "studies");
    for (const StudyTemplate& study : kStudyTemplates) {
        const std::string command = study.command;
        INFO(command);
        for (const std::string& base :
             {box.write("mini.toml", readText(shippedCase("mini.toml"))).string(), std::string("tray.toml")}) {
            CAPTURE(base);
            fs::remove(box / "studies/my.toml");
            const auto made = box.vkdose("new studies/my.toml --" + command + " " + base);
            CAPTURE(made.err);
            REQUIRE(made.code == kOk);
            CHECK_THAT(made.out, Catch::Contains("vkdose " + command + " studies/my.toml --dry-run"));
            const auto planned = box.vkdose(command + " studies/my.toml --dry-run --assume");
            CAPTURE(planned.err);
            CHECK(planned.code == kOk);
        }
    }
    CHECK_THAT(box.vkdose("new a.toml --sweep none.toml").err, Catch::Contains("none.toml"));
    CHECK_THAT(box.vkdose("new a.toml --sweep mini.toml --screw").err, Catch::Contains("--sweep and --screw"));
    box.write("still.toml", "base = \"mini.toml\"\n[dose]\nrotate_s = 0\nrest_s = 0\n[stop]\nrule = \"none\"\n");
    const auto still = box.vkdose("new a.toml --design still.toml");
    CHECK(still.code == kBadInput);
    CHECK_THAT(still.err, Catch::Contains("has no doses"));
    CHECK_FALSE(fs::exists(box / "a.toml"));
}

TEST_CASE("new: three devices give cases that check has nothing against") {
    const Sandbox box;
    struct Device {
        std::string options;
        double fill;
        std::vector<std::string> accepted, warned;
    };
    for (const Device& device : {Device{kTechnologist, 0.05, {"coil-start"}, {"throat"}}, Device{kTiny, 60e-6, {}, {}},
                                 Device{kLarge, 12, {}, {"throat"}}}) {
        CAPTURE(device.options);
        fs::remove(box / "my.toml");
        const auto made = box.vkdose("new my.toml " + device.options);
        CAPTURE(made.err);
        REQUIRE(made.code == 0);
        CHECK_THAT(made.out, Catch::Contains("vkdose check my.toml") && Catch::Contains("vkdose render my.toml") &&
                                 Catch::Contains("particle-steps"));
        CHECK((made.out.find("warning") != made.out.npos) == !device.warned.empty());
        const auto check = checked(box, "my.toml");
        std::vector<std::string> accepted, warned;
        for (const auto& w : check["warnings"]) (w["accepted"] == true ? accepted : warned).push_back(w["name"]);
        CHECK(accepted == device.accepted);
        CHECK(warned == device.warned);
        const auto& f = check["figures"];
        CHECK(f["fill_kg"].get<double>() == Approx(device.fill).epsilon(0.02));
        CHECK(f["particles"] > 1000);
        CHECK(f["particles"] < 30000);
        // The targets of the contacts, by the figures of check.
        CHECK(std::max(f["overlap_under_bed"].get<double>() / 0.005, f["overlap_of_fall"].get<double>() / 0.3) ==
              Approx(1).epsilon(0.05));
        CHECK(f["restitution"]["particle-particle"]["mean"].get<double>() == Approx(0.5).epsilon(0.05));
    }
}

TEST_CASE("new: the run time is measured on the device or not told, and nothing measured is in the file") {
    const Sandbox box;
    const auto made = box.vkdose("new my.toml " + kTiny);
    CAPTURE(made.out, made.err);
    REQUIRE(made.code == 0);
    const std::size_t line = made.out.find("\nrun time   ");
    REQUIRE(line != std::string::npos);
    CHECK_THAT(made.out.substr(line + 1, made.out.find('\n', line + 1) - line),
               Catch::Contains("particle-steps/s, measured on vulkan"));
    CHECK_THAT(made.out, !Catch::Contains("at an assumed"));

    fs::create_directory(box / "other");
    const auto without = box.vkdose("new other/my.toml " + kTiny,
                                    "env -u VK_DRIVER_FILES -u VK_ADD_DRIVER_FILES NODEVICE_SELECT=1 "
                                    "VK_ICD_FILENAMES=/nowhere/icd.json ");
    CAPTURE(without.out, without.err);
    CHECK(without.code == 0);
    CHECK_THAT(without.out, Catch::Contains("run time   not known, because the device could not be measured: ") &&
                                Catch::Contains("particle-steps\n") && !Catch::Contains("particle-steps/s"));
    CHECK(readText(box / "other/my.toml") == readText(box / "my.toml"));
}

TEST_CASE("new: the coil is placed as its turns and pitch say") {
    const Sandbox box;
    const auto coilOf = [&](const std::string& coil) {
        fs::remove(box / "my.toml");
        const auto o = box.vkdose("new my.toml --canister 80x30x100mm " + coil);
        CAPTURE(coil, o.err);
        REQUIRE(o.code == 0);
        return loadCase(box / "my.toml");
    };
    Case c = coilOf("--coil 6x5mm");
    CHECK(c.world.coil->pitch == Approx(5e-3));
    CHECK(c.world.coil->length == Approx(30e-3));
    CHECK(c.world.coil->zStart + c.world.coil->length == Approx(c.canister->length + c.canister->throatLength));
    CHECK_THAT(readText(box / "my.toml"), Catch::Contains("the powder") && Catch::Contains("behind it stays"));
    c = coilOf("--coil '18 x 5mm'");  // 90 mm: the throat is what reaches beyond the canister
    CHECK(c.canister->throatLength == Approx(10e-3));
    CHECK(c.world.coil->zStart == Approx(0).margin(1e-9));
    c = coilOf("--coil 10mm --throat 20mm");
    CHECK(c.world.coil->length == Approx(100e-3));
    c = coilOf("--coil 5turns --throat 20mm");
    CHECK(c.world.coil->pitch == Approx(20e-3));
}

TEST_CASE("new: a mesh stands in the place of the coil, laid along the canister and turning towards the outlet") {
    const Sandbox box;
    fs::create_directory(box / "deep");
    fs::copy_file(shippedCase("devices/spring.stl"), box / "deep/spring.stl");  // along x, right-handed
    fs::copy_file(shippedCase("devices/auger.stl"), box / "auger.stl");
    const std::string device = " --canister 30x12x25mm --fill 3g --flow cohesive --spheres 1000 ";
    const auto made = box.vkdose("new deep/my.toml --mesh deep/spring.stl --unit mm" + device);
    CAPTURE(made.err);
    REQUIRE(made.code == 0);
    CHECK_THAT(made.out, Catch::Contains("1308 triangles, 35 x 11.4 x 11.4 mm") &&
                             Catch::Contains("conveys powder by 5 mm") && !Catch::Contains("warning"));
    const Case c = loadCase(box / "deep/my.toml");
    REQUIRE(c.world.bodies.size() == 1);
    CHECK_FALSE(c.world.coil);
    const RigidBody& body = c.world.bodies[0];
    const TurningReach reach = reachOf(trianglesOf(body), Vec3(0, 0, 1), Vec3(0));
    CHECK(reach.radius == Approx(5.7e-3).epsilon(0.01));
    CHECK(reach.high == Approx(c.canister->length + c.canister->throatLength).epsilon(1e-4));
    const auto& turn = std::get<geometry::Turn>(body.course.motion);
    CHECK(turn.rate * advancePerTurn(trianglesOf(body), turn.axis, turn.through) == Approx(5e-3).epsilon(0.02));
    CHECK(c.filling.region.low.y == Approx(reach.radius).epsilon(0.01));

    const auto refused = [&](const std::string& options, const std::string& why) {
        const auto o = box.vkdose("new no.toml" + device + options);
        CAPTURE(options);
        CHECK(o.code == 2);
        CHECK_THAT(o.err, Catch::Contains(why));
        CHECK_FALSE(fs::exists(box / "no.toml"));
    };
    refused("--mesh deep/spring.stl", "give --unit too");
    refused("--mesh deep/spring.stl --unit cm", "reaches 57 mm from its axis");
    refused("--mesh deep/spring.stl --unit um", "the unit that it was drawn in");
    refused("--mesh deep/spring.stl --unit furlong", "give one of m, cm, mm, um, inch");
    refused("--mesh gone.stl --unit mm", "gone.stl");
    refused("--mesh deep/spring.stl --unit mm --coil 5mm", "one or the other");
    refused("--unit mm --coil 5mm", "--unit is that of a mesh");
    refused("--mesh auger.stl --unit mm --throat 1mm --outlet 12mm", "48 mm long, canister and throat together 31 mm");
}

TEST_CASE("new: a dose to a mass, and more spheres than asked for are told") {
    const Sandbox box;
    const std::string device = "new my.toml --canister 6x3x6mm --coil 0.9mm --fill 15mg --flow cohesive ";
    const auto made = box.vkdose(device + "--dose 2mg --spheres 500");
    CAPTURE(made.err);
    REQUIRE(made.code == 0);
    CHECK_THAT(made.out, Catch::Contains("500 spheres were asked for") && Catch::Contains("the gap between the turns"));
    const Case c = loadCase(box / "my.toml");
    CHECK(c.schedule.targetMass == Approx(2e-6));
    const double turns = 2e-6 / derive(c, insertParticles(c)).massPerTurn;
    CHECK(c.schedule.rotateTime == Approx(3 * turns * 2 * kPi / c.schedule.coilSpeed).epsilon(0.1));
    fs::remove(box / "my.toml");
    CHECK_THAT(box.vkdose(device + "--dose 2mg --rotate 1s").err, Catch::Contains("one or the other"));
    CHECK_THAT(box.vkdose(device + "--dose 20mg").err, Catch::Contains("more than the fill of 15 mg"));
}

TEST_CASE("new: what is ambiguous or contradictory is refused with what would be right, and nothing is written") {
    const Sandbox box;
    const auto refused = [&](const std::string& options, const std::string& why) {
        const auto o = box.vkdose("new my.toml " + options);
        CAPTURE(options, o.err);
        CHECK(o.code == 2);
        CHECK_THAT(o.err, Catch::Contains(why));
    };
    const std::string device = "--canister 80x30x100mm ";
    refused("", "--canister is needed");
    refused(device, "--coil or --mesh is needed");
    refused("--canister 80x30mm --coil 5mm", "it is not clear which lengths these are; give all three: 80x30x100mm");
    refused("--canister 80x30x100 --coil 5mm", "lacks the unit");
    refused(device + "--coil 6", "could be turns or a pitch; write 6x5mm");
    refused(device + "--coil 6x5", "lacks the unit");
    refused(device + "--coil 6mmx5mm", "is no number of turns");
    refused(device + "--coil 60x5mm", "300 mm long, canister and throat together 85 mm; give 17x5mm");
    refused(device + "--coil 5mm --outlet 40mm", "wider than the canister");
    refused(device + "--coil 5mm --wire 6mm", "touch one another");
    refused(device + "--coil 5mm --fill 5kg", "the canister holds 2");
    refused(device + "--coil 5mm --sizes 90/60/130um", "must increase");
    refused(device + "--coil 5mm --flow sticky", "write free, easy or cohesive");
    refused(device + "--coil 5mm --speed 60", "lacks the unit");
    CHECK(box.files().empty());
}

TEST_CASE("new: it never replaces a file, and says how to name one") {
    const Sandbox box;
    box.write("my.toml", "mine");
    CHECK_THAT(box.vkdose("new my.toml " + kLarge).err, Catch::Contains("my.toml is there already"));
    CHECK(readText(box / "my.toml") == "mine");
    fs::create_symlink("nowhere", box / "link.toml");
    CHECK(box.vkdose("new link.toml " + kLarge).code == 2);
    CHECK_THAT(box.vkdose("new my.csv " + kLarge).err, Catch::Contains("ends in .toml"));
    CHECK(box.vkdose("new no/folder.toml " + kLarge).code == 5);
    CHECK(box.files().size() == 2);
}

TEST_CASE("new: the dialogue asks again until it understands, and gives the case of the same options") {
    const Sandbox box;
    // canister, coil, outlet, wire, fill, powder, bulk density, sizes, flow, speed, rotate, doses, spheres
    box.write("answers", "80x30\n80x30x100mm\n\n6\n6turns\n\n\n48 g\n\n500kg/m3\n\ncohesive\n90rpm\n\n5\n\n");
    const std::string from = "' new my.toml --ask < answers > said.txt 2>&1";
    REQUIRE(std::system(("cd '" + box.path().string() + "' && '" VKDOSE_BINARY_DIR "/vkdose" + from).c_str()) == 0);
    const std::string said = readText(box / "said.txt");
    CHECK_THAT(said, Catch::Contains("lacks the unit") && Catch::Contains("could be turns or a pitch"));
    REQUIRE(box.vkdose("new same.toml --canister 80x30x100mm --coil 6turns --fill 48g --bulk-density 500kg/m3 --flow "
                       "cohesive --speed 90rpm --doses 5")
                .code == 0);
    CHECK(readText(box / "my.toml") == readText(box / "same.toml"));
    // A powder's file answers the questions about the powder.
    box.write("answers", "80x30x100mm\n6turns\n\n\n48g\nglas-beads\nglass-beads\n90rpm\n\n5\n\n");
    const std::string beads = "' new beads.toml --ask < answers > said.txt 2>&1";
    REQUIRE(std::system(("cd '" + box.path().string() + "' && '" VKDOSE_BINARY_DIR "/vkdose" + beads).c_str()) == 0);
    CHECK_THAT(readText(box / "said.txt"), Catch::Contains("did you mean glass-beads?") && !Catch::Contains("sizes"));
    CHECK_THAT(readText(box / "beads.toml"), Catch::Contains("glass-beads.toml\""));
    const auto ended = box.vkdose("new other.toml --ask");
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err, Catch::Contains("the answers end before --canister; nothing was written"));
    CHECK_FALSE(fs::exists(box / "other.toml"));
}

TEST_CASE("new: a case of few spheres runs and doses", "[slow]") {
    const Sandbox box;
    REQUIRE(box.vkdose("new 'my case.toml' " + kLarge + " --spheres 250 --rotate 1s --doses 1").code == 0);
    const auto run = box.vkdose("run 'my case.toml' --backend reference");
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    const auto doses = readCsv(box / "out/my case/doses.csv");
    REQUIRE(doses.size() == 2);
    CHECK(std::stod(doses[1][2]) > 0.1);  // kg
    // The command that comes next can be pasted, though its path holds a blank.
    const std::size_t at = run.out.find("vkdose report ");
    REQUIRE(at != std::string::npos);
    const std::size_t end = run.out.find("   (", at);
    CHECK(box.vkdose(run.out.substr(at + 7, end - at - 7)).code == 0);
    CHECK(fs::exists(box / "out/my case/report.html"));
}
