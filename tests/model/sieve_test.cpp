// A sieve analysis as the distribution of sizes.
#include <algorithm>
#include <cmath>

#include "host/core/error.h"
#include "host/model/size_distribution.h"
#include "tests/model/case_files.h"
#include "tests/model/mutants.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// kGoodCase with another [particles.size].
std::string withSize(const std::string& lines) {
    return replaced(kGoodCase, "distribution = \"uniform\"\nradius_min_mm = 0.9\nradius_max_mm = 1.3\n",
                    "distribution = \"sieve\"\nscale_up = 10\n" + lines);
}

// 30 % between 140 and 180 um, 50 % up to 220, 20 % up to 280.
const std::string kPassing = "openings_um = [140, 180, 220, 280]\npassing_percent = [0, 30, 80, 100]\n";

void checkRefused(const std::string& lines, const std::string& key, const std::string& problem) {
    const Folder folder;
    CAPTURE(lines, key);
    try {
        loadCase(folder.write("case.toml", withSize(lines)));
        FAIL_CHECK("was accepted");
    } catch (const CaseError& error) {
        CAPTURE(error.what());
        const auto& faults = error.faults();
        CHECK(std::any_of(faults.begin(), faults.end(), [&](const Diagnostic& d) {
            return d.key == "particles.size." + key && d.line > 0 && d.problem.find(problem) != std::string::npos;
        }));
        for (const Diagnostic& d : faults) CHECK(unclear(d) == "");
    }
}

}  // namespace

TEST_CASE("a sieve table is drawn from by number, so that the mass on each sieve is the table's") {
    const Folder folder;
    const Case c = loadCase(folder.write("case.toml", withSize(kPassing)));
    const SizeDistribution& size = c.filling.size;
    REQUIRE(size.sieve.size() == 4);
    CHECK(smallestRadius(size) == Approx(0.7e-3));
    CHECK(largestRadius(size) == Approx(1.4e-3));
    CHECK(finerVolume(size, 0.9e-3) == Approx(0.3));
    CHECK(finerVolume(size, std::sqrt(0.9e-3 * 1.1e-3)) == Approx(0.55));
    CHECK(finerVolume(size, 0.5e-3) == 0);
    CHECK(finerVolume(size, 2e-3) == 1);

    constexpr int kDraws = 40000;
    const double edges[] = {0.7e-3, 0.9e-3, 1.1e-3, 1.4e-3};
    double mass[3] = {}, all = 0, sum = 0, cubes = 0, counts[3] = {};
    std::uint64_t redrawn = 0;
    for (int i = 0; i < kDraws; ++i) {
        const double r = drawRadius(size, 5, static_cast<std::uint64_t>(i), redrawn);
        REQUIRE(r >= edges[0] * (1 - 1e-12));
        REQUIRE(r <= edges[3] * (1 + 1e-12));
        const int part = r < edges[1] ? 0 : r < edges[2] ? 1 : 2;
        mass[part] += r * r * r;
        counts[part] += 1.0 / kDraws;
        all += r * r * r;
        sum += r / kDraws;
        cubes += r * r * r / kDraws;
    }
    // Three standard errors of a share of 40 000 draws of unequal mass.
    CHECK(mass[0] / all == Approx(0.3).margin(0.008));
    CHECK(mass[1] / all == Approx(0.5).margin(0.008));
    CHECK(mass[2] / all == Approx(0.2).margin(0.008));
    CHECK(meanRadius(size) == Approx(sum).epsilon(0.003));
    CHECK(meanCubedRadius(size) == Approx(cubes).epsilon(0.01));
    // By number: the integral of w d(ln r)/r^3 over each stretch.
    double number[3], numbers = 0;
    const double w[] = {0.3, 0.5, 0.2};
    for (int i = 0; i < 3; ++i) {
        number[i] =
            w[i] / std::log(edges[i + 1] / edges[i]) * (std::pow(edges[i], -3) - std::pow(edges[i + 1], -3)) / 3;
        numbers += number[i];
    }
    const std::vector<NumberClass> classes = numberClasses(size);
    REQUIRE(classes.size() == 3);
    for (int i = 0; i < 3; ++i) {
        CHECK(classes[i].share == Approx(number[i] / numbers));
        CHECK(counts[i] == Approx(classes[i].share).margin(0.008));
    }
    REQUIRE(c.derivations.size() == 1);
    CHECK_THAT(c.derivations[0], Catch::StartsWith("particles.size: drawn by number: "));
}

