// Every way a case can be wrong, one at a time: the fault must name the line, the key, the value and a remedy, and
// must come alone.
#include <algorithm>
#include <cmath>

#include "host/core/error.h"
#include "tests/model/case_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using test::Folder;
using test::kFreeCase;
using test::kGoodCase;
using test::replaced;

namespace {

struct Fault {
    std::string from;   ///< text of the good case ...
    std::string to;     ///< ... and what replaces it
    std::string where;  ///< text at the start of the line that must be blamed; "" for the whole file
    std::string key;
    std::string fragment;  ///< of problem or remedy
};

int lineOf(const std::string& text, const std::string& what) {
    if (what.empty()) return 0;
    const std::size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

std::vector<Diagnostic> faultsOf(const std::filesystem::path& file, const std::vector<std::string>& overrides = {}) {
    try {
        loadCase(file, overrides);
    } catch (const CaseError& error) {
        return error.faults();
    }
    return {};
}

void checkFault(const Fault& row) {
    INFO(row.from << " -> " << row.to);
    const Folder folder;
    const std::string text = replaced(kGoodCase, row.from, row.to);
    const auto file = folder.write("case.toml", text);
    const std::vector<Diagnostic> faults = faultsOf(file);
    REQUIRE_FALSE(faults.empty());
    INFO(CaseError(faults).what());
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].file == file.string());
    CHECK(faults[0].line == lineOf(text, row.where));
    CHECK(faults[0].key == row.key);
    CHECK_THAT(faults[0].text(), Catch::Contains(row.fragment));
    CHECK_FALSE(faults[0].remedy.empty());
}

}  // namespace

TEST_CASE("the case the faults are made from is good") {
    const Folder folder;
    CHECK_NOTHROW(loadCase(folder.write("good.toml", kGoodCase)));
}

TEST_CASE("faults of a single key") {
    const std::vector<Fault> rows{
        {"density = 1427.0\n", "", "[particles]", "particles.density", "is missing"},
        {"mass_g = 0.9\n", "", "[particles]", "particles.mass_g", "is missing"},
        {"speed_rpm = 120.0\n", "", "[coil]", "coil.speed_rpm", "[rpm]"},
        {"turns = 3\n", "", "[coil]", "coil.turns", "turns or pitch_mm"},
        {"turns = 3\n", "turns = 3\npitch_mm = 7\n", "pitch_mm", "coil.pitch_mm", "turns is given too"},
        {"speed_rpm = 120.0", "speed = 120.0\nspeed_rpm = 120.0", "speed =", "coil.speed", "did you mean speed_rpm?"},
        {"[settle]", "[setle]\n[settle]", "[setle]", "setle", "did you mean settle?"},
        {"[stop]", "[sensor]\n[stop]", "[sensor]", "sensor", "did you mean sensors?"},
        {"seed = 3", "seed = 3\nxyzzy = 1", "xyzzy", "xyzzy", "known here"},
        {"mass_g = 0.9", "mass_g = \"0.9\"", "mass_g", "particles.mass_g", "is a string, not a number"},
        {"mass_g = 0.9", "mass_g = true", "mass_g", "particles.mass_g", "is a boolean, not a number"},
        {"mass_g = 0.9", "mass_g = [1]", "mass_g", "particles.mass_g", "is an array, not a number"},
        {"mass_g = 0.9", "mass_g = 2024-01-01", "mass_g", "particles.mass_g", "is a date or time"},
        {"mass_g = 0.9", "mass_g = -0.9", "mass_g", "particles.mass_g", "-0.9: is negative"},
        {"mass_g = 0.9", "mass_g = 0", "mass_g", "particles.mass_g", "is zero"},
        {"mass_g = 0.9", "mass_g = nan", "mass_g", "particles.mass_g", "nan: is not a finite number"},
        {"k = 2000.0", "k = inf", "k = inf", "contact.k", "inf: is not a finite number"},
        {"friction = 0.5", "friction = -0.5", "friction", "contact.friction", "is negative"},
        {"friction = 0.2\n[can", "friction = -0.2\n[can", "friction = -0.2", "contact.wall.friction", "is negative"},
        {"seed = 3", "seed = 3.5", "seed", "seed", "not a whole number"},
        {"seed = 3", "seed = -3", "seed", "seed", "is negative"},
        {"name = \"good\"", "name = 5", "name", "name", "not a string"},
        {"seed = 3", "gravity = [0, -9.81]", "gravity", "gravity", "three numbers"},
        {"seed = 3", "gravity = [0, nan, 0]", "gravity", "gravity", "nan is not a finite number"},
        {"[dose]\nrotate_s = 0.3\nrest_s = 0.1\n[stop]\nrule = \"experiment\"\n", "[stop]\nmax_doses = 0\n",
         "max_doses", "stop.max_doses", ">= 1"},
        {"\"uniform\"", "\"unifrom\"", "distribution", "particles.size.distribution", "did you mean \"uniform\"?"},
        {"\"uniform\"", "\"gamma\"", "distribution", "particles.size.distribution", "lognormal"},
        {"boundaries = \"canister\"", "boundaries = 1", "boundaries", "boundaries", "not a string"},
        {"boundaries = \"canister\"", "boundaries = \"canster\"", "boundaries", "boundaries", "\"canister\"?"},
        {"\"experiment\"", "\"expirement\"\nthreshold_g = 1", "rule", "stop.rule", "did you mean \"experiment\"?"},
        {"[stop]", "[time]\nstep_s = \"automatic\"\n[stop]", "step_s", "time.step_s", "did you mean \"auto\"?"},
    };
    for (const Fault& row : rows) checkFault(row);
}

