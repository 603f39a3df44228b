// Each slip has its warning, with figures and a cure; what is shipped has none that its author has not accepted.
#include "host/advice/advice.h"

#include <algorithm>
#include <set>

#include "host/model/key.h"
#include "tests/model/case_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using test::shippedCase;

namespace {

std::vector<Warning> warningsWith(const std::vector<std::string>& overrides,
                                  const std::string& file = "quickstart.toml") {
    const Case c = loadCase(shippedCase(file), overrides);
    return warningsOf(c, insertParticles(c));
}

std::vector<std::string> namesOf(const std::vector<Warning>& warnings) {
    std::vector<std::string> names;
    for (const Warning& w : warnings) names.push_back(w.name);
    return names;
}

/// The names in `accepted_warnings` of a case.
std::vector<std::string> acceptedBy(const Case& c) {
    return wordsOf(readTreeText(c.resolved, "case.toml").child("accepted_warnings")->string);
}

struct Slip {
    std::vector<std::string> overrides;
    std::string name;
    std::vector<std::string> says;  ///< words of the warning's line
    bool alone = true;              ///< no other warning follows from the slip
};

/// Slips in the quickstart case, which has no warnings.
const std::vector<Slip> kSlips{
    {{"particles.density=1.5", "particles.mass_g=0.013"}, "density", {"1.5 g/cm3 is 1500"}, false},
    {{"particles.density=2500"}, "bulk-density", {"bulk_density = 471", "2500", "about 1.15e+03"}},
    {{"bulk_density=200"}, "bulk-density", {"is 0.14 of", "656"}},
    {{"gravity=[0, 9.81, 0]"}, "gravity", {"upwards"}},
    {{"gravity=[0, 0, -9.81]"}, "gravity", {"the coil's axis"}},
    {{"gravity=[0, -9810, 0]"}, "gravity", {"1e+03 times the earth's", "m/s2"}, false},
    {{"gravity=[0, -0.00981, 0]"}, "gravity", {"hardly moves"}, false},
    {{"particles.mass_g=1.5"}, "few-spheres", {"55 spheres"}, false},
    {{"particles.size.radius_min_mm=0.3"}, "size-ratio", {"7.31 times"}, false},
    {{"contact.friction=30"}, "friction", {"contact.friction = 30", "30 degrees are 0.577"}},
    {{"contact.wall.friction=22"}, "friction", {"contact.wall.friction = 22", "0.404"}},
    {{"contact.rolling_friction=25"}, "friction", {"contact.rolling_friction = 25"}},
    {{"contact.damping=0.9"}, "overdamped", {"contact.damping = 0.9", "restitution of 0.9"}},
    {{"contact.damping=0.45"}, "restitution", {"contact.damping = 0.45", "of the smallest 0", "restitution of 0.45"}},
    {{"contact.damping=0", "contact.k1_over_k=1"}, "restitution", {"a restitution of 1", "restitution of 0.5"}},
    {{"contact.k=10", "contact.damping=0.003"}, "overlap-weight", {"contact.k = 10", "give at least"}, false},
    {{"contact.k=100", "contact.damping=0.01"}, "overlap-fall", {"contact.k = 100", "m/s"}},
    {{"coil.pitch_mm=5"}, "coil-gap", {"coil.pitch_mm = 5", "2.99 mm", "0.68 of the largest"}},
    {{"coil.turns=10"}, "coil-gap", {"coil.turns = 10"}},
    {{"contact.max_overlap_ratio=0.2"}, "pinch", {"0.1 mm", "every sphere"}},
    {{"coil.length_mm=30", "coil.pitch_mm=12.5"}, "coil-end", {"ends 10 mm before the front wall", "40", "50"}},
    {{"coil.z_start_mm=20", "coil.length_mm=30"}, "coil-start", {"begins 20 mm", "stays there"}},
    {{"coil.z_start_mm=60", "coil.length_mm=30"}, "coil-start", {"beyond the front wall"}},
    {{"coil.z_start_mm=-10"}, "coil-rear", {"10 mm behind the rear wall"}},
    {{"coil.speed_rpm=0"}, "coil-rest", {"does not turn"}},
    {{"coil.speed_rpm=400"}, "coil-speed", {"1.9 times gravity", "293 rpm"}},
    {{"canister.outlet_diameter_mm=10", "coil.radius_mm=3.5", "dose.rotate_s=6"}, "outlet", {"2.3 of the largest"}},
    {{"particles.mass_g=3"}, "fill-low", {"particles.mass_g = 3", "below the coil's axis"}},
    {{"domain.low=[-0.02, -0.005, -0.01]", "domain.high=[0.02, 0.2, 0.06]"}, "domain", {"is lost"}},
    {{"region=[{name = \"moon\", kind = \"beyond\", deletes = false, point = [0, 100, 0], normal = [0, 1, 0]}]"},
     "region",
     {"region.moon: no sphere can reach it", "widen [domain]"}},
    {{"settle.time_s=0.05"}, "settle-time", {"settle.time_s = 0.05", "43.8 mm", "0.094 s", "at least 0.24"}},
    {{"dose.rotate_s=1e9"}, "dose-length", {"more than the fill of 13 g"}, false},
    {{"dose.rotate_s=0.1"}, "dose-spheres", {"spheres, so that one sphere is"}},
    {{"stop.threshold_g=5"}, "stop-threshold", {"stop.threshold_g = 5", "7.2 g"}},
    {{"frames.interval_s=10"}, "frames", {"2.4 s"}},
    {{"sensors.interval_s=0.5"}, "sensors", {"a rotation of 0.8 s"}},
    {{"time.step_s=1e-7"}, "time-step", {"times as long", "\"auto\""}},
    {{"dose.rotate_s=1e9"}, "run-length", {"dose.rotate_s = 1000000000", "days"}, false},
    {{"accepted_warnings=pinsh"}, "accepted", {"there is no warning pinsh", "did you mean pinch?"}},
};

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
    std::set<std::string> shown{"no-outlet"}, all;  // that one takes a case without a canister
    for (const Slip& slip : kSlips) shown.insert(slip.name);
    for (const std::string& name : warningNames()) all.insert(name);
    CHECK(all.size() == warningNames().size());
    CHECK(shown == all);
}

