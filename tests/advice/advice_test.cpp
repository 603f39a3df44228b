// Each slip has its warning, with figures and a cure; what is shipped has none that its author has not accepted.
#include "host/advice/advice.h"

#include <algorithm>
#include <set>

#include "geometry/mesh_writer.h"
#include "geometry/tessellate.h"
#include "host/model/key.h"
#include "tests/model/case_files.h"
#include "tests/support/catch.h"
#include "tests/support/drum_case.h"

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
    {{"canister.length_mm=40000", "coil.length_mm=50000"},
     "canister-size",
     {"canister.length_mm = 40000", "40 m large", "give 40 if it is 40 mm"},
     false},
    {{"particles.mass_g=1.5"}, "few-spheres", {"55 spheres"}, false},
    {{"particles.size.radius_min_mm=0.3"}, "size-ratio", {"7.31 times"}, false},
    {{"material=[{name = \"steel\"}]"}, "unused-material", {"nothing is made of \"steel\"", "or remove it"}},
    {{"contact.friction=30"}, "friction", {"contact.friction = 30", "30 degrees are 0.577"}},
    {{"contact.wall.friction=22"}, "friction", {"contact.wall.friction = 22", "0.404"}},
    {{"contact.rolling_friction=25"}, "friction", {"contact.rolling_friction = 25"}},
    {{"contact.damping=0.9"}, "overdamped", {"contact.damping = 0.9", "restitution of 0.9"}},
    {{"contact.damping=0.45"}, "restitution", {"contact.damping = 0.45", "of the smallest 0", "restitution of 0.45"}},
    {{"contact.damping=0", "contact.k1_over_k=1"}, "restitution", {"a restitution of 1", "restitution of 0.5"}, false},
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
    {{"contact.kc_over_k=0"}, "throat", {"Bond number at most 0", "degrees", "give a throat of"}, false},
    {{"dose.rotate_s=0.05", "coil.speed_rpm=60"}, "throat-empty", {"doses fill the throat"}, false},
    {{"dose.mass_g=3", "dose.max_rotate_s=1", "coil.speed_rpm=30"},
     "dose-time",
     {"dose.max_rotate_s = 1", "by the closed form 3 g take", "give at least"},
     false},
    {{"particles.mass_g=3"}, "fill-low", {"particles.mass_g = 3", "below the coil's axis"}},
    {{"domain.low=[-0.02, -0.005, -0.01]", "domain.high=[0.02, 0.2, 0.06]"}, "domain", {"is lost"}},
    {{"region=[{name = \"moon\", kind = \"beyond\", deletes = false, point = [0, 100, 0], normal = [0, 1, 0]}]"},
     "region",
     {"region.moon: no sphere can reach it", "widen [domain]"}},
    {{"region=[{name = \"pan\", kind = \"box\", deletes = false, low = [-1, -1, -1], high = [1, 0, -1e-5]}]"},
     "region",
     {"region.pan: no sphere can reach it", "behind the walls of the canister", "beyond its outlet"}},
    {{"settle.time_s=0.05"}, "settle-time", {"settle.time_s = 0.05", "43.8 mm", "0.094 s", "at least 0.24"}},
    {{"dose.rotate_s=1e9"}, "dose-length", {"more than the fill of 13 g"}, false},
    {{"dose.rotate_s=0.1"}, "dose-spheres", {"spheres, so that one sphere is"}, false},
    {{"stop.threshold_g=5"}, "stop-threshold", {"stop.threshold_g = 5", "7.2 g"}},
    {{"refill=[{name = \"late\", mass_g = 1, time_s = 2.5}]"},
     "refill",
     {"refill[0].time_s", "refill \"late\" never comes", "after 2.4 s"}},
    {{"refill=[{name = \"late\", mass_g = 1, before_dose = 3}]"}, "refill", {"never comes", "after 2 doses"}},
    {{"frames.interval_s=10"}, "frames", {"2.4 s"}},
    {{"sensors.interval_s=0.5"}, "sensors", {"a rotation of 0.8 s"}},
    {{"time.step_s=1e-7"}, "time-step", {"times as long", "\"auto\""}},
    {{"dose.rotate_s=1e9"}, "run-length", {"dose.rotate_s = 1000000000", "days"}, false},
    {{"accepted_warnings=pinsh"}, "accepted", {"there is no warning pinsh", "did you mean pinch?"}},
};

/// A slip in a text of the shipped device with a mesh, which has no warnings but those it accepts.
struct BodySlip {
    std::string from, to, name;
    std::vector<std::string> says;
};

std::string part(const std::string& name, const std::string& size, const std::string& at) {
    return "[[body]]\nname = \"" + name + "\"\nshape = \"box\"\nsize_mm = [" + size + "]\nat = [" + at + "]\n";
}