TEST_CASE("a misspelt key is told beside the one that is missing") {
    const Folder folder;
    const auto faults = faultsOf(folder.write("case.toml", replaced(kGoodCase, "damping = 0.02", "dampng = 0.02")));
    REQUIRE(faults.size() == 2);
    CHECK(faults[0].key == "contact.damping");
    CHECK_THAT(faults[1].text(), Catch::Contains("contact.dampng = 0.02: unknown key; did you mean damping?"));
}

TEST_CASE("a misspelt table is one missing and one unknown") {
    const Folder folder;
    const auto faults = faultsOf(folder.write("case.toml", replaced(kGoodCase, "[canister]", "[cannister]")));
    REQUIRE(faults.size() == 2);
    CHECK_THAT(faults[0].text(), Catch::Contains("canister: the table is missing"));
    CHECK_THAT(faults[1].text(), Catch::Contains("cannister: unknown table; did you mean canister?"));
    CHECK(faults[1].line == lineOf(replaced(kGoodCase, "[canister]", "[cannister]"), "[cannister]"));
}

TEST_CASE("keys of another distribution are refused") {
    const Folder folder;
    const std::string text = replaced(kGoodCase, "\"uniform\"", "\"fixed\"");
    const auto faults = faultsOf(folder.write("case.toml", text));
    REQUIRE(faults.size() == 3);
    CHECK_THAT(CaseError(faults).what(), Catch::Contains("particles.size.radius_mm: is missing") &&
                                             Catch::Contains("particles.size.radius_min_mm = 0.9: unknown key") &&
                                             Catch::Contains("particles.size.radius_max_mm = 1.3: unknown key"));
}

TEST_CASE("faults between keys") {
    const std::vector<Fault> rows{
        {"k1_over_k = 0.2", "k1_over_k = 5", "k1_over_k", "contact.k1_over_k", "<= 1"},
        {"[contact.wall]\n", "[contact.wall]\nk1_over_k = 1.5\n", "k1_over_k = 1.5", "contact.wall.k1_over_k", "<= 1"},
        {"plasticity_depth = 0.05", "plasticity_depth = 0", "plasticity_depth", "contact.plasticity_depth", "is zero"},
        {"radius_min_mm = 0.9", "radius_min_mm = 1.9", "radius_min_mm", "particles.size.radius_min_mm",
         "give at most 1.3 mm"},
        {"radius_mm = 5.9", "radius_mm = 6.3", "radius_mm = 6.3", "coil.radius_mm",
         "reaches 7.1 mm from its axis, the trough only 7 mm; give a radius_mm of at most 6.2"},
        {"radius_mm = 5.9", "clearance_mm = 6", "clearance_mm", "coil.clearance_mm", "fills the coil"},
        {"outlet_diameter_mm = 14.0", "outlet_diameter_mm = 13.0", "radius_mm = 5.9", "coil.radius_mm",
         "the outlet only 6.5 mm"},
        {"outlet_diameter_mm = 14.0", "outlet_diameter_mm = 15.0", "outlet_diameter_mm", "canister.outlet_diameter_mm",
         "wider than the canister"},
        {"height_mm = 60.0", "height_mm = 6.0", "height_mm", "canister.height_mm", "below the coil's axis"},
        {"turns = 3", "turns = 15", "turns", "coil.turns", "the turns overlap"},
        {"turns = 3", "pitch_mm = 1.5", "pitch_mm", "coil.pitch_mm", "the turns overlap"},
        {"mass_g = 0.9", "mass_g = 9", "mass_g", "particles.mass_g", "the fill does not fit"},
        {"radius_max_mm = 1.3", "radius_max_mm = 7", "radius_max_mm", "particles.size.radius_max_mm", "do not pass"},
        {"[stop]", "[time]\nstep_s = 1e-4\n[stop]", "step_s", "time.step_s", "is unstable"},
        {"rule = \"experiment\"", "rule = \"none\"", "rule", "stop.rule", "never end"},
        {"time_s = 0.15\n[dose]\nrotate_s = 0.3\nrest_s = 0.1\n[stop]\nrule = \"experiment\"", "time_s = 0", "time_s",
         "settle.time_s", "nothing to run"},
        {"[stop]", "[domain]\nlow = [1, 0, 0]\nhigh = [0, 1, 1]\n[stop]", "[domain]", "domain",
         "low is not below high"},
        {"[stop]", "[frames]\ninterval_s = 0.001\n[stop]", "interval_s = 0.001", "frames.interval_s",
         "give 0, at least 0.01, or a shorter sensors.interval_s"},
        {"[stop]", "[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\n[stop]", "[[plane]]", "plane", "has no use"},
    };
    for (const Fault& row : rows) checkFault(row);
}

