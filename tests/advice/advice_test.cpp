// Each slip has its warning, with figures and a cure; what is shipped has none that its author has not accepted.
#include "host/advice/advice.h"

#include <algorithm>
#include <set>

#include "host/core/key.h"
#include "tests/advice/slips.h"
#include "tests/advice/warnings.h"
#include "tests/support/catch.h"
#include "tests/support/drum_case.h"

using namespace vkdose;
using test::kBodySlips;
using test::kSlips;
using test::namesOf;
using test::plainCase;
using test::Slip;

namespace {

std::vector<Warning> warningsWith(const std::vector<std::string>& overrides,
                                  const std::filesystem::path& file = plainCase()) {
    const Case c = loadCase(file, overrides);
    return warningsOf(c, insertParticles(c));
}

/// The names in `accepted_warnings` of a case.
std::vector<std::string> acceptedBy(const Case& c) {
    return wordsOf(readTreeText(c.resolved, "case.toml").child("accepted_warnings")->string);
}

}  // namespace

TEST_CASE("each slip has its warning with figures and a cure") {
    for (const Slip& slip : kSlips) {
        CAPTURE(slip.overrides);
        const std::vector<Warning> found = warningsWith(slip.overrides);
        const std::vector<std::string> names = namesOf(found);
        CAPTURE(names);
        const auto it = std::find_if(found.begin(), found.end(), [&](const Warning& w) { return w.name == slip.name; });
        CHECK(it != found.end());
        if (it == found.end()) continue;
        for (const std::string& words : slip.says) CHECK_THAT(it->line(), Catch::Contains(words));
        CHECK_FALSE(it->cure.empty());
        CHECK_FALSE(it->accepted);
        if (slip.alone) CHECK(names.size() == 1);
    }
}

TEST_CASE("every rule is shown by a slip") {
    std::set<std::string> shown{"no-outlet", "no-floor"}, all;  // those take a case without a canister
    for (const Slip& slip : kSlips) shown.insert(slip.name);
    for (const test::BodySlip& slip : kBodySlips) shown.insert(slip.name);
    shown.insert("body-inside");  // below
    shown.insert("body-phases");
    shown.insert("body-seam");
    shown.insert("body-mended");
    shown.insert("law-rounding");
    for (const std::string& name : warningNames()) all.insert(name);
    CHECK(all.size() == warningNames().size());
    CHECK(shown == all);
}

TEST_CASE("a shipped case has no warning but those it accepts, and accepts none that it has not") {
    int cases = 0;
    for (const std::filesystem::path& file : test::shippedCases()) {
        ++cases;
        const Case c = loadCase(file);
        const std::vector<Warning> warnings = warningsOf(c, insertParticles(c));
        CAPTURE(file.string());
        for (const Warning& w : warnings) {
            CAPTURE(w.line());
            CHECK(w.accepted);
        }
        CHECK(warnings.size() == acceptedBy(c).size());
    }
    CHECK(cases > 15);
}

TEST_CASE("doses without a canister take a region that deletes") {
    const test::Folder folder;
    const auto warned = [&](const std::string& region) {
        folder.write("case.toml", test::kDrum + region);
        const Case c = loadCase(folder.path() / "case.toml");
        const std::vector<std::string> names = namesOf(warningsOf(c, insertParticles(c)));
        return std::count(names.begin(), names.end(), "no-outlet") == 1;
    };
    const std::string region =
        "[[region]]\nname = \"front\"\nkind = \"beyond\"\npoint = [0, 0, 0.011]\nnormal = [0, 0, 1]\n";
    CHECK(warned(""));
    CHECK(warned(region + "deletes = false\n"));
    CHECK_FALSE(warned(region));
}