TEST_CASE("the same analysis in other words is the same powder") {
    const Folder folder;
    const auto file = folder.write("case.toml", withSize(kPassing));
    const Case c = loadCase(file);
    folder.write("passing.csv", "opening_um,passing_percent\n140,0\n180,30\n220,80\n280,100\n");
    folder.write("retained.csv", "opening_um,retained\n280,0\n220,10\n180,25\n140,15\n");
    const std::vector<std::string> same{
        "openings_um = [280, 220, 180, 140]\npassing_percent = [100, 80, 30, 0]\n",
        "openings_um = [140, 180, 220, 280]\nretained = [15, 25, 10, 0]\n",  // grams
        "openings_um = [100, 140, 180, 220, 280, 400]\nretained = [0, 0.3, 0.5, 0.2, 0, 0]\n",
        "sieves = \"passing.csv\"\n", "sieves = \"retained.csv\"\n"};
    for (const std::string& lines : same) {
        CAPTURE(lines);
        const Case other = loadCase(folder.write("other.toml", withSize(lines)));
        REQUIRE(other.filling.size.sieve.size() == 4);
        for (std::size_t i = 0; i < 4; ++i) {
            CHECK(other.filling.size.sieve[i].radius == Approx(c.filling.size.sieve[i].radius));
            CHECK(other.filling.size.sieve[i].finer == Approx(c.filling.size.sieve[i].finer).margin(1e-12));
        }
        // The resolved case has the table, also that of a file, and loads again as it is.
        CHECK(other.resolved.find("sieves =") == std::string::npos);
        const Case again = loadResolvedCase(other.resolved, folder / "other.toml");
        CHECK(again.resolved == other.resolved);
        CHECK(insertParticles(again).particles.radius == insertParticles(other).particles.radius);
    }
    CHECK(loadCase(folder.write("other.toml", withSize("sieves = \"passing.csv\"\n"))).files.size() == 2);
    // On top of a base each form takes the place of the other.
    CHECK(loadCase(file, {"particles.size.retained=[15, 25, 10, 0]"}).filling.size.sieve.size() == 4);
    CHECK(loadCase(file, {"particles.size.sieves=" + (folder / "passing.csv").string()}).filling.size.sieve.size() ==
          4);
}

TEST_CASE("bounds cut a sieve table, and it is told what they leave out") {
    const Folder folder;
    const auto file = folder.write("case.toml", withSize(kPassing));
    const Case c = loadCase(file, {"particles.size.radius_min_mm=0.9", "particles.size.radius_max_mm=1.2"});
    CHECK(smallestRadius(c.filling.size) == Approx(0.9e-3));
    CHECK(largestRadius(c.filling.size) == Approx(1.2e-3));
    const double coarse = 0.2 * std::log(1.4 / 1.2) / std::log(1.4 / 1.1);
    const Insertion filled = insertParticles(c);
    CHECK(filled.cutBelow == Approx(0.3));
    CHECK(filled.cutAbove == Approx(coarse));
    CHECK_THAT(c.derivations.at(0), Catch::Contains("% of the mass is beyond the bounds"));
    for (const double r : filled.particles.radius) CHECK((r >= 0.9e-3 - 1e-12 && r <= 1.2e-3 + 1e-12));
    CHECK_THROWS_WITH(loadCase(file, {"particles.size.radius_min_mm=1.5", "particles.size.radius_max_mm=1.6"}),
                      Catch::Contains("leave nothing of the scaled powder"));
}

TEST_CASE("broken sieve tables are refused by name") {
    const std::string openings = "openings_um = [140, 180, 220, 280]\n";
    checkRefused(openings, "passing_percent", "is missing");
    checkRefused("passing_percent = [0, 30, 80, 100]\n", "openings_um", "is missing");
    checkRefused(kPassing + "retained = [15, 25, 10, 0]\n", "retained", "stands beside passing_percent");
    checkRefused(kPassing + "sieves = \"a.csv\"\n", "openings_um", "stands beside sieves");
    checkRefused("sieves = \"nowhere.csv\"\n", "sieves", "");
    checkRefused("sieves = 3\n", "sieves", "not a string");
    for (const char* list :
         {"3", "\"140 180\"", "[140, \"a\", 220, 280]", "[140, nan, 220, 280]", "[140, inf, 220, 280]",
          "[140, 1e300, 220, 280]", "[140, -180, 220, 280]", "[[140], 180, 220, 280]", "true", "[]", "[140]",
          "[140, 180, 180, 280]", "[140, 220, 180, 280]", "[0, 180, 220, 280]"})
        checkRefused("openings_um = " + std::string(list) + "\npassing_percent = [0, 30, 80, 100]\n",
                     std::string(list) == "[]" || std::string(list) == "[140]" ? "passing_percent" : "openings_um", "");
    checkRefused("openings_um = [140]\npassing_percent = [100]\n", "openings_um", "is no table");
    const auto passing = [&](const std::string& list, const std::string& problem) {
        checkRefused(openings + "passing_percent = " + list + "\n", "passing_percent", problem);
    };
    passing("[0, 30, 100]", "has 3 entries for 4 openings");
    passing("[2, 30, 80, 100]", "2 % passes the finest sieve, 140 um");
    passing("[0, 30, 80, 95]", "5 % does not pass the coarsest sieve, 280 um");
    passing("[0, 0.3, 0.8, 1]", "is a fraction, not percent");
    passing("[0, 80, 30, 100]", "a coarser sieve lets less pass");
    passing("[0, 30, 80, 120]", "more than 100 %");
    passing("[0, 30, 80, nan]", "is larger than");
    passing("[0, 0, 0, 0]", "");
    const auto retained = [&](const std::string& list, const std::string& problem) {
        checkRefused(openings + "retained = " + list + "\n", "retained", problem);
    };
    retained("[0, 0, 0, 0]", "nothing lies on the sieves");
    retained("[15, 25, 0, 10]", "20 % lies on the coarsest sieve, 280 um");
    retained("[15, -25, 10, 0]", "-25 is negative");
    retained("\"15\"", "is not a list");
}