const std::string kOwnTurn = "[body.motion]\nkind = \"turn\"\nspeed_rpm = 60\n";

const std::vector<BodySlip> kBodySlips{
    {"turns_per_turn = -1", "turns_per_turn = 1", "body-backwards", {"to the rear wall", "by 5 mm a turn", "give -1"}},
    {"at = [0, 0, 0]", "at = [0.001, 0, 0]", "body-wall", {"\"spring\" turns through the", "0.7 mm"}},
    {"at = [0, 0, 0]", "at = [0, 0, -0.006]", "body-end", {"ends 1 mm before the front wall", "by 1 mm along z"}},
    {"unit = \"mm\"", "unit = \"um\"", "body-size", {"0.035 mm long", "\"mm\""}},
    {"[settle]",
     "[[body]]\nname = \"pin\"\nshape = \"box\"\nsize_mm = [0.8, 0.8, 0.8]\nat = [0, -0.0052, 0.015]\n[settle]",
     "body-cross",
     {"\"spring\" turns through body \"pin\""}},
    {"[settle]",
     part("pin", "1, 1, 1", "0, -20, 15") + "[settle]",
     "body-place",
     {"no sphere can touch body \"pin\"", "outside of the domain", "if those are mm, give [0, -0.02, 0.015]"}},
    // By its own clock: in the way of another that turns, of one at rest, of one that is pushed on to it; through a
    // wall.
    {"[settle]",
     part("arm", "0.6, 10.4, 0.6", "0, 0, 0.015") + kOwnTurn + "axis = [0, 0, 1]\n[settle]",
     "body-cross",
     {"\"spring\" turns through body \"arm\""}},
    {"[settle]",
     part("arm", "0.6, 8, 0.6", "0, 0, 0.015") + kOwnTurn + "axis = [0, 0, 1]\n" +
         part("pin", "0.8, 0.8, 0.8", "0.003, 0, 0.015") + "[settle]",
     "body-cross",
     {"\"arm\" turns through body \"pin\""}},
    {"[settle]",
     part("pusher", "0.6, 0.6, 0.6", "0, -0.004, 0.010") +
         "[body.motion]\nkind = \"slide\"\nvelocity = [0, 0, 0.05]\n" +
         part("pin", "0.8, 0.8, 0.8", "0, -0.004, 0.015") + "[settle]",
     "body-cross",
     {"\"pusher\" moves through body \"pin\""}},
    {"[settle]",
     part("bar", "9, 0.6, 0.6", "0, -0.003, 0.003") + kOwnTurn +
         "axis = [0, 1, 0]\nthrough = [0, -0.003, 0.003]\n[settle]",
     "body-wall",
     {"\"bar\" moves through the wall of the canister, by 1.5"}},
    {"max_overlap_ratio = 0.95",
     "max_overlap_ratio = 1",
     "body-thin",
     {"contact.max_overlap_ratio = 1", "body \"spring\"", "the other side", "0.95"}},
    // 10 m/s would do; the end of the bar goes at 200 m/s.
    {"[settle]",
     part("pusher", "0.6, 0.6, 0.6", "0, -0.004, 0.010") +
         "[body.motion]\nkind = \"slide\"\nvelocity = [0, 0, 50]\n[settle]",
     "body-speed",
     {"body \"pusher\" moves at up to 50 m/s"}},
    {"[settle]",
     part("bar", "4, 0.6, 0.6", "0, 0, 0.003") + "[body.motion]\nkind = \"turn\"\nspeed_rpm = 1e6\naxis = [0, 0, 1]\n" +
         "[settle]",
     "body-speed",
     {"body \"bar\" moves at up to"}}};

std::vector<Warning> warningsOfText(const test::Folder& folder, const std::string& text) {
    const Case c = loadCase(folder.write("case.toml", text));
    return warningsOf(c, insertParticles(c));
}

