// Figures and verdicts of the comparisons, from runs whose results are made up so that the answer is known.

#include <fmt/format.h>
#include <array>

#include <cmath>
#include <limits>
#include <vector>

#include "host/output/frame_writer.h"
#include "host/validate/comparisons.h"
#include "host/validate/tables.h"
#include "tests/support/catch.h"
#include "tests/support/folder.h"

using namespace vkdose;
using namespace vkdose::validate;

namespace {

Run beverlooRun(double radiusMm, double constant, double gap, double density) {
    const double open = 2e-3 * radiusMm - gap * 2e-3;
    Run run;
    run.at["body.floor.hole_radius_mm"] = std::to_string(radiusMm);
    const double rate = constant * density * std::sqrt(9.81) * std::pow(open, 2.5);
    run.summary["measures"]["discharge"] = {{"rate_kg_s", rate}, {"rate_error_kg_s", 0.01 * rate}};
    run.summary["measures"]["settled"]["density_kg_m3"] = density;
    return run;
}

std::vector<Run> silos(double constant, double gap) {
    std::vector<Run> runs;
    for (const double radius : {4.0, 5.0, 6.0, 8.0}) runs.push_back(beverlooRun(radius, constant, gap, 1500));
    return runs;
}

/// A heap whose angle is 20 degrees at friction 0.4, rolling 0.05 and 1 mm, and follows these exponents.
Run heapRun(double friction, double rolling, double radius, const std::array<double, 3>& exponents) {
    Run run;
    run.at = {{"contact.friction", std::to_string(friction)},
              {"contact.rolling_friction", std::to_string(rolling)},
              {"particles.size.radius_mm", std::to_string(radius)}};
    // With the size the coefficient of rolling falls; what the angle follows is the length of the lever.
    const double angle = 20 * std::pow(friction / 0.4, exponents[0]) * std::pow(rolling * radius / 0.05, exponents[1]) *
                         std::pow(radius, exponents[2]);
    run.summary["measures"]["heap"] = {{"angle_deg", angle}, {"angle_error_deg", 0.5}};
    return run;
}

std::vector<Run> heaps(const std::array<double, 3>& exponents) {
    std::vector<Run> runs;
    for (int seed = 0; seed < 2; ++seed)
        for (const auto& [friction, rolling, radius] : std::vector<std::array<double, 3>>{{0.4, 0.05, 1},
                                                                                          {0.2, 0.05, 1},
                                                                                          {0.8, 0.05, 1},
                                                                                          {0.4, 0.0125, 1},
                                                                                          {0.4, 0.2, 1},
                                                                                          {0.4, 0.0625, 0.8},
                                                                                          {0.4, 0.0385, 1.3}})
            runs.push_back(heapRun(friction, rolling, radius, exponents));
    return runs;
}

/// Of a hundred spheres of each powder, how many lie in a quadrant at a time: M1 above on the rising side, M1 below on
/// the other, M2 likewise. A few times of a drum that turns M1 round once, and carries M2 behind it.
struct Drum {
    double time;
    std::array<int, 4> count;
};
const std::vector<Drum> kDrum{{0.0, {0, 70, 30, 10}},  {0.5, {0, 90, 0, 20}}, {1.0, {0, 40, 10, 30}},
                              {1.5, {25, 10, 20, 60}}, {2.0, {5, 35, 5, 40}}, {2.5, {0, 55, 8, 20}}};

/// A run of it, of two powders, with frames.
Run drumRun(const std::filesystem::path& folder, const std::vector<Drum>& drum) {
    Case c;
    c.world.materials.push_back({"M2", true, 2000});
    c.frames = {0.5, false};
    const int powders[]{kFirstPowder, static_cast<int>(c.world.materials.size()) - 1};
    FrameWriter writer(folder, c, 0);
    for (const Drum& line : drum) {
        Frame frame;
        frame.time = line.time;
        for (std::size_t powder = 0; powder < 2; ++powder)
            for (int i = 0; i < 100; ++i) {
                const int above = line.count[2 * powder], below = line.count[2 * powder + 1];
                // The others lie in the two quadrants that do not count.
                const Vec3 at = i < above           ? Vec3(-0.01, 0.02, 0)
                                : i < above + below ? Vec3(0.02, -0.01, 0)
                                : i % 2 == 0        ? Vec3(-0.01, -0.02, 0)
                                                    : Vec3(0.02, 0.01, 0);
                frame.particles.add(at, 1e-3, Vec3(0), Vec3(0), powders[powder]);
            }
        writer.put(frame);
    }
    writer.store();
    Run run;
    run.folder = folder;
    return run;
}

/// The same as another program's table tells it, later by `late` and with `more` of M1 everywhere.
std::string drumRows(const std::string& program, double late, double more, const std::vector<Drum>& drum = kDrum) {
    std::string rows;
    for (const Drum& line : drum) {
        rows += program + "," + std::to_string(line.time + late);
        for (int k = 0; k < 4; ++k)
            rows += "," + std::to_string(line.count[std::size_t(k)] / 100.0 + (k < 2 ? more : 0));
        rows += "\n";
    }
    return rows;
}

}  // namespace