TEST_CASE("doses need a coil") {
    const Folder folder;
    const std::string coil =
        "[coil]\nturns = 3\nlength_mm = 21.0\nwire_diameter_mm = 1.6\nradius_mm = 5.9\nspeed_rpm = 120.0\n";
    const auto faults = faultsOf(folder.write("case.toml", replaced(kGoodCase, coil, "")));
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].key == "dose.rotate_s");
    CHECK_THAT(faults[0].text(), Catch::Contains("no coil to turn"));

    // A tray that shakes while powder is dosed is enough, one that shakes while it rests is not.
    const auto shaken = [](const std::string& during) {
        return "[[body]]\nname = \"tray\"\nshape = \"ball\"\nradius_mm = 1\nat = [0, 0.02, 0.01]\n[body.motion]\n"
               "kind = \"shake\"\namplitude_mm = 0.1\nfrequency_hz = 40\nduring = \"" +
               during + "\"\n";
    };
    CHECK(faultsOf(folder.write("tray.toml", replaced(kGoodCase, coil, shaken("rotate")))).empty());
    CHECK(faultsOf(folder.write("idle.toml", replaced(kGoodCase, coil, shaken("rest")))).size() == 1);
}

TEST_CASE("particles outside a given domain are told, a few and a count") {
    const Folder folder;
    const auto faults =
        faultsOf(folder.write("case.toml", kGoodCase + "[domain]\nlow = [-1, -1, -1]\nhigh = [1, 1, 0.002]\n"));
    REQUIRE(faults.size() == 6);
    CHECK_THAT(faults[0].text(), Catch::Contains("outside the domain"));
    CHECK_THAT(faults[5].text(), Catch::Contains("more particles like this"));
}

TEST_CASE("overdamping is an unstable time step") {
    const Folder folder;
    const auto faults = faultsOf(folder.write("case.toml", kGoodCase),
                                 {"contact.damping=2", "contact.damping_r_ratio=0", "time.step_s=1e-5"});
    REQUIRE(faults.size() == 1);
    CHECK_THAT(faults[0].text(), Catch::Contains("--set time.step_s = 1e-5") && Catch::Contains("damping"));
    // The step that "auto" takes for the same damping is accepted.
    CHECK_NOTHROW(loadCase(folder.write("case.toml", kGoodCase), {"contact.damping=2"}));
}

TEST_CASE("the coil may be touched by four turns at most") {
    const Folder folder;
    const std::string text =
        replaced(replaced(kGoodCase, "wire_diameter_mm = 1.6", "wire_diameter_mm = 0.4"), "turns = 3", "turns = 40");
    const auto faults = faultsOf(folder.write("case.toml", text));
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].key == "coil.turns");
    CHECK_THAT(faults[0].text(), Catch::Contains("could touch"));
}

TEST_CASE("every fault is told at once, in the order of the file") {
    const Folder folder;
    std::string text = replaced(kGoodCase, "seed = 3", "seed = -3");
    text = replaced(text, "friction = 0.5", "friction = -1");
    text = replaced(text, "rest_s = 0.1", "rest = 0.1");
    const auto faults = faultsOf(folder.write("case.toml", text));
    REQUIRE(faults.size() == 3);
    CHECK(faults[0].key == "seed");
    CHECK(faults[1].key == "contact.friction");
    CHECK(faults[2].key == "dose.rest");
}

