// Numbers that are fine one by one and nonsense together, and texts that would mislead whoever reads the message.
#include <cmath>

#include "host/core/error.h"
#include "host/model/size_distribution.h"
#include "tests/model/case_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using test::Folder;
using test::kFreeCase;
using test::kGoodCase;
using test::replaced;

namespace {

std::string faultsOf(const std::filesystem::path& file, const std::vector<std::string>& overrides = {}) {
    try {
        loadCase(file, overrides);
    } catch (const CaseError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("numbers that do not go together are refused by name") {
    struct Row {
        std::vector<std::string> overrides;
        std::string says;
    };
    const std::vector<Row> rows{
        {{"gravity=[0, -1e12, 0]"}, "gravity = [0, -1e12, 0]: moves the smallest sphere"},
        {{"coil.speed_rpm=1e6"}, "coil.speed_rpm = 1e6: moves the wire"},
        {{"settle.time_s=1e-9"}, "settle.time_s = 1e-9: is shorter than half a time step"},
        {{"dose.rotate_s=1e14"}, "dose.rotate_s = 1e14: is more than 1e+15 time steps"},
        {{"dose.rest_s=1e14"}, "dose.rest_s = 1e14: is more than"},
        {{"dose.reverse_turns=1e-320"}, "dose.reverse_turns = 1e-320: takes less than half a time step"},
        {{"dose.reverse_turns=1e8", "coil.speed_rpm=1e-3"}, "dose.reverse_turns = 1e8: takes more than 1e+15 time"},
        {{"stop.end_time_s=1e14"}, "stop.end_time_s = 1e14: is more than"},
        {{"time.skin_mm=1000"}, "time.skin_mm = 1000: makes every particle a neighbour"},
        {{"time.skin_mm=21"}, "time.skin_mm = 21: gives particle 0 at ("},
        {{"time.skin_mm=21"}, "give about 0.66, 0.6 of the mean radius"},
        {{"stop.doses=4294967297"}, "stop.doses = 4294967297: is too large"},
        {{"stop.max_doses=4294967297"}, "stop.max_doses = 4294967297: is too large"},
        {{"domain.low=[-1e9, -1e9, -1e9]", "domain.high=[1e9, 1e9, 1e9]"}, "domain: reaches 1e+09 m from the origin"},
        {{"particles.mass_g=1e-6"}, "particles.mass_g = 1e-6: is less than half of the first particle"},
        {{"name='../elsewhere'"}, "is no name for a folder"},
        {{"name=''"}, "is no name for a folder"},
        {{"name='..'"}, "is no name for a folder"},
        {{"contact.max_overlap_ratio=3"}, "contact.max_overlap_ratio = 3: "},
        {{"coil.wire_diameter_mm=1e-6", "coil.turns=1e6"}, "coil: is wider than 100 times its pitch"},
        {{"contact.friction=0.1\nseed=4"}, "is more than one line"},
    };
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);
    for (const Row& row : rows) {
        INFO(row.overrides.front());
        CHECK_THAT(faultsOf(file, row.overrides), Catch::Contains(row.says));
    }
}

TEST_CASE("a list in mm is blamed, not gravity or the times") {
    const Folder folder;
    folder.write("two.csv", "x,y,z,r\n1,5,10,1\n3,5,20,1\n");
    const std::string text = replaced(kFreeCase, "gravity = [0, 0, 0]", "gravity = [0, -9.81, 0]");
    const std::string said = faultsOf(folder.write("case.toml", text));
    CHECK_THAT(said, Catch::Contains("particles.list = \"two.csv\": has spheres of radius 1000 mm") &&
                         Catch::Contains("a list is in metres") && !Catch::Contains("gravity") &&
                         !Catch::Contains("settle"));
    folder.write("two.csv", "x,y,z,r\n0.001,0.005,0.010,0.001\n0.003,0.005,0.020,0.001\n");
    CHECK(faultsOf(folder.write("case.toml", text)).empty());
}

TEST_CASE("a sphere too light for single precision is refused") {
    const Folder folder;
    folder.write("two.csv", "x,y,z,r\n0,0,0,1e-9\n");
    CHECK_THAT(faultsOf(folder.write("case.toml", kFreeCase), {"contact.damping=0"}),
               Catch::Contains("particles.list") && Catch::Contains("too light to compute"));
}

TEST_CASE("listed particles too fast for their time step or too far away are refused") {
    const Folder folder;
    const auto file = folder.write("case.toml", kFreeCase);
    const auto with = [&](const std::string& row) {
        folder.write("two.csv", "x,y,z,r,vx,vy,vz,wx,wy,wz\n" + row);
        return faultsOf(file);
    };
    CHECK(with("0,0,0,1e-3,0.1,0,0,10,0,0\n") == "");
    CHECK_THAT(with("0,0,0,1e-3,0,1e6,0,0,0,0\n"), Catch::Contains("particle 0") && Catch::Contains("in m/s"));
    CHECK_THAT(with("0,0,0,1e-3,0,0,0,0,0,1e9\n"), Catch::Contains("particle 0") && Catch::Contains("in rad/s"));
    CHECK_THAT(with("1e6,0,0,1e-3,0,0,0,0,0,0\n"), Catch::Contains("from the origin"));
}

TEST_CASE("a list that is not there is blamed on the line that names it") {
    const Folder folder;
    const auto file = folder.write("case.toml", kFreeCase);
    CHECK_THAT(faultsOf(file), Catch::StartsWith(file.string() + ":5: particles.list = \"two.csv\": there is no file"));
    CHECK_THAT(faultsOf(folder.write("a.toml", replaced(kFreeCase, "\"two.csv\"", "5"))),
               Catch::Contains("is a whole number, not a string") && !Catch::Contains("there is no file"));
}

TEST_CASE("the mean of a cut distribution is that of its draws") {
    for (const auto kind : {SizeDistribution::Kind::Normal, SizeDistribution::Kind::Lognormal}) {
        SizeDistribution size;
        size.kind = kind;
        size.radius = 1e-3;
        size.deviation = kind == SizeDistribution::Kind::Normal ? 1e-3 : 2.0;
        size.radiusMin = 0.5e-3;
        size.radiusMax = 1.2e-3;
        double first = 0, third = 0;
        std::uint64_t redrawn = 0;
        constexpr int kDraws = 40000;
        for (int i = 0; i < kDraws; ++i) {
            const double r = drawRadius(size, 5, static_cast<std::uint64_t>(i), redrawn);
            first += r / kDraws;
            third += r * r * r / kDraws;
        }
        // Nearly uniform between the bounds: relative deviations of 0.24 and 0.6 over the root of the draws.
        CHECK(meanRadius(size) == Approx(first).epsilon(4 * 0.24 / 200));
        CHECK(meanCubedRadius(size) == Approx(third).epsilon(4 * 0.65 / 200));
    }
}

TEST_CASE("a wide distribution cut narrow fills what it says") {
    const Folder folder;
    const std::string text = replaced(kGoodCase, "distribution = \"uniform\"",
                                      "distribution = \"lognormal\"\nradius_median_mm = 1.0\nlog_deviation = 5.0");
    const Case c = loadCase(folder.write("case.toml", text));
    CHECK(std::abs(insertParticles(c).mass - 0.9e-3) <= 1427 * 4.0 / 3.0 * kPi * std::pow(1.3e-3, 3) / 2);
}

TEST_CASE("a message shows the value itself, on one line, however it is written") {
    const Folder folder;
    const auto file =
        folder.write("case.toml", replaced(kGoodCase, "friction = 0.5", "\"Reibung µ ∈ ℝ\" = 0.25\nfriction = 0.5"));
    CHECK_THAT(faultsOf(file), Catch::Contains("contact.Reibung µ ∈ ℝ = 0.25: unknown key"));
    CHECK_THAT(faultsOf(folder.write("a.toml",
                                     replaced(kGoodCase, "friction = 0.5", "\"a\\n\\u001b[31m\" = 1\nfriction = 0.5"))),
               Catch::Contains("contact.a\\x0a\\x1b[31m = 1: unknown key"));
    const std::string longest(5000, 'v');
    const std::string told =
        faultsOf(folder.write("b.toml", replaced(kGoodCase, "seed = 3", "seed = \"" + longest + "\"")));
    CHECK_THAT(told, Catch::Contains("vvv...: is a string, not a whole number"));
    CHECK(told.size() < 400);
}

TEST_CASE("well-formed UTF-8 is told from the rest") {
    for (const char* good : {"", "abc", "µ", "ℝ", "𝔸", "\xed\x9f\xbf", "\xf4\x8f\xbf\xbf"}) CHECK(isUtf8(good));
    for (const char* bad : {"\x80", "\xc3", "\xc3(", "\xc0\x80", "\xe0\x80\x80", "\xed\xa0\x80", "\xf0\x80\x80\x80",
                            "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xff", "a\xe2\x82"})
        CHECK_FALSE(isUtf8(bad));
}

TEST_CASE("a case named after a file whose name is no text is refused") {
    const Folder folder;
    CHECK_THAT(faultsOf(folder.write("\xff.toml", replaced(kGoodCase, "name = \"good\"\n", ""))),
               Catch::Contains("name: ") && Catch::Contains("is no name for a folder"));
}