const Warning* warningOf(const std::vector<Warning>& all, const std::string& name) {
    const auto it = std::find_if(all.begin(), all.end(), [&](const Warning& w) { return w.name == name; });
    return it == all.end() ? nullptr : &*it;
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

TEST_CASE("each slip with a body has its warning with figures and a cure") {
    const test::Folder folder;
    std::filesystem::copy_file(shippedCase("devices/spring.stl"), folder.path() / "spring.stl");
    const std::string good = test::readText(shippedCase("devices/mesh-lactose.toml"));
    for (const BodySlip& slip : kBodySlips) {
        CAPTURE(slip.name);
        CHECK(warningOf(warningsOfText(folder, good), slip.name) == nullptr);
        const std::vector<Warning> found = warningsOfText(folder, test::replaced(good, slip.from, slip.to));
        const Warning* warning = warningOf(found, slip.name);
        CAPTURE(namesOf(found));
        REQUIRE(warning != nullptr);
        for (const std::string& words : slip.says) CHECK_THAT(warning->line(), Catch::Contains(words));
        CHECK_FALSE(warning->cure.empty());
    }
}

TEST_CASE("bodies that move as one, or past one another, do not cross, and the coil is a body too") {
    const test::Folder folder;
    const std::string free = test::replaced(test::kFreeCase, "time_s = 0.01", "time_s = 1");
    const auto warned = [&](const std::string& bodies) {
        folder.write("two.csv", "x,y,z,r\n0.05,0.05,0.05,1e-3\n0.06,0.05,0.05,1e-3\n");
        const std::vector<Warning> found = warningsOfText(folder, free + bodies);
        const Warning* warning = warningOf(found, "body-cross");
        return warning == nullptr ? std::string() : warning->line();
    };
    const std::string shaft = part("shaft", "2, 2, 30", "0, 0, 0") + kOwnTurn;
    const auto arm = [](const std::string& speed) {
        return part("arm", "20, 1, 1", "0.001, 0, 0.005") + "[body.motion]\nkind = \"turn\"\nspeed_rpm = " + speed +
               "\n";
    };
    CHECK(warned(shaft + arm("60")).empty());
    CHECK_THAT(warned(shaft + arm("61")), Catch::Contains("\"shaft\" turns through body \"arm\""));
    const std::string swing = part("swing", "1, 20, 1", "0, 0, 0") +
                              "[body.motion]\nkind = \"swing\"\namplitude_deg = 20\nfrequency_hz = 3\n";
    CHECK(warned(swing + part("post", "1, 1, 1", "0.005, 0.009, 0")).empty());
    CHECK_THAT(warned(swing + part("post", "1, 1, 1", "0.003, 0.009, 0")),
               Catch::Contains("\"swing\" moves through body \"post\""));
    // A lid that turns in a round cell of its own size touches no wall of it: what remains is the error of facets.
    const std::string cell = "[[body]]\nname = \"cell\"\nshape = \"cylinder\"\nradius_mm = 20\nlength_mm = 30\n";
    const std::string lid =
        "[[body]]\nname = \"lid\"\nshape = \"disc\"\nradius_mm = 20\nat = [0, 0, 0.02]\n" + kOwnTurn;
    CHECK(warned(cell + lid).empty());
    CHECK_THAT(warned(cell + test::replaced(lid, "radius_mm = 20", "radius_mm = 21")),
               Catch::Contains("\"lid\" turns through"));

    const std::string mini = test::readText(shippedCase("mini.toml"));
    const auto crosses = [&](const std::string& pin) {
        const std::vector<Warning> found = warningsOfText(folder, mini + pin);
        const Warning* warning = warningOf(found, "body-cross");
        return warning == nullptr ? std::string() : warning->line();
    };
    CHECK(crosses(part("pin", "1, 1, 1", "0, 0, 0.008")).empty());
    CHECK_THAT(crosses(part("pin", "1, 1, 1", "0, -0.0055, 0.008")),
               Catch::Contains("\"coil\" turns through body \"pin\""));
}

TEST_CASE("spheres that start inside of a closed mesh are told, unless it holds all of them") {
    const test::Folder folder;
    const geometry::Block block{Vec3(-0.01), Vec3(0.01)};
    folder.write("block.stl", geometry::stlBytes(geometry::tessellated(block, 1, Vec3(-1), Vec3(1)), "block", 1));
    const auto warned = [&](const std::string& spheres) {
        folder.write("two.csv", "x,y,z,r\n" + spheres);
        const std::vector<Warning> found = warningsOfText(
            folder, test::kFreeCase + "[[body]]\nname = \"block\"\nmesh = \"block.stl\"\nunit = \"m\"\n");
        const Warning* warning = warningOf(found, "body-inside");
        return warning == nullptr ? std::string() : warning->line();
    };
    CHECK_THAT(warned("0.003,0.001,-0.002,1e-3\n0.02,0,0,1e-3\n"),
               Catch::Contains("1 of 2 spheres start inside of body \"block\"") && Catch::Contains("(3, 1, -2) mm"));
    CHECK(warned("0.003,0.001,-0.002,1e-3\n-0.004,0,0,1e-3\n").empty());  // a vessel
    CHECK(warned("0.03,0.001,-0.002,1e-3\n0.02,0,0.003,1e-3\n").empty());
}

TEST_CASE("a body that is to move in a phase that the run lacks is told, and a table too long to start anew") {
    const test::Folder folder;
    folder.write("way.csv", "time_s,angle_deg\n0,0\n0.02,90\n0.06,0\n");
    const auto warned = [&](const std::string& motion) {
        std::string text = test::kDrum;
        const std::string turn = "kind = \"turn\"\nspeed_rpm = 60\n";
        text.replace(text.find(turn), turn.size(), motion);
        const std::vector<Warning> found = warningsOfText(folder, text);
        const Warning* warning = warningOf(found, "body-phases");
        return warning == nullptr ? std::string() : warning->line();
    };
    const std::string turn = "kind = \"turn\"\nspeed_rpm = 60\n", table = "kind = \"table\"\nfile = \"way.csv\"\n";
    CHECK_THAT(warned(turn + "during = \"rotate rest\"\n"),
               Catch::Contains("body \"drum\" is to move in the phase rest") && Catch::Contains("dose.rest_s"));
    CHECK_THAT(warned(turn + "during = \"reverse\"\n"), Catch::Contains("dose.reverse_turns"));
    CHECK(warned(turn + "during = \"rotate\"\n").empty());
    CHECK_THAT(warned(table + "during = \"rotate\"\nanew = true\n"),
               Catch::Contains("takes 0.06 s") && Catch::Contains("at most 0.05 s"));
    CHECK(warned(table + "during = \"rotate\"\n").empty());
    CHECK(warned(table + "during = \"settle\"\nanew = true\n").empty());
}

TEST_CASE("two bodies that meet in a seam where powder comes are told, at rest or moving as one") {
    const test::Folder folder;
    folder.write("two.csv", "x,y,z,r\n0.002,0.01,0.001,1e-3\n-0.01,0.01,0,1e-3\n");
    const auto warned = [&](const std::string& bodies) {
        const std::vector<Warning> found = warningsOfText(folder, test::kFreeCase + bodies);
        const Warning* warning = warningOf(found, "body-seam");
        return warning == nullptr ? std::string() : warning->line();
    };
    const auto box = [](const std::string& name, const std::string& at) {
        return "[[body]]\nname = \"" + name + "\"\nshape = \"box\"\nsize_mm = [10, 4, 10]\nat = [" + at + "]\n";
    };
    CHECK_THAT(warned(box("left", "-0.005, 0, 0") + box("right", "0.005, 0, 0")),
               Catch::Contains("body \"left\" and body \"right\" meet in a seam") &&
                   Catch::Contains("export-body CASE left right"));
    CHECK(warned(box("left", "-0.005, 0, 0") + box("right", "0.005, -0.001, 0.001")).empty());  // a step
    CHECK(warned(box("left", "-0.005, 0, 0") + box("right", "0.0055, 0, 0")).empty());          // a gap
    // A funnel and its spout: the rim is met from within, where the way grows steeper.
    const std::string funnel =
        "[[body]]\nname = \"funnel\"\nshape = \"cone\"\nradius_mm = 4\nend_radius_mm = 12\nlength_mm = 6\n"
        "rotation_axis = [1, 0, 0]\nrotation_deg = -90\n";
    const std::string spout =
        "[[body]]\nname = \"spout\"\nshape = \"cylinder\"\nradius_mm = 4\nlength_mm = 6\n"
        "rotation_axis = [1, 0, 0]\nrotation_deg = 90\n";
    CHECK_THAT(warned(funnel + spout), Catch::Contains("\"funnel\" and body \"spout\" meet in a seam"));
    // A bin on a funnel: within it is a corner, which has two contacts by right; without it no powder comes.
    const std::string bin =
        "[[body]]\nname = \"bin\"\nshape = \"cylinder\"\nradius_mm = 12\nlength_mm = 20\nat = [0, 0.006, 0]\n"
        "rotation_axis = [1, 0, 0]\nrotation_deg = -90\n";
    CHECK(warned(funnel + bin).empty());
    // Bodies that move as one, and two that part.
    const std::string sinks = "[body.motion]\nkind = \"slide\"\nvelocity = [0, -0.1, 0]\n";
    const std::string left = box("left", "-0.005, 0, 0") + sinks, right = box("right", "0.005, 0, 0");
    CHECK_THAT(warned(left + box("again", "-0.005, 0, 0") + sinks),
               Catch::Contains("body \"left\" and body \"again\" coincide: a sphere at"));
    CHECK_THAT(warned(left + right + sinks), Catch::Contains("meet in a seam"));
    CHECK(warned(left + right + test::replaced(sinks, "-0.1", "-0.2")).empty());
}

TEST_CASE("every rule is shown by a slip") {
    std::set<std::string> shown{"no-outlet"}, all;  // that one takes a case without a canister
    for (const Slip& slip : kSlips) shown.insert(slip.name);
    for (const BodySlip& slip : kBodySlips) shown.insert(slip.name);
    shown.insert("body-inside");  // below
    shown.insert("body-phases");
    shown.insert("body-seam");
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