TEST_CASE("syntax, duplicates, missing files, circles") {
    const Folder folder;
    const auto only = [](const std::vector<Diagnostic>& faults) {
        REQUIRE(faults.size() == 1);
        return faults[0].text();
    };
    const auto twice = folder.write("twice.toml", "seed = 1\nseed = 2\n");
    CHECK_THAT(only(faultsOf(twice)), Catch::StartsWith(twice.string() + ":2: not TOML"));
    const auto tables = folder.write("tables.toml", "[coil]\n[stop]\n[coil]\n");
    CHECK_THAT(only(faultsOf(tables)), Catch::StartsWith(tables.string() + ":3: not TOML"));
    CHECK_THAT(only(faultsOf(folder.path() / "none.toml")), Catch::Contains("none.toml: there is no such file"));
    CHECK_THAT(only(faultsOf(folder.path())), Catch::Contains("cannot be read"));
    const auto lost = folder.write("lost.toml", "seed = 1\nbase = \"gone.toml\"\n");
    CHECK_THAT(only(faultsOf(lost)), Catch::StartsWith(lost.string() + ":2: base = \"gone.toml\": there is no file"));
    folder.write("a.toml", "base = \"b.toml\"\n");
    const auto circle = folder.write("b.toml", "base = \"a.toml\"\n");
    CHECK_THAT(only(faultsOf(circle)), Catch::Contains("leads back"));
    CHECK(faultsOf(folder.write("empty.toml", "")).size() >= 3);
}

TEST_CASE("lists of particles that overlap, leave or pass the outlet") {
    const Folder folder;
    const auto file = folder.write("case.toml", kFreeCase);
    const auto with = [&](const std::string& rows, const std::string& fragment) {
        INFO(rows);
        folder.write("two.csv", "x,y,z,r\n" + rows);
        const auto faults = faultsOf(file);
        REQUIRE(faults.size() == 1);
        CHECK(faults[0].key == "particles.list");
        CHECK(faults[0].line == 5);
        CHECK_THAT(faults[0].text(), Catch::Contains(fragment));
    };
    folder.write("two.csv", "x,y,z,r\n0,0,0,1e-3\n0,1.81e-3,0,1e-3\n");
    CHECK(faultsOf(file).empty());
    with("0,0,0,1e-3\n0,1.79e-3,0,1e-3\n", "particle 0 at (0, 0, 0) mm overlaps particle 1 by 0.21");
    with("5e-3,0,0,1e-3\n0,0,0,0.1e-3\n4.05e-3,0,0,0.1e-3\n", "particle 0");
}

TEST_CASE("listed particles against walls") {
    const Folder folder;
    const auto file = folder.write("case.toml", replaced(kFreeCase, "boundaries = \"none\"", "boundaries = \"list\"") +
                                                    "[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 2, 0]\n");
    folder.write("two.csv", "x,y,z,r\n0,0.9e-3,0,1e-3\n");
    CHECK(faultsOf(file).empty());
    folder.write("two.csv", "x,y,z,r\n0,0.7e-3,0,1e-3\n");
    const auto faults = faultsOf(file);
    REQUIRE(faults.size() == 1);
    CHECK_THAT(faults[0].text(), Catch::Contains("overlaps a wall by 0.3 of its radius"));
}

TEST_CASE("boundaries that are not there or have no direction") {
    const Folder folder;
    folder.write("two.csv", "x,y,z,r\n0,0.9e-3,0,1e-3\n");
    const std::string list = replaced(kFreeCase, "boundaries = \"none\"", "boundaries = \"list\"");
    CHECK_THAT(faultsOf(folder.write("a.toml", list)).at(0).text(), Catch::Contains("the list is empty"));
    const auto flat = faultsOf(folder.write("b.toml", list + "[[plane]]\npoint = [0,0,0]\nnormal = [0,0,0]\n"));
    REQUIRE(flat.size() == 1);
    CHECK(flat[0].key == "plane[0].normal");
    CHECK(flat[0].line == lineOf(list + "[[plane]]\npoint = [0,0,0]\nnormal = [0,0,0]\n", "normal ="));
    const auto unknown = faultsOf(
        folder.write("c.toml", list + "[[cylinder]]\nbase = [0,0,0]\naxis = [0,0,1]\nradius_mm = 9\nlenght_mm = 3\n"));
    REQUIRE(unknown.size() == 1);
    CHECK_THAT(unknown[0].text(), Catch::Contains("cylinder[0].lenght_mm = 3: unknown key; did you mean length_mm?"));
}