TEST_CASE("a verdict takes the range and twice the standard error") {
    Finding f{"figure", "-", 1.0, 0.1, 0.5, 1.5};
    CHECK(f.verdict() == Verdict::Agrees);
    f.got = 1.69;
    CHECK(f.verdict() == Verdict::Undecided);
    f.got = 1.71;
    CHECK(f.verdict() == Verdict::Differs);
    f.got = 0.29;
    CHECK(f.verdict() == Verdict::Differs);
    f.got = std::numeric_limits<double>::quiet_NaN();
    CHECK(f.verdict() == Verdict::Differs);
    f.error = f.got;
    f.got = 2;
    CHECK(f.verdict() == Verdict::Differs);
    f.comparable = false;
    CHECK(f.verdict() == Verdict::NotComparable);
}

TEST_CASE("a sign is known at two standard errors from zero") {
    for (const double side : {1.0, -1.0}) {
        Finding f{"figure", "-", side * 0.21, 0.1};
        f.wanted = side > 0 ? Wanted::Positive : Wanted::Negative;
        CHECK(f.verdict() == Verdict::Agrees);
        for (const double little : {0.19, -0.19}) {
            f.got = side * little;
            CHECK(f.verdict() == Verdict::Undecided);
        }
        f.got = side * -0.21;
        CHECK(f.verdict() == Verdict::Differs);
        f.got = std::numeric_limits<double>::quiet_NaN();
        CHECK(f.verdict() == Verdict::Differs);
    }
}

TEST_CASE("a program that never comes to a figure is named and left out") {
    Finding f{"figure", "s", 1.0};
    f.remark = "a remark";
    const double none = std::numeric_limits<double>::quiet_NaN();
    holdAgainst(f, {{"A", 0.99}, {"B", none}}, 0.05, 0);
    CHECK(f.verdict() == Verdict::Agrees);
    CHECK(f.high == Approx(1.05 * 0.99));
    CHECK(f.source == "A 0.99 s");
    CHECK(f.remark == "a remark; without B, whose curve does not have it");
    holdAgainst(f, {{"B", none}}, 0.05, 0);
    CHECK(f.verdict() == Verdict::NotComparable);
}

TEST_CASE("the fit of Beverloo's law gives back its constants") {
    const Evaluation good = beverloo(silos(0.58, 1.4), "");
    REQUIRE(good.findings.size() == 3);
    CHECK(good.findings[0].got == Approx(0.58).epsilon(1e-6));
    CHECK(good.findings[1].got == Approx(1.4).epsilon(1e-6));
    CHECK(good.findings[2].got < 1e-6);
    for (const Finding& f : good.findings) CHECK(f.verdict() == Verdict::Agrees);
    CHECK(beverloo(silos(0.7, 1.4), "").findings[0].verdict() == Verdict::Differs);
    CHECK(beverloo(silos(0.58, 2.3), "").findings[1].verdict() == Verdict::Differs);

    std::vector<Run> bent = silos(0.58, 1.4);
    bent[1].summary["measures"]["discharge"]["rate_kg_s"] = 1.5 * bent[1].figure("/measures/discharge/rate_kg_s");
    CHECK(beverloo(bent, "").findings[2].verdict() == Verdict::Differs);
    CHECK(beverloo(bent, "").findings[1].error > 0.1);
    // Every hole filled twice: a hole is left out with both fillings, so that the errors stay.
    std::vector<Run> twice = bent;
    twice.insert(twice.end(), bent.begin(), bent.end());
    for (const std::size_t i : {0, 1})
        CHECK(beverloo(twice, "").findings[i].error == Approx(beverloo(bent, "").findings[i].error));
    bent[1].summary["measures"].erase("discharge");  // nothing ran out
    for (const Finding& f : beverloo(bent, "").findings) CHECK(f.verdict() == Verdict::Differs);
    twice = silos(0.58, 1.4);
    twice.resize(2);
    twice.push_back(twice[0]);
    for (const Finding& f : beverloo(twice, "").findings) CHECK(f.verdict() == Verdict::NotComparable);
}