TEST_CASE("a shipped case has no warning but those it accepts, and accepts none that it has not") {
    int cases = 0;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(VKDOSE_SOURCE_DIR) / "cases")) {
        if (entry.path().extension() != ".toml") continue;
        ++cases;
        const Case c = loadCase(entry.path());
        const std::vector<Warning> warnings = warningsOf(c, insertParticles(c));
        CAPTURE(entry.path().string());
        for (const Warning& w : warnings) {
            CAPTURE(w.line());
            CHECK(w.accepted);
        }
        CHECK(warnings.size() == acceptedBy(c).size());
    }
    CHECK(cases > 10);
}

TEST_CASE("doses without a canister take a region that deletes") {
    const test::Folder folder;
    const auto warned = [&](const std::string& region) {
        folder.write("case.toml", R"(boundaries = "none"
[particles]
density = 1427.0
mass_g = 0.1
[particles.size]
distribution = "fixed"
radius_mm = 1.25
[particles.region]
low = [-0.008, -0.01, 0.001]
high = [0.008, 0.008, 0.009]
[contact]
k = 8000.0
k1_over_k = 0.2
kc_over_k = 0.0
plasticity_depth = 0.05
damping = 0.03
friction = 0.5
[[body]]
name = "drum"
shape = "cylinder"
radius_mm = 15
length_mm = 10
[body.motion]
kind = "turn"
follows = "drive"
[settle]
time_s = 0.06
[dose]
rotate_s = 0.05
speed_rpm = 30
)" + region);
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
        const std::string base = "base = \"" + shippedCase("quickstart.toml").string() + "\"\n";
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