TEST_CASE("surfaces that coincide where a sphere can be are refused by name, at their line") {
    const Folder folder;
    folder.write("two.csv", "x,y,z,r\n0,1e-3,0,1e-3\n");
    const std::string list = replaced(kFreeCase, "boundaries = \"none\"", "boundaries = \"list\"") +
                             "[[plane]]\npoint = [0,0,0]\nnormal = [0,1,0]\n";
    const std::string again = "[[plane]]\npoint = [0.01,1e-6,0]\nnormal = [0,1,0]\n";
    const auto twice = faultsOf(folder.write("a.toml", list + again));
    REQUIRE(twice.size() == 1);
    CHECK(twice[0].key == "plane[1].point");
    CHECK(twice[0].line == lineOf(list + again, "point = [0.01"));
    CHECK_THAT(twice[0].text(), Catch::Contains("coincides with plane[0].point") && Catch::Contains("remove one"));
    // A pipe that lies on the floor.
    const auto pipe =
        faultsOf(folder.write("b.toml", list + "[[cylinder]]\nbase = [0,0.004,0]\naxis = [0,0,1]\nradius_mm = 4\n"));
    REQUIRE(pipe.size() == 1);
    CHECK(pipe[0].key == "cylinder[0].base");
    CHECK(faultsOf(folder.write("c.toml", list + "[[plane]]\npoint = [-0.02,0,0]\nnormal = [1,0,0]\n")).empty());
}

TEST_CASE("overrides: their faults name them") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);
    const auto text = [&](const std::vector<std::string>& overrides) {
        return CaseError(faultsOf(file, overrides)).what() + std::string();
    };
    CHECK_THAT(text({"contact.friction=-1"}), Catch::StartsWith("--set contact.friction = -1: is negative"));
    CHECK_THAT(text({"contact.frction=1"}),
               Catch::StartsWith("--set contact.frction = 1: unknown key; did you mean friction?"));
    CHECK_THAT(text({"contact.friction"}), Catch::StartsWith("--set contact.friction: has no value"));
    CHECK_THAT(text({"contact..friction=1"}), Catch::Contains("is not the path of a key"));
    CHECK_THAT(text({"contact.friction=1.2.3"}), Catch::Contains("contact.friction = 1.2.3: is not a value"));
    CHECK_THAT(text({"name=a\x01z"}), Catch::Contains("not TOML") && Catch::Contains("control characters"));
    CHECK_THAT(text({"=1"}), Catch::Contains("is not the path of a key"));
    CHECK_THAT(text({"coil.hand=rigth"}), Catch::Contains("did you mean \"right\"?"));
    CHECK_THAT(text({"coil.turns=3", "coil.pitch_mm=7"}), Catch::Contains("turns is given too"));
    CHECK_THAT(text({"coil=3"}), Catch::StartsWith("--set coil = 3: is a whole number, not a table"));
}

TEST_CASE("a coil that cannot be wound is told by what would be right") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);  // a wire of 1.6 mm in a trough and hole of 14 mm
    const auto told = [&](const std::vector<std::string>& overrides) {
        std::string text;
        for (const Diagnostic& fault : faultsOf(file, overrides)) text += fault.text() + "\n";
        CAPTURE(text);
        CHECK_THAT(text, !Catch::Contains("-6") && !Catch::Contains("at most -") && !Catch::Contains("below -"));
        return text;
    };
    // No radius is right for so thick a wire.
    CHECK_THAT(
        told({"coil.wire_diameter_mm=26"}),
        Catch::StartsWith("--set coil.wire_diameter_mm = 26: so thick a wire cannot be wound in the trough, 14 mm "
                          "wide; give less than 7\n") &&
            !Catch::Contains("coil.radius_mm"));
    CHECK_THAT(told({"coil.clearance_mm=9"}), Catch::Contains("give a clearance_mm below 5.4"));
    CHECK(faultsOf(file, {"coil.clearance_mm=5.3"}).empty());
    CHECK_THAT(told({"coil.radius_mm=0.7"}), Catch::Contains("give a radius_mm above 0.8"));
    CHECK_THAT(told({"coil.radius_mm=6.3"}), Catch::Contains("give a radius_mm of at most 6.2"));
}
