
#include "host/app/exit_code.h"
#include "tests/report/folders.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

TEST_CASE("report: a run's page goes into its folder, or where it is told to") {
    const Sandbox box;
    writeRun(box, "why");
    auto outcome = box.vkdose("report run");
    CHECK(outcome.code == kOk);
    CHECK(outcome.out == "run/report.html\n");
    CHECK_THAT(readText(box / "run/report.html"), Catch::Contains("<title>mini</title>"));
    outcome = box.vkdose("report run --out there.html");
    CHECK(outcome.code == kOk);
    CHECK(readText(box / "there.html") == readText(box / "run/report.html"));
}

TEST_CASE("report: a sweep by its folder or by its study") {
    const Sandbox box;
    writeSweep(box);
    CHECK(box.vkdose("report sweep --out a.html").code == kOk);
    CHECK_THAT(readText(box / "a.html"), Catch::Contains("k_c against friction"));
    std::filesystem::create_directories(box / "out");
    std::filesystem::rename(box / "sweep", box / "out/study");
    box.write("study.toml", readText(box / "out/study/study.toml"));
    CHECK(box.vkdose("report study.toml").out == "out/study/report.html\n");
}

TEST_CASE("report: what it is given beside the folder goes into the page") {
    const Sandbox box;
    writeRun(box, "why");
    writeSweep(box);
    box.write("balance.csv", "dose,mass_g\n1,1.25\n");
    CHECK(box.vkdose("report run --experiment balance.csv").code == kOk);
    CHECK_THAT(readText(box / "run/report.html"), Catch::Contains("\"mass_kg\":[0.00125]"));
    // The paper's rows, with ratios to k in place of k1, as the sweep's base has them.
    std::string rows = readText(VKDOSE_SOURCE_DIR "/cases/paper/expected.toml");
    for (const auto& [ofK1, ofK] : {std::pair{"= 0.1746", "= 0.873"}, std::pair{"= 0.0572", "= 0.286"}})
        for (std::size_t at = rows.find(ofK1); at != rows.npos; at = rows.find(ofK1, at))
            rows.replace(at, std::string(ofK1).size(), ofK);
    box.write("expected.toml", rows);
    CHECK(box.vkdose("report sweep --expected expected.toml").code == kOk);
    const std::string page = readText(box / "sweep/report.html");
    // The sweep's members carry the paper's calibrated point and both trends; nothing of them has 80 g.
    CHECK_THAT(page, Catch::Contains("\"id\":\"S1\"") && Catch::Contains("\"verdict\":\"matches\""));
    CHECK_THAT(page, Catch::Contains("\"verdict\":\"trend holds\"") && Catch::Contains("\"verdict\":\"not run\""));
}

TEST_CASE("report: of a run with frames the page has the player, and the surface beside a photograph") {
    const Sandbox box;
    const std::string run = "run " VKDOSE_SOURCE_DIR "/cases/mini.toml --backend reference --quiet --out run";
    REQUIRE(box.vkdose(run + " --set frames.interval_s=0.05 --set stop.end_time_s=0.2").code == kOk);
    box.write("photo.csv", "z_mm,height_mm\n0.5,10\n15.5,12\n");
    REQUIRE(box.vkdose("report run --profile photo.csv@0 --profile photo.csv@1").code == kOk);
    const std::string page = readText(box / "run/report.html");
    const std::size_t frames = readCsv(box / "run/frames/frames.csv").size() - 1;
    CHECK(frames >= 5);
    CHECK_THAT(page, Catch::Contains(fmt::format("\"stored\":{},\"every\":1", frames)));
    CHECK_THAT(page, Catch::Contains("THREE={}") && Catch::Contains("Particles drawn with three.js"));
    CHECK_THAT(page, Catch::Contains("The above copyright notice and this permission notice"));  // three's licence
    CHECK_THAT(page, Catch::Contains("{\"name\":\"photo.csv\",\"dose\":0,\"z_m\":[0.0005,0.0155]"));
    const auto refused = box.vkdose("report run --profile photo.csv@2");
    CHECK(refused.code == kBadInput);
    CHECK_THAT(refused.err, Catch::Contains("the run kept no state of this dose; give one of 0, 1"));

    writeRun(box, "without", "bare");
    REQUIRE(box.vkdose("report bare").code == kOk);
    CHECK_THAT(readText(box / "bare/report.html"), !Catch::Contains("three.js"));
}

TEST_CASE("report: several runs go into one page, in the current folder or where it is told to") {
    const Sandbox box;
    writeRun(box, "one", "a");
    writeRun(box, "two", "my b");
    writeSweep(box);
    auto outcome = box.vkdose("report a 'my b'");
    CHECK(outcome.code == kOk);
    CHECK(outcome.out == "comparison.html\n");
    CHECK_THAT(readText(box / "comparison.html"), Catch::Contains("<title>a, my b</title>"));
    CHECK(box.vkdose("report a 'my b' --out there.html").code == kOk);
    CHECK(readText(box / "there.html") == readText(box / "comparison.html"));
    std::filesystem::remove(box / "comparison.html");
    for (const char* bad : {"a a/", "a sweep", "a nowhere", "a 'my b' --experiment x.csv"}) {
        CAPTURE(bad);
        CHECK(box.vkdose(std::string("report ") + bad).code == kBadInput);
    }
    CHECK(box.vkdose("report a 'my b' --out a/doses.csv").code == kBadInput);
    CHECK_FALSE(std::filesystem::exists(box / "comparison.html"));
}

TEST_CASE("report: what cannot be reported on is refused, and nothing is written") {
    const Sandbox box;
    writeRun(box, "why");
    writeSweep(box);
    std::filesystem::create_directories(box / "empty");
    box.write("lonely.toml", "");
    const auto refused = [&](const std::string& arguments, const std::string& why) {
        const auto outcome = box.vkdose("report " + arguments);
        CHECK(outcome.code == kBadInput);
        CHECK_THAT(outcome.err, Catch::Contains(why));
    };
    refused("nowhere", "there is no folder nowhere");
    refused("empty", "holds neither a run (case.toml) nor a sweep (members.csv)");
    refused("lonely.toml", "there is no folder out/lonely");
    refused("sweep --experiment b.csv", "--experiment belongs to the report of a run");
    refused("sweep --profile p.csv", "--profile belongs to the report of a run");
    refused("run --profile p.csv@x", "give FILE.csv or FILE.csv@DOSE");
    refused("run --expected e.toml", "--expected belongs to the report of a sweep");
    refused("run --experiment b.csv", "b.csv: there is no such file");
    box.write("run/doses.csv", "dose,mass_kg\n1\n");
    refused("run", "doses.csv:2");
    CHECK_FALSE(std::filesystem::exists(box / "run/report.html"));
    CHECK_FALSE(std::filesystem::exists(box / "sweep/report.html"));
}

TEST_CASE("report: a page that cannot be written is an error of the output") {
    const Sandbox box;
    writeRun(box, "why");
    CHECK(box.vkdose("report run --out /nowhere/at/all.html").code == kOutputError);
}