TEST_CASE("the angle of repose gives back the exponents that its runs follow, and their signs are judged") {
    const Evaluation good = heap(heaps({0.27, 0.06, -0.2}), "");
    REQUIRE(good.findings.size() == 6);
    CHECK(good.findings[0].got == Approx(0.27).epsilon(1e-6));
    CHECK(good.findings[2].got == Approx(0.06).epsilon(1e-6));
    CHECK(good.findings[4].got == Approx(-0.2).epsilon(1e-2));  // 0.0385 is 0.05/1.3 to three digits
    for (const std::size_t i : {0, 2, 4}) CHECK(good.findings[i].verdict() == Verdict::Agrees);
    for (const std::size_t i : {1, 3, 5}) CHECK(good.findings[i].verdict() == Verdict::NotComparable);
    for (const Chart& chart : good.charts) CHECK(chart.curves[0].points.size() == 3);
    const Evaluation bad = heap(heaps({-0.27, -0.2, 0.3}), "");
    for (const std::size_t i : {0, 2, 4}) CHECK(bad.findings[i].verdict() == Verdict::Differs);
    // Angles known to half a degree do not tell a weak trend from none.
    for (const double weak : {-0.005, 0.005})
        CHECK(heap(heaps({0.27, weak, -0.2}), "").findings[2].verdict() == Verdict::Undecided);
    std::vector<Run> two = heaps({0.27, 0.06, -0.2});
    two.resize(2);  // the middle and one friction
    CHECK(heap(two, "").findings[0].verdict() == Verdict::NotComparable);
}

TEST_CASE("the error of an exponent knows the quarters of the heaps, the fillings and the misfit of a power") {
    // The frictions are a factor of two apart: the sum of squares about the mean of their logarithms.
    const double spread = 2 * std::log(2) * std::log(2);
    const auto errorOf = [](const std::vector<Run>& runs) { return heap(runs, "").findings[0].error; };
    std::vector<Run> runs = heaps({0, 0, 0});  // two fillings, 20 degrees each, known to half a degree
    CHECK(errorOf(runs) == Approx(0.5 / std::sqrt(2) / 20 / std::sqrt(spread)));
    const auto angle = [](Run& run) -> nlohmann::ordered_json& { return run.summary["measures"]["heap"]["angle_deg"]; };
    // Fillings that differ by 2 a degrees have a mean that is known to a.
    for (const std::size_t i : {1, 2}) angle(runs[i]) = 22, angle(runs[i + 7]) = 18;
    CHECK(errorOf(runs) == Approx(2.0 / 20 / std::sqrt(spread)));
    runs = heaps({0, 0, 0});
    for (const std::size_t i : {0, 7}) angle(runs[i]) = 20 * std::exp(0.3);  // the middle, off the line by 0.2
    CHECK(errorOf(runs) == Approx(std::sqrt(0.2 * 0.2 + 2 * 0.1 * 0.1) / std::sqrt(spread)));
}

