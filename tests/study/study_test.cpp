// Study files: what they say, and every way they can be wrong.
#include "host/study/study.h"

#include <algorithm>

#include "host/model/case.h"
#include "tests/study/study_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

int lineOf(const std::string& text, const std::string& what) {
    const std::size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    return 1 + int(std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n'));
}

/// The case of a member as it would run.
Case caseOf(const Member& m) {
    return loadResolvedCase(m.caseText, "member.toml");
}

/// A study with a single axis.
std::string withAxis(const std::string& axis) {
    return "base = \"good.toml\"\n[[axis]]\n" + axis;
}

}  // namespace

TEST_CASE("a study is every combination of its axes for every seed, seeds slowest, the last axis fastest") {
    const StudyFolder folder;
    const Study study = folder.study();
    CHECK(study.name == "cohesion and friction");
    CHECK(study.keys() == std::vector<std::string>{"contact.kc_over_k", "coil.turns", "coil.speed_rpm"});
    const std::vector<Member> members = folder.members();
    REQUIRE(members.size() == 12);
    const std::vector<std::vector<std::string>> points{{"0.2", "3", "120"},  {"0.2", "2", "60"},
                                                       {"0.2", "4", "60.5"}, {"0.50", "3", "120"},
                                                       {"0.50", "2", "60"},  {"0.50", "4", "60.5"}};
    for (int i = 0; i < 12; ++i) {
        CAPTURE(i);
        CHECK(members[i].number == i);
        CHECK(members[i].seed == (i < 6 ? 4 : 9));
        CHECK(members[i].values == points[i % 6]);
    }
    const Case c = caseOf(members[10]);
    CHECK(c.seed == 9);
    CHECK(c.dosingLaw.of(ContactClass::ParticleParticle).kc == 0.5 * 2000.0);
    CHECK(c.schedule.stop.maxDoses == 2);
    CHECK(c.schedule.rotateTime == 0.2);
    CHECK(c.schedule.coilSpeed == Approx(2 * kPi).epsilon(1e-12));  // 60 a minute, to rounding
    REQUIRE(c.world.coil);
    CHECK(c.world.coil->pitch == Approx(0.021 / 2).epsilon(1e-12));  // 2 turns on 21 mm, to rounding
}

TEST_CASE("without axes and seeds a study is the base case") {
    const StudyFolder folder;
    const std::vector<Member> members = folder.members("base = \"good.toml\"\n");
    REQUIRE(members.size() == 1);
    CHECK(members[0].seed == 3);
    CHECK(members[0].values.empty());
    CHECK(members[0].caseText == loadCase(folder.path() / "good.toml").resolved);
    CHECK(folder.study("base = \"good.toml\"\n").name == "study");
    CHECK(folder.members("base = \"good.toml\"\nseeds = 3\n").back().seed == 3);
}

TEST_CASE("a range has its ends, round numbers between, and whole numbers for keys that want them") {
    const StudyFolder folder;
    const auto valuesOf = [&](const std::string& axis) {
        std::vector<std::string> values;
        for (const Member& m : folder.members(withAxis(axis))) values.push_back(m.values.at(0));
        return values;
    };
    CHECK(valuesOf("key = \"contact.friction\"\nfrom = 0.1\nto = 0.5\nsteps = 5\n") ==
          std::vector<std::string>{"0.1", "0.2", "0.3", "0.4", "0.5"});
    CHECK(valuesOf("key = \"stop.doses\"\nfrom = 1\nto = 7\nsteps = 3\n") == std::vector<std::string>{"1", "4", "7"});
    CHECK(valuesOf("key = \"coil.speed_rpm\"\nfrom = 60\nto = 45\nsteps = 3\n") ==
          std::vector<std::string>{"60", "52.5", "45"});
}

TEST_CASE("an axis may carry words, and keys that replace others of the base") {
    const StudyFolder folder;
    const auto floors = folder.members(withAxis("key = \"canister.floor\"\nvalues = [\"trough\", \"flat\"]\n"));
    REQUIRE(floors.size() == 2);
    CHECK(floors[1].values == std::vector<std::string>{"flat"});
    CHECK(caseOf(floors[1]).canister->flatFloor);
    const auto pitches = folder.members(withAxis("key = \"coil.pitch_mm\"\nvalues = [7, 10.5]\n"));
    REQUIRE(pitches.size() == 2);
    CHECK(caseOf(pitches[1]).world.coil->pitch == Approx(0.0105).epsilon(1e-12));  // to rounding
    const auto sizes =
        folder.members(withAxis("key = \"particles.size\"\nvalues = [{distribution = \"fixed\", radius_mm = 1.0}, "
                                "{distribution = \"fixed\", radius_mm = 1.2}]\n"));
    REQUIRE(sizes.size() == 2);
    CHECK(sizes[0].particles > sizes[1].particles);
}