TEST_CASE("a table of sieves is read as spreadsheets write it, with semicolons, decimal commas and comments") {
    const Folder folder;
    const auto sieves = [&](const std::string& text) {
        folder.write("sieves.csv", text);
        return loadCase(folder.write("case.toml", withSize("sieves = \"sieves.csv\"\n"))).filling.size.sieve;
    };
    const auto plain = sieves("opening_um,passing_percent\n140,0\n180,30.5\n220.5,80\n280,100\n");
    REQUIRE(plain.size() == 4);
    for (const char* text :
         {"opening_um;passing_percent\n140;0\n180;30,5\n220,5;80\n280;100\n",
          "\xef\xbb\xbfopening_um;passing_percent\r\n140;0\r\n180;30,5\r\n220.5;80\r\n280;100\r\n",
          "# lot 12\nopening_um,passing_percent\n140,0\n# by hand\n180,30.5\n220.5,80\n280,100\n# end",
          "opening_um;passing_percent\n\"140\";0\n180;\"30,5\"\n220,5;80\n280;100"}) {
        CAPTURE(text);
        const auto found = sieves(text);
        REQUIRE(found.size() == plain.size());
        for (std::size_t i = 0; i < plain.size(); ++i) {
            CHECK(found[i].radius == plain[i].radius);
            CHECK(found[i].finer == plain[i].finer);
        }
    }
    const auto fault = [&](const std::string& text) {
        try {
            sieves(text);
        } catch (const CaseError& error) {
            return std::string(error.what());
        }
        return std::string("was accepted");
    };
    CHECK_THAT(fault("opening_um,passing_percent\n140,0\n180,30,5\n280,100\n"),
               Catch::Contains("sieves.csv:3") && Catch::Contains("write decimals with a point"));
    CHECK_THAT(fault("opening_um;passing_percent\n140;0\n1.180,5;30\n2000;100\n"),
               Catch::Contains("sieves.csv:3") && Catch::Contains("is not a number"));
    CHECK_THAT(fault("# opening_um,passing_percent\n140,0\n280,100\n"),
               Catch::Contains("lacks the column opening_um; it has \"140\", \"0\""));
}

TEST_CASE("broken files of sieves are refused with their line") {
    const Folder folder;
    const auto file = folder.write("case.toml", withSize("sieves = \"sieves.csv\"\n"));
    const std::vector<std::pair<const char*, const char*>> broken{
        {"", ""},
        {"opening_um\n140\n", "passing_percent"},
        {"opening,passing_percent\n140,0\n", "opening_um"},
        {"opening_um,passing_percent\n140,0\n180,many\n", ":3:"},
        {"opening_um,passing_percent\n140,0\n180\n", ":3:"},
        {"opening_um,passing_percent\n140,0\n180,\n", ":3:"},
        {"opening_um,passing_percent\n140,0\n-180,100\n", ":3:"},
        {"opening_um;passing_percent\n140;0\n", ""},
        {"opening_um,passing_percent,retained\n140,0,1\n280,100,0\n", "both columns"},
        {"opening_um,passing_percent\n140,0\n280,90\n", "does not pass the coarsest sieve"},
        {"\"opening_um", ""}};
    for (const auto& [text, part] : broken) {
        CAPTURE(text);
        folder.write("sieves.csv", text);
        CHECK_THROWS_WITH(loadCase(file), Catch::Contains(part));
    }
}