TEST_CASE("powder under which nothing stands is told, and where") {
    const test::Folder folder;
    const auto warned = [&](const std::string& more) {
        folder.write(
            "case.toml",
            "boundaries = \"none\"\nreason = \"r\"\n[particles]\ndensity = 1500\nmass_g = 3\ninside = \"tube\"\n"
            "[particles.size]\ndistribution = \"fixed\"\nradius_mm = 1\n[contact]\nlaw = \"hertz-mindlin\"\n"
            "youngs_modulus = 5e6\npoisson_ratio = 0.3\nrestitution = 0.6\nfriction = 0.4\n[settle]\n"
            "time_s = 0.1\n[[body]]\nname = \"tube\"\nshape = \"cylinder\"\nradius_mm = 15\nlength_mm = 60\n"
            "rotation_axis = [1, 0, 0]\nrotation_deg = -90\n" +
                more);
        const Case c = loadCase(folder.path() / "case.toml");
        const std::vector<Warning> found = warningsOf(c, insertParticles(c));
        const auto it = std::find_if(found.begin(), found.end(), [](const Warning& w) { return w.name == "no-floor"; });
        return it == found.end() ? std::string() : it->line();
    };
    CHECK_THAT(warned(""), Catch::Contains("nothing stands under the powder at (") && Catch::Contains("[[region]]"));
    CHECK(warned("[[body]]\nname = \"floor\"\nshape = \"plane\"\n").empty());
    CHECK(
        warned("[[region]]\nname = \"pan\"\nkind = \"beyond\"\npoint = [0, -0.01, 0]\nnormal = [0, -1, 0]\n").empty());
    // A floor under half of it.
    CHECK_FALSE(
        warned("[[body]]\nname = \"half\"\nshape = \"box\"\nsize_mm = [20, 2, 40]\nat = [0.01, -0.001, 0]\n").empty());
    // What falls out comes in again.
    CHECK(warned("[particles.region]\nlow = [-0.02, 0.011, -0.02]\nhigh = [0.02, 0.049, 0.02]\n[domain]\n"
                 "low = [-0.02, 0.01, -0.02]\nhigh = [0.02, 0.05, 0.02]\nperiodic = \"y\"\n")
              .empty());
}

TEST_CASE("an accepted warning stays, marked as such") {
    const auto pinch = [](const std::string& accepted) {
        return warningsWith({"contact.max_overlap_ratio=0.2", "accepted_warnings=" + accepted});
    };
    const std::vector<Warning> found = pinch("\"settle-time pinch\"");
    REQUIRE(found.size() == 1);
    CHECK(found[0].accepted);
    CHECK_FALSE(pinch("\"settle-time\"")[0].accepted);
}

TEST_CASE("a list of touching spheres is a bed, which need not fall") {
    const test::Folder folder;
    const auto warned = [&](double pitch) {  // of a lattice above the coil, of spheres of radius 2 mm
        std::string list = "x,y,z,r\n";
        for (int i = 0; i < 128; ++i) {
            const int x = i % 4, z = i / 4 % 8, y = i / 32;
            list += std::to_string((x - 1.5) * pitch) + "," + std::to_string(0.014 + y * pitch) + "," +
                    std::to_string(0.003 + z * pitch) + ",0.002\n";
        }
        folder.write("list.csv", list);
        const std::string base = "base = \"" + plainCase().string() + "\"\n";
        folder.write("case.toml", base + "[particles]\nlist = \"list.csv\"\n[settle]\ntime_s = 0.01\n");
        const Case c = loadCase(folder.path() / "case.toml");
        const std::vector<std::string> names = namesOf(warningsOf(c, insertParticles(c)));
        return std::count(names.begin(), names.end(), "settle-time") == 1;
    };
    CHECK(warned(0.00401));
    CHECK_FALSE(warned(0.00399));
}

TEST_CASE("the manual has a row for every warning") {
    const std::string page = test::readText(std::filesystem::path(VKDOSE_SOURCE_DIR) / "host/app/README.md");
    for (const std::string& name : warningNames()) CHECK_THAT(page, Catch::Contains("`" + name + "`"));
}

TEST_CASE("a law of which single precision takes digits is told, with both answers") {
    Case c = loadCase(plainCase());
    UserLaw law;
    law.name = "steep.glsl";
    c.dosingLaw.user = std::make_shared<const UserLaw>(law);
    c.lawRounding = {"force", "particle-wall", 1e-6, 0.0125, 0.0123, 0.016};
    const auto told = [&] {
        std::string line;
        for (const Warning& w : warningsOf(c, insertParticles(c)))
            if (w.name == "law-rounding") line = w.line();
        return line;
    };
    CHECK_THAT(told(), Catch::Contains("force of steep.glsl answers 0.0125 in single precision and 0.0123 exactly") &&
                           Catch::Contains("particle-wall"));
    c.lawRounding->share = 1e-4;
    CHECK(told().empty());
}