TEST_CASE("an axis varies mass and sizes of a powder, a material and a pair by their names") {
    const StudyFolder folder;
    folder.write("good.toml", kGoodCase + kSugar);
    const auto masses =
        folder.members(withAxis("key = \"powder.sugar.mass_g\"\nfrom = 0.2\nto = 0.6\nsteps = 3\n[[axis]]\n"
                                "keys = [\"powder.sugar.density\", \"contact.powder-sugar.friction\"]\n"
                                "values = [[1590.0, 0.3], [1700.0, 0.1]]\n"));
    REQUIRE(masses.size() == 6);
    CHECK(masses[4].values == std::vector<std::string>{"0.6", "1590.0", "0.3"});
    const Case least = caseOf(masses[0]), most = caseOf(masses[5]);
    REQUIRE(most.furtherPowders.size() == 1);
    CHECK(least.furtherPowders[0].filling.mass == Approx(0.2e-3).epsilon(1e-12));  // grams, to rounding
    CHECK(most.furtherPowders[0].filling.mass == Approx(0.6e-3).epsilon(1e-12));
    CHECK(most.filling.mass == Approx(0.9e-3).epsilon(1e-12));  // the first powder stays
    CHECK(least.world.materials[std::size_t(least.furtherPowders[0].material)].density == 1590);
    CHECK(most.world.materials[std::size_t(most.furtherPowders[0].material)].density == 1700);
    CHECK(most.dosingLaw.between(kFirstPowder, most.furtherPowders[0].material).mu == 0.1);
    CHECK(masses[5].particles > masses[0].particles);

    const auto faults = faultsOf(folder, withAxis("key = \"powder.suger.mass_g\"\nvalues = [0.2]\n"));
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].line == 4);
    CHECK(faults[0].text().find("give a key of one of these: sugar") != std::string::npos);
}

TEST_CASE("the case at a point has the key that was varied, and neither defaults nor what follows from the key") {
    const StudyFolder folder;
    const Study study = folder.study("base = \"good.toml\"\nseeds = [4]\n[set]\nstop.max_doses = 2\n");
    const std::vector<Setting> point{settingOf(study, "contact.bond_number", 7.25)};
    const std::string text = caseAt(study, point, "found", "because");
    CHECK_THAT(text, Catch::Contains("name = \"found\"\n") && Catch::Contains("reason = \"because\"\n") &&
                         Catch::Contains("seed = 4\n") && Catch::Contains("[contact]\n") &&
                         Catch::Contains("bond_number = 7.25\n") && Catch::Contains("max_doses = 2\n"));
    CHECK_THAT(text, !Catch::Contains("kc_over_k") && !Catch::Contains("bulk_density"));
    const Case found = loadResolvedCase(text, "found.toml"), member = caseOf(memberAt(study, 0, 4, point));
    CHECK(found.dosingLaw.between(0, 0).kc == member.dosingLaw.between(0, 0).kc);
    CHECK(found.schedule.stop.maxDoses == 2);
}

TEST_CASE("every case that is shipped is the same case when it is written for people") {
    const StudyFolder folder;
    for (const auto& file : test::shippedCases()) {
        CAPTURE(file);
        const Case base = loadCase(file);
        const Study study = folder.study("base = \"" + file.string() + "\"\n");
        const std::string text = caseAt(study, {}, base.name, base.reason);
        CHECK(loadResolvedCase(text, "written.toml").resolved ==
              loadCase(file, {"reason=\"" + base.reason + "\""}).resolved);
    }
}

