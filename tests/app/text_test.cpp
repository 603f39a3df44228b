#include "host/app/text.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "host/app/end_table.h"
#include "host/app/progress.h"
#include "host/app/sweep_display.h"
#include "tests/app/sandbox.h"
#include "tests/sim/fake_backend.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

TEST_CASE("masses of milligrams keep their digits") {
    CHECK(grams(3.7021e-3) == "3.702");
    CHECK(grams(12.0) == "12000.000");
    CHECK(grams(0.1e-3) == "0.100");
    CHECK(grams(0.04413e-3) == "0.0441");
    CHECK(grams(-4.413e-7) == "-0.000441");
    CHECK(grams(0) == "0.000");
    CHECK(grams(1e-15) == "0.000000000");
    CHECK(signedGrams(0.021e-3) == "+0.0210");
    CHECK(signedGrams(-1.5e-3) == "-1.500");
}

TEST_CASE("durations read as people say them") {
    CHECK(duration(0.04) == "0.0 s");
    CHECK(duration(9.94) == "9.9 s");
    CHECK(duration(59.4) == "59 s");
    CHECK(duration(59.6) == "1 min 00 s");
    CHECK(duration(3599.6) == "1 h 00 min");
    CHECK(duration(7805) == "2 h 10 min");
    CHECK(duration(100 * 3600.0) == "4 d 4 h");
    CHECK(duration(-1) == "?");
    CHECK(duration(std::numeric_limits<double>::quiet_NaN()) == "?");
    CHECK(duration(std::numeric_limits<double>::infinity()) == "?");
}

TEST_CASE("large figures stand before a unit") {
    CHECK(large(12) == "12 ");
    CHECK(large(950e3) == "950 k ");
    CHECK(large(8.31e6) == "8.31 M ");
    CHECK(large(1.2e9) == "1.2 G ");
}

TEST_CASE("a progress line says phase, dose, time, speed and what is left") {
    Progress p;
    p.phase = Phase::Rotate;
    p.dose = 3;
    p.time = 6.2;
    p.step = 250;
    p.expectedSteps = 1000;
    p.steps = 50;  // gone on with at 200
    p.particleSteps = 1e9;
    p.wallTime = 100;
    CHECK_THAT(progressText(p), Catch::Contains("dose 3 rotate") && Catch::Contains("t = 6.200 s") &&
                                    Catch::Contains("25 %") && Catch::Contains("10 M particle-steps/s") &&
                                    Catch::Contains("ETA 25 min 00 s"));
    p.expectedSteps = 0;
    CHECK_THAT(progressText(p), !Catch::Contains("ETA"));
}

TEST_CASE("the pace of a sweep is that of its members, without the settling before them") {
    using std::chrono::seconds;
    const SweepPace::Clock::time_point start{};
    SweepPace pace;
    SweepProgress p;
    p.members = 4;
    CHECK(pace.secondsLeft(p, start) < 0);
    CHECK(pace.secondsLeft(p, start + seconds(500)) < 0);  // beds settle
    p.running = 2;
    CHECK(pace.secondsLeft(p, start + seconds(600)) < 0);
    p.fraction = 0.4;  // of which 0.3 was done by an earlier call
    p.fractionHere = 0.1;
    CHECK(pace.secondsLeft(p, start + seconds(650)) == Approx(300));
    p.running = 0;  // the last member is noted
    p.fraction = 1;
    p.fractionHere = 0.7;
    CHECK(pace.secondsLeft(p, start + seconds(950)) == 0);
}

TEST_CASE("where there is no terminal, progress is plain lines at phase ends") {
    const Sandbox box;
    std::FILE* file = std::fopen((box / "progress.txt").c_str(), "w");
    REQUIRE(file != nullptr);
    {
        ProgressDisplay display(file);
        Progress p;
        for (int i = 0; i < 1000; ++i) display.onProgress(p);
        p.phaseEnd = true;
        display.onProgress(p);
        Dose d;
        d.index = 1;
        d.mass = d.cumulative = 3.7e-3;
        d.complete = true;
        display.onDose(d);
    }
    std::fclose(file);
    const std::string text = readText(box / "progress.txt");
    CHECK(text.find('\r') == std::string::npos);
    CHECK(text.find('\033') == std::string::npos);
    CHECK(std::count(text.begin(), text.end(), '\n') == 2);
    CHECK_THAT(text, Catch::Contains("dose 1: 3.700 g, cumulative 3.700 g"));
}

TEST_CASE("doses far from the closed form are noted at the end of the run, in the summary and in the report") {
    const Sandbox box;
    const std::string run = "run " VKDOSE_SOURCE_DIR
                            "/cases/mini.toml --backend reference --set settle.time_s=0.05 --set dose.rotate_s=0.05 "
                            "--set stop.max_doses=1 --out ";
    const auto o = box.vkdose(run + "out");
    CAPTURE(o.out, o.err);
    REQUIRE(o.code == 0);
    const std::size_t line = o.out.find("\nnote     the dose, ");
    REQUIRE(line != std::string::npos);
    const std::string note = o.out.substr(line + 10, o.out.find('\n', line + 1) - line - 10);
    CHECK_THAT(note, Catch::Contains(" of the closed form; likely reasons: "));
    CHECK(nlohmann::json::parse(readText(box / "out/summary.json"))["closed_form"]["note"] == note);
    REQUIRE(box.vkdose("report out").code == 0);
    CHECK_THAT(readText(box / "out/report.html"),
               Catch::Contains("{\"name\":\"far from the closed form\",\"value\":\"" + note + "\""));
}

TEST_CASE("the table at the end shows doses beside the closed form, statistics, ledger and reason") {
    FakeBackend backend;
    backend.dosed = [](std::uint64_t s) { return s < 130 ? 0 : s < 200 ? 2 : s < 300 ? 5 : 6; };
    Notebook notes;
    const RunResult r = play(smallCase(), backend, notes);
    Case c = smallCase();
    const std::string text = reportText(c, r, "fake");
    CHECK_THAT(text, Catch::Contains("    2      3.000          5.000            0.000           2.000\n"));
    CHECK_THAT(text, Catch::Contains("mean 2.000 g, standard deviation 1.000 g, RSD 50.0 % over 3 doses"));
    const std::string out = "dosed 6.000 g (6) + lost 0.000 g (0) = filled 10.000 g (10): closed";
    CHECK_THAT(text, Catch::Contains("ledger   inside 4.000 g (4) + " + out));
    c.canister.emplace();
    CHECK_THAT(reportText(c, r, "fake"),
               Catch::Contains("ledger   canister 4.000 g (4) + throat 0.000 g (0) + " + out));
    CHECK_THAT(text, Catch::Contains("the 3 doses asked for are done at t = 0.31 s"));
    CHECK_THAT(text, !Catch::Contains("note"));  // the mean is the closed form
}

TEST_CASE("where nothing was dosed the table at the end has no RSD") {
    FakeBackend backend;
    Notebook notes;
    const RunResult r = play(smallCase(), backend, notes);
    REQUIRE(r.statistics.doses == 3);
    REQUIRE(r.statistics.mean == 0);
    const std::string text = reportText(smallCase(), r, "fake");
    CHECK_THAT(text, Catch::Contains("no RSD: nothing was dosed over 3 doses") && !Catch::Contains("RSD 0"));
}
