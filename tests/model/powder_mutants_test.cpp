// Broken values of the keys that stand in place of others: each must be refused with a message that names the key and
// its line, and nothing may hang or come out as something that is not finite.
#include <cmath>
#include <limits>

#include "tests/model/case_files.h"
#include "tests/model/mutants.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// kGoodCase with every such key of the contacts.
const std::string kTargets = [] {
    std::string text = replaced(kGoodCase, "k = 2000.0\n", "overlap_under_bed = 0.004\n");
    text = replaced(text, "kc_over_k = 0.5\n", "bond_number = 30.0\nbond_load = \"limit\"\n");
    text = replaced(text, "damping = 0.02\n", "restitution = 0.6\nrestitution_speed = 0.05\n");
    return replaced(text, "[contact.wall]\n", "[contact.wall]\ncontact_duration_s = 2e-4\n");
}();

std::size_t lineOf(const std::vector<std::string>& lines, const std::string& key) {
    for (std::size_t i = 0; i < lines.size(); ++i)
        if (lines[i].rfind(key + " =", 0) == 0) return i;
    throw std::logic_error("no line " + key);
}

/// Each must be refused, blaming the key in its line.
void refused(const std::string& base, const std::string& key, const std::vector<std::string>& values) {
    const std::vector<std::string> lines = linesOf(base);
    const std::size_t at = lineOf(lines, key);
    const Folder folder;
    for (const std::string& value : values) {
        CAPTURE(key, value);
        const auto file = folder.write("case.toml", withLine(lines, at, key + " = " + value));
        try {
            loadCase(file);
            FAIL_CHECK("was accepted");
        } catch (const CaseError& error) {
            CAPTURE(error.what());
            bool blamed = false;
            for (const Diagnostic& fault : error.faults()) {
                CHECK(unclear(fault) == "");
                blamed = blamed || (fault.key.ends_with(key) && fault.line == static_cast<int>(at) + 1);
            }
            CHECK(blamed);
        }
    }
}

const std::vector<std::string> kNoNumber{"\"0.5\"", "true",  "[0.5]", "nan",       "inf",
                                         "-inf",    "1e300", "-0.5",  "1979-05-27"};

}  // namespace

TEST_CASE("broken targets of a contact are refused by name") {
    const Folder folder;
    REQUIRE_NOTHROW(loadCase(folder.write("case.toml", kTargets)));
    for (const char* key :
         {"overlap_under_bed", "bond_number", "restitution", "restitution_speed", "contact_duration_s"})
        refused(kTargets, key, kNoNumber);
    refused(kTargets, "overlap_under_bed", {"0", "0.0", "5e-324"});
    refused(kTargets, "contact_duration_s", {"0", "5e-324"});
    refused(kTargets, "restitution", {"0", "1.0001", "45", "0.999"});  // the last at 0.05 m/s
    refused(kTargets, "restitution_speed", {"100", "1e14"});
    refused(kTargets, "bond_number", {"1e5", "1e15"});
    refused(kTargets, "bond_load", {"\"weight\"", "7", "true", "\"\""});
}

TEST_CASE("what stands in place of a key is refused beside it, in every table of the contacts") {
    const Folder folder;
    const std::vector<std::pair<const char*, const char*>> rivals{{"k", "overlap_under_bed"},
                                                                  {"k", "contact_duration_s"},
                                                                  {"contact_duration_s", "overlap_under_bed"},
                                                                  {"kc_over_k", "bond_number"},
                                                                  {"damping", "restitution"}};
    for (const char* table : {"contact", "contact.wall", "contact.coil"}) {
        for (const auto& [one, other] : rivals) {
            CAPTURE(table, one, other);
            const std::vector<std::string> both{std::string(table) + "." + one + "=0.01",
                                                std::string(table) + "." + other + "=0.01"};
            CHECK_THROWS_WITH(loadCase(folder.write("case.toml", kGoodCase), both),
                              Catch::Contains("not both") && Catch::Contains(other) && Catch::Contains(one));
        }
    }
    for (const char* alone : {"contact.restitution_speed=0.1", "contact.wall.bond_load=bed"})
        CHECK_THROWS_WITH(loadCase(folder.write("case.toml", kGoodCase), {alone}), Catch::Contains("there is none"));
}

TEST_CASE("extreme targets load with finite parameters or are refused clearly") {
    const Folder folder;
    const auto file = folder.write("case.toml", kTargets);
    int loaded = 0;
    for (const char* key : {"overlap_under_bed", "bond_number", "restitution", "restitution_speed", "k1_over_k",
                            "plasticity_depth", "wall.contact_duration_s"}) {
        for (const char* value : {"1e-12", "1e-6", "1e-3", "0.1", "1", "100"}) {
            CAPTURE(key, value);
            try {
                const Case c = loadCase(file, {"contact." + std::string(key) + "=" + value});
                ++loaded;
                for (const ContactParameters& p : classesOf(c.dosingLaw))
                    CHECK((std::isfinite(p.k1 + p.k2Max + p.kc + p.gamma) && p.k1 > 0 && p.gamma >= 0));
                CHECK(loadResolvedCase(c.resolved, file).resolved == c.resolved);
            } catch (const CaseError& error) {
                for (const Diagnostic& fault : error.faults()) CHECK(unclear(fault) == "");
            }
        }
    }
    CHECK(loaded > 10);
}