TEST_CASE("every fault of a study names its line, its key and a remedy") {
    const StudyFolder folder;
    struct Fault {
        std::string from, to;  ///< of the good study
        std::string where;     ///< in the line that must be blamed
        std::string key;
        std::string says;
    };
    const std::vector<Fault> all{
        {"reason =", "raeson =", "raeson", "raeson", "did you mean reason?"},
        {"[[axis]]\nkey =", "[[axes]]\nkey =", "[[axes]]", "axes", "did you mean axis?"},
        {"base = \"good.toml\"\n", "", "", "base", "is missing"},
        {"good.toml", "bad.toml", "bad.toml", "base", "there is no file"},
        {"good.toml", std::string(10000, '['), "base", "base", "there is no file"},
        {"\"contact.kc_over_k\"", '"' + std::string(10000, '[') + '"', "key = \"[", "axis[0].key", "[[["},
        {"[4, 9]", "[4, 4]", "seeds", "seeds", "different whole numbers"},
        {"[4, 9]", "[4, -9]", "seeds", "seeds", "different whole numbers"},
        {"[4, 9]", "[]", "seeds", "seeds", "different whole numbers"},
        {"[4, 9]", "0", "seeds", "seeds", "not a number of seeds"},
        {"[4, 9]", "\"many\"", "seeds", "seeds", "different whole numbers"},
        {"values = [0.2", "vaules = [0.2", "vaules", "axis[0].vaules", "did you mean values?"},
        {"[0.2, 0.50]", "[]", "values = []", "axis[0].values", "is not a list of values"},
        {"[0.2, 0.50]", "0.2", "values = 0.2", "axis[0].values", "is not a list of values"},
        {"[0.2, 0.50]", "[0.2, 0.2]", "values = [0.2", "axis[0].values", "0.2 is there twice"},
        {"values = [0.2, 0.50]", "from = 0.2\nto = 0.2\nsteps = 4", "to = 0.2", "axis[0].to", "the range is empty"},
        {"values = [0.2, 0.50]", "from = 0.2\nto = 0.5\nsteps = 1", "steps = 1", "axis[0].steps", ">= 2"},
        {"values = [0.2, 0.50]", "values = [0.2]\nfrom = 0.1\nto = 0.2\nsteps = 3", "values = [0.2]", "axis[0].values",
         "given in another way too"},
        {"values = [0.2, 0.50]", "from = 0\nto = 1\nsteps = 9000", "[[axis]]", "axis", "more than 10000"},
        {"[2, 60]", "[2]", "values = [[3", "axis[1].values", "[2] is not a row of 2 values"},
        {"[2, 60]", "2", "values = [[3", "axis[1].values", "2 is not a row of 2 values"},
        {"keys =", "key = \"seed\"\nkeys =", "keys = [", "axis[1].keys", "give key or keys, not both"},
        {"\"contact.kc_over_k\"", "\"seed\"", "key = \"seed\"", "axis[0].key", "seeds = [1, 2, 3]"},
        {"\"contact.kc_over_k\"", "\"contact..k\"", "key = \"contact..k\"", "axis[0].key", "not the path of a key"},
        {"\"contact.kc_over_k\"", "\"coil.turns\"", "keys = [", "axis[1].keys", "coil.turns is given twice"},
        {"\"stop.max_doses\"", "\"coil.turns\"", "keys = [", "axis[1].keys", "coil.turns is given twice"},
        {"\"contact.kc_over_k\"", "\"contact.kc_over\"", "values = [0.2", "contact.kc_over", "did you mean kc_over_k?"},
        {"[0.2, 0.50]", "[0.2, -0.5]", "values = [0.2", "contact.kc_over_k", "is negative"},
        {"[2, 60]", "[2, true]", "values = [[3", "coil.speed_rpm", "not a number"},
        {"\"stop.max_doses\" = 2", "\"stop.max_doses\" = 0", "stop.max_doses", "stop.max_doses", "too small"},
    };
    REQUIRE(faultsOf(folder, kGoodStudy).empty());
    for (const Fault& row : all) {
        const std::string text = replaced(kGoodStudy, row.from, row.to);
        const std::vector<Diagnostic> faults = faultsOf(folder, text);
        CAPTURE(row.to, row.says);
        const auto told = std::find_if(faults.begin(), faults.end(), [&](const Diagnostic& d) {
            return d.text().find(row.says) != std::string::npos;
        });
        REQUIRE(told != faults.end());
        CAPTURE(told->text());
        CHECK(told->key == row.key);
        CHECK(told->file.find("study.toml") != std::string::npos);
        CHECK(told->text().size() < 2500);
        // At the line, or at the axis that holds it.
        if (!row.where.empty()) CHECK(told->line == lineOf(text, row.where));
    }
}