TEST_CASE("a hopper is judged by the published curve, from the time when its gate opens") {
    const test::Folder published;
    published.write("anand-curve.csv", "time_s,mass_g\n0,0\n0.25,20\n0.75,60\n1.1,84\n2,90\n");
    const auto runOf = [](const test::Folder& folder, double rate) {
        std::string rows = "time_s,pan.mass_kg\n0,0\n0.9,0\n";
        for (int i = 0; i <= 20; ++i)
            rows += fmt::format("{},{}\n", 1 + 0.1 * i, 1e-3 * std::min(90.0, rate * 0.1 * i));
        folder.write("timeseries.csv", rows);
        Run run;
        run.folder = folder.path();
        return run;
    };
    const test::Folder one, two, slow;
    const Evaluation good = anand({runOf(one, 79), runOf(two, 82)}, published.path());
    REQUIRE(good.findings.size() == 5);
    CHECK(good.findings[0].got == Approx(80.5));
    CHECK(good.findings[0].error == Approx(1.5));
    CHECK(good.findings[0].low == Approx(0.95 * 80));
    CHECK(good.findings[2].got == Approx((40 / 79.0 + 40 / 82.0) / 2).epsilon(1e-3));
    CHECK(good.findings[0].high == Approx(1.05 * 91.73));  // of Lethe
    CHECK(good.findings[0].verdict() == Verdict::Agrees);
    for (std::size_t i = 1; i < 5; ++i) CHECK(good.findings[i].verdict() == Verdict::NotComparable);
    CHECK(good.charts[0].curves.size() == 3);
    // The curve belongs to both sizes.
    CHECK(anand({runOf(one, 79)}, published.path() / "full").findings[0].low == Approx(0.95 * 80));
    const Evaluation wrong = anand({runOf(slow, 70)}, published.path());
    CHECK(wrong.findings[0].verdict() == Verdict::Differs);
    // Less than it takes comes out.
    CHECK(anand({runOf(slow, 20)}, published.path()).findings[0].verdict() == Verdict::Differs);
}

TEST_CASE("a silo is judged by the programs that ran the same inputs, and by none without them") {
    const test::Folder folder;
    Run run;
    run.folder = folder.path();
    run.at = {{"particles.density", "2500.0"}, {"body.cone.radius_mm", "20.0"}};
    run.summary["inputs"]["filled_mass_kg"] = 2.0;
    folder.write("timeseries.csv", "time_s,pan.mass_kg\n0,0\n0.1,0\n0.2,0.4\n0.3,0.8\n0.4,1.6\n");
    // 90 % are left at 0.15 s and 40 % at 0.35 s.
    const Evaluation alone = dostaSilo({run}, folder.path());
    REQUIRE(alone.findings.size() == 1);
    CHECK(alone.findings[0].got == Approx(0.2));
    CHECK(alone.findings[0].verdict() == Verdict::NotComparable);

    const auto peers = [&](const char* last) {
        return folder.write(
            "dosta-silo-peers.csv",
            std::string("program,material,hole_mm,time_s,left\nA,M1,40,0.5,1\nA,M1,40,0.6,0.8\nA,M1,40,") + last +
                ",0.4\nA,M2,40,0.5,1\nA,M2,40,9,0.1\n");
    };
    peers("0.76");
    const Evaluation beside = dostaSilo({run}, folder.path());  // theirs: 0.55 to 0.76 s
    CHECK(beside.findings[0].verdict() == Verdict::Agrees);
    CHECK(beside.charts[0].curves.size() == 2);
    peers("0.80");
    CHECK(dostaSilo({run}, folder.path()).findings[0].verdict() == Verdict::Differs);

    // A silo that does not come to 40 % left is timed to 70 %, and the programs with it.
    folder.write("timeseries.csv", "time_s,pan.mass_kg\n0,0\n0.1,0\n0.2,0.4\n0.3,0.8\n");
    peers("0.76");
    const Finding slow = dostaSilo({run}, folder.path()).findings[0];
    CHECK(slow.figure == "from 90 to 70 % left, M1, hole of 40 mm");
    CHECK(slow.got == Approx(0.1));    // 0.15 to 0.25 s
    CHECK(slow.source == "A 0.09 s");  // 0.55 to 0.64 s
    CHECK(slow.verdict() == Verdict::Differs);
}

