// Slips that people make, a unit or a file mixed up: the message names the slip, not what follows from it.
#include "host/core/error.h"
#include "tests/model/case_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using test::Folder;
using test::kGoodCase;
using test::replaced;

namespace {

/// The message of loading; a slip is told alone.
std::string told(const Folder& folder, const std::string& text) {
    try {
        loadCase(folder.write("case.toml", text));
    } catch (const CaseError& error) {
        CAPTURE(error.what());
        CHECK(error.faults().size() == 1);
        return error.faults().front().text();
    }
    return "loads";
}

}  // namespace

TEST_CASE("a slip of a unit is told at its own key") {
    const Folder folder;
    CHECK_THAT(told(folder, replaced(kGoodCase, "1427.0", "1.427")),
               Catch::Contains("particles.density = 1.427") && Catch::Contains("1.427 g/cm3 is 1427 kg/m3"));

    const std::string sizes = "\"uniform\"\nradius_min_mm = 0.9\nradius_max_mm = 1.3";
    CHECK_THAT(told(folder, replaced(kGoodCase, sizes, "\"quantiles\"\nd10_um = 1.2\nd50_um = 2.0\nd90_um = 3.1")),
               Catch::Contains("particles.mass_g") && Catch::Contains("d10_um, d50_um and d90_um are in micrometres"));

    folder.write("list.csv", "x,y,z,r\n0,12,8,1.1\n0,20,8,1.1\n");
    std::string listed = replaced(kGoodCase, "mass_g = 0.9", "list = \"list.csv\"");
    listed = replaced(listed, "[particles.size]\ndistribution = " + sizes + "\n", "");
    CHECK_THAT(told(folder, listed), Catch::Contains("particles.list") && Catch::Contains("a list is in metres"));

    folder.write("list.csv", "x;y;z;r\n0;0,012;0,008;0,0011\n");
    CHECK_THAT(told(folder, listed), Catch::Contains("list.csv:1") && Catch::Contains("by commas") &&
                                         Catch::Contains("decimals with a point"));
}

TEST_CASE("a hole or a wire that does not fit is told once, with both ways out") {
    const Folder folder;
    CHECK_THAT(told(folder, replaced(kGoodCase, "outlet_diameter_mm = 14.0", "outlet_diameter_mm = 10.0")),
               Catch::Contains("radius_mm of at most 4.2, or an outlet_diameter_mm of at least 13.4"));
    CHECK_THAT(told(folder, replaced(kGoodCase, "wire_diameter_mm = 1.6", "wire_diameter_mm = 30")),
               Catch::Contains("so thick a wire cannot be wound in the trough"));
}

TEST_CASE("a study given as a case is told so") {
    const Folder folder;
    CHECK_THAT(told(folder, "base = \"x.toml\"\n"), Catch::Contains("there is no file"));
    folder.write("good.toml", kGoodCase);
    const std::string study = "base = \"good.toml\"\n[[axis]]\nkey = \"contact.friction\"\nvalues = [0.2, 0.5]\n";
    CHECK_THAT(told(folder, study), Catch::Contains("this is a study, not a case") && Catch::Contains("vkdose sweep"));
}

TEST_CASE("slips of the syntax are told in words") {
    const Folder folder;
    CHECK_THAT(told(folder, replaced(kGoodCase, "0.9\n", "0,9\n")),
               Catch::Contains("a comma in a number: mass_g = 0,9; write decimals with a point"));
    CHECK_THAT(told(folder, replaced(kGoodCase, "0.9\n", "0.9 g\n")),
               Catch::Contains("more than a value: mass_g = 0.9 g; give the value alone, without its unit"));
    const std::string longLine = told(folder, "name = \"a\"" + std::string(10000, '"') + "\n");
    CHECK_THAT(longLine, Catch::Contains("more than a value: name = \"a\"\"\"\""));
    CHECK(longLine.size() < 500);
    CHECK(told(folder, std::string(10000, 'a') + " = 1\n" + std::string(10000, 'a') + " = 2\n").size() < 500);
    CHECK_THAT(told(folder, "seed = 1\nseed = 2\n"), Catch::Contains("'seed' is there twice; keep one of the two"));
    CHECK_THAT(told(folder, "[coil]\n[stop]\n[coil]\n"), Catch::Contains("'coil' is there twice"));
    CHECK_THAT(told(folder, std::string("\xff\xfes\0e\0", 6)), Catch::Contains("the text is not UTF-8"));
}