TEST_CASE("a list that is varied is checked as a single value is, and told with the line of its point") {
    const StudyFolder folder;
    struct Fault {
        std::string key, good, bad, says;
    };
    for (const Fault& row : std::vector<Fault>{
             {"domain.high", "[0.1, 0.1, 0.1]", "[0.1, 0.1]", "domain.high = [0.1, 0.1]: is not an array of three"},
             {"domain.high", "[0.1, 0.1, 0.1]", "[0.1, \"b\", 0.1]", "\"b\" is not a finite number"},
             {"domain.high", "[0.1, 0.1, 0.1]", "[0.1, nan, 0.1]", "nan is not a finite number"},
             {"domain.high", "[0.1, 0.1, 0.1]", "7", "domain.high = 7: is not an array of three"},
             {"contact.friction", "0.5", "[0.5]", "contact.friction = [0.5]: is an array, not a number"},
             {"field", "[{preset = \"outlet\"}]", "[{preset = \"outlte\"}]",
              "field[0].preset = \"outlte\": is not known"},
             {"field", "[{preset = \"outlet\"}]", "[{presett = \"outlet\"}]",
              "field[0].presett = \"outlet\": unknown key"},
             {"field", "[{preset = \"outlet\"}]", "[1]", "field = [1]: is not a list of tables"},
         }) {
        CAPTURE(row.key, row.bad);
        const auto text = [&](const std::string& second) {
            return "base = \"good.toml\"\n[set]\ndomain.low = [-0.1, -0.1, -0.1]\n" +
                   (row.key == "domain.high" ? "" : std::string("domain.high = [0.1, 0.1, 0.1]\n")) +
                   "[[axis]]\nkey = \"" + row.key + "\"\nvalues = [\n" + row.good + ",\n" + second + "]\n";
        };
        const auto faults = faultsOf(folder, text(row.bad));
        REQUIRE(faults.size() == 1);
        CHECK_THAT(faults[0].text(),
                   Catch::Contains("study.toml:" + std::to_string(lineOf(text(row.bad), row.bad + "]")) + ": " +
                                   (row.key == "domain.high" ? "domain.high" : "")) &&
                       Catch::Contains(row.says) && Catch::Contains("(member 1: " + row.key));
    }
}

TEST_CASE("a case given as a study is told so") {
    try {
        readStudy(VKDOSE_SOURCE_DIR "/cases/mini.toml");
        FAIL("was read as a study");
    } catch (const CaseError& error) {
        REQUIRE(error.faults().size() == 1);
        CHECK_THAT(error.what(), Catch::Contains("this is a case, not a study") && Catch::Contains("vkdose run"));
    }
}

TEST_CASE("a point that no key is guilty of alone is named") {
    const StudyFolder folder;
    // The wire reaches beyond the trough only where it is thick and wound wide.
    const auto faults = faultsOf(folder,
                                 "base = \"good.toml\"\n[[axis]]\nkey = \"coil.radius_mm\"\nvalues = [5.0, 6.0]\n"
                                 "[[axis]]\nkey = \"coil.wire_diameter_mm\"\nvalues = [1.6, 2.4]\n");
    REQUIRE(faults.size() == 1);
    CHECK_THAT(faults[0].text(), Catch::Contains("study.toml:4: coil.radius_mm = 6.0") &&
                                     Catch::Contains("member 3: coil.radius_mm = 6.0, coil.wire_diameter_mm = 2.4"));
}

TEST_CASE("a table and a key in it are not set by the same study") {
    const StudyFolder folder;
    const auto faults = faultsOf(folder,
                                 "base = \"good.toml\"\n[[axis]]\nkey = \"particles.size\"\n"
                                 "values = [{distribution = \"fixed\", radius_mm = 1.0}]\n"
                                 "[[axis]]\nkey = \"particles.size.radius_mm\"\nvalues = [1.0]\n");
    REQUIRE(faults.size() == 1);
    CHECK_THAT(faults[0].text(), Catch::Contains("study.toml:7: particles.size.radius_mm"));
}

TEST_CASE("every study that is shipped says why, and each of its members is a case") {
    std::vector<std::filesystem::path> files;
    for (const char* folder : {"/cases/paper", "/cases/elements/studies"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(std::string(VKDOSE_SOURCE_DIR) + folder))
            // "expected" is what the paper reports, for `vkdose report`; beside the studies lie their results.
            if (entry.path().extension() == ".toml" && entry.path().stem() != "expected") files.push_back(entry.path());
    for (const std::filesystem::path& file : files) {
        CAPTURE(file.string());
        Study study = readStudy(file);
        CHECK_FALSE(study.reason.empty());
        CHECK_THAT(study.name,
                   Catch::EndsWith(file.stem().string()));  // in a folder perhaps with more before it
        study.seeds = {1};
        // A member is run from its file, and what the run makes of it must be that file again.
        for (const Member& m : membersOf(study)) CHECK(caseOf(m).resolved == m.caseText);
    }
    CHECK(files.size() >= 14);
}