TEST_CASE("a drum is judged by the quadrants its two powders lie in, beside other programs") {
    const test::Folder folder;
    const Run run = drumRun(folder.path(), kDrum);
    const Evaluation alone = dostaDrum({run}, folder.path());
    REQUIRE(alone.findings.size() == 6);
    CHECK(alone.findings[0].got == Approx(0.9));   // 90 % at 0.5 s, 40 % at 1 s
    CHECK(alone.findings[1].got == Approx(1.8));   // 10 % at 1.5 s, 35 % at 2 s
    CHECK(alone.findings[2].got == Approx(0.39));  // at 2.1 s, between 35 % at 2 s and 55 % at 2.5 s
    CHECK(alone.findings[3].got == Approx(0.25));
    CHECK(alone.findings[4].got == Approx(0.6));
    CHECK(alone.findings[5].got == Approx(0.2));  // not the 0.3 with which M2 starts
    for (const Finding& f : alone.findings) CHECK(f.verdict() == Verdict::NotComparable);

    const auto peers = [&](const std::string& rows) {
        folder.write("dosta-drum-peers.csv", "program,time_s,M1_rise,M1_fall,M2_rise,M2_fall\n" + rows);
        return dostaDrum({run}, folder.path());
    };
    const Evaluation same = peers(drumRows("A", 0.01, 0) + drumRows("B", 0, 0.02));
    for (const Finding& f : same.findings) CHECK(f.verdict() == Verdict::Agrees);
    REQUIRE(same.charts.size() == 4);
    for (const Chart& chart : same.charts) CHECK(chart.curves.size() == 3);
    CHECK(same.charts[3].curves[0].points[3][1] == Approx(0.6));
    const Evaluation late = peers(drumRows("A", 0.2, 0));
    for (const std::size_t i : {0, 1}) CHECK(late.findings[i].verdict() == Verdict::Differs);
    for (const std::size_t i : {2, 3, 4, 5}) CHECK(late.findings[i].verdict() == Verdict::Agrees);
    const Evaluation other = peers(drumRows("A", 0, 0.1));
    CHECK(other.findings[3].verdict() == Verdict::Differs);
    for (const std::size_t i : {4, 5}) CHECK(other.findings[i].verdict() == Verdict::Agrees);
    std::vector<Drum> quick = kDrum;
    quick.back().count[1] = 100;  // of M1 below, in the end
    CHECK(peers(drumRows("A", 0, 0, quick)).findings[2].verdict() == Verdict::Differs);
    // A curve that ends with its largest share may have gone on to grow.
    quick.back().count[0] = 60;
    CHECK(peers(drumRows("A", 0, 0, quick)).findings[3].verdict() == Verdict::NotComparable);
}

TEST_CASE("a drum takes the mean of its fillings, and differs where nothing goes round") {
    const test::Folder one, two;
    std::vector<Drum> less = kDrum;
    less[3].count[0] = 21;  // of M1 above
    const Run first = drumRun(one.path(), kDrum), second = drumRun(two.path(), less);
    one.write("dosta-drum-peers.csv", "program,time_s,M1_rise,M1_fall,M2_rise,M2_fall\n" + drumRows("A", 0, 0));
    const Evaluation both = dostaDrum({first, second}, one.path());
    CHECK(both.findings[3].got == Approx(0.23));
    CHECK(both.findings[3].error == Approx(0.02));
    CHECK(both.findings[3].remark.find("2 fillings here between 0.21 and 0.25") == 0);
    CHECK(both.charts[0].curves[0].points[3][2] == Approx(0.02));
    CHECK(dostaDrum({first}, one.path()).findings[3].remark.find("one filling here; 0.04 beyond") == 0);

    const test::Folder still;
    const std::vector<Drum> resting(4, kDrum[1]);
    const Evaluation bad = dostaDrum({drumRun(still.path(), resting)}, one.path());
    for (const Finding& f : bad.findings) CHECK(f.verdict() == Verdict::Differs);
}

TEST_CASE("the tables tell every figure with its verdict, and what could not be compared") {
    const std::vector<Result> results{{"a", "what", "source", beverloo(silos(0.7, 1.4), ""), "4 runs", "reference", ""},
                                      {"b", "what", "", {}, "", "", "no powder"}};
    CHECK(differing(results) == 1);
    CHECK(tally(results) == "verdicts: 2 agrees, 1 differs");
    const std::string text = markdownTable(results);
    CHECK(text.find("| C | 0.55 to 0.65 | 0.7") != std::string::npos);
    CHECK(text.find("| differs |") != std::string::npos);
    CHECK(text.find("4 runs, on reference.") != std::string::npos);
    CHECK(markdownTable({{"c", "what", "", {{Finding{"f", "-"}}, {}}, "", "", ""}}).find("| none |") !=
          std::string::npos);
    CHECK(text.find("Not made: no powder") != std::string::npos);
    const auto json = nlohmann::json::parse(jsonTable(results));
    CHECK(json["comparisons"][0]["findings"][0]["verdict"] == "differs");
    CHECK(json["tally"]["differs"] == 1);
    CHECK(curvesCsv(results[0].evaluation).find("\"Beverloo's law\",\"fit\",8,") != std::string::npos);
}
