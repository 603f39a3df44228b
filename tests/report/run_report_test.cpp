#include "host/report/run_report.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "host/core/error.h"
#include "host/report/page.h"
#include "host/report/run_figures.h"
#include "host/report/source_hash.h"
#include "tests/report/faults.h"
#include "tests/report/folders.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::report;
using vkdose::test::faultOf;
using vkdose::test::kDosesHeader;
using vkdose::test::readCsv;
using vkdose::test::readText;
using vkdose::test::Sandbox;
using vkdose::test::writeRun;

namespace {

/// The data that a page carries.
Json embedded(const std::string& html) {
    const std::string mark = "id=\"data\">";
    const std::size_t begin = html.find(mark) + mark.size();
    return Json::parse(html.substr(begin, html.find("</script>", begin) - begin));
}

std::string fact(const Json& run, const std::string& name, const char* part = "value") {
    for (const Json& f : run["facts"])
        if (f["name"] == name) return f[part];
    return "no such fact";
}

}  // namespace

TEST_CASE("doses without one of their columns are refused by its name") {
    const Sandbox box;
    const auto folder = writeRun(box, "why");
    std::string doses = readText(folder / "doses.csv");
    const std::string name = "closed_form_mass_kg";
    doses.replace(doses.find(name), name.size(), "closed_form_mass_g");
    box.write("run/doses.csv", doses);
    CHECK_THAT(faultOf([&] { runJson(folder, {}); }),
               Catch::Contains("doses.csv:1") && Catch::Contains("lacks the column closed_form_mass_kg"));
}

TEST_CASE("the page of a run carries the numbers of its doses.csv, to the last digit") {
    const Sandbox box;
    const Json data = embedded(page(runJson(writeRun(box, "why"), {})));
    const auto rows = readCsv(box / "run/doses.csv");
    for (std::size_t column = 0; column < rows[0].size(); ++column) {
        const Json& values = data["doses"][rows[0][column]];
        REQUIRE(values.size() == rows.size() - 1);
        for (std::size_t i = 1; i < rows.size(); ++i) {
            const Json& value = values[i - 1];
            const std::string& text = rows[i][column];
            CAPTURE(rows[0][column], text);
            if (value.is_number())
                CHECK(value.get<double>() == std::stod(text));
            else
                CHECK(value == (text == "nan" ? Json() : Json(text)));
        }
    }
    CHECK(data["doses"]["mass_kg"][3] == 0.000123456789);
    CHECK(data["reason"] == "why");
}

TEST_CASE("curves and turning times of a run") {
    const Sandbox box;
    const Json data = runJson(writeRun(box, "why"), {});
    CHECK(data["series"]["coil_torque_Nm"] == Json({0.0, 0.002, 0.001, 0.002, 0.001}));
    CHECK(data["series"]["outlet_velocity_m_s"][0].is_null());
    CHECK(data["rotations"] == Json({{0.1, 0.3}, {0.4, 0.6}}));
    CHECK(data["filled_mass_kg"] == 0.006);
}

TEST_CASE("the mass rate of a run in windows, its steady part marked") {
    const Sandbox box;
    const auto folder = writeRun(box, "rate");
    CHECK(fact(runJson(folder, {}), "mass rate") == "no such fact");  // less than five windows
    // Ten turns of half a second: nothing, then 1 g a turn, and a tenth more or less in turn.
    std::string series = vkdose::test::kSeriesHeader;
    double dosed = 0;
    for (int i = 1; i <= 100; ++i) {
        dosed += i <= 10 ? 0 : (i - 1) / 10 % 2 == 0 ? 0.11e-3 : 0.09e-3;
        series += fmt::format("{},rotate,1,0,{},0.01,0,0,0,0,0,0,0,0,0,0,0,0\n", i * 0.05, dosed);
    }
    box.write("run/timeseries.csv", series);
    const Json data = runJson(folder, {});
    CHECK(data["rate"]["window_s"] == 0.5);
    REQUIRE(data["rate"]["kg_s"].size() == 10);
    CHECK(data["rate"]["kg_s"][0] == 0);
    CHECK(data["rate"]["kg_s"][1].get<double>() == Approx(1.8e-3));
    CHECK(data["rate"]["time_s"][1].get<double>() == Approx(0.75));
    CHECK(data["rate"]["steady"] == 1);
    CHECK(data["rate"]["steady_kg_s"].get<double>() == Approx((5 * 1.8e-3 + 4 * 2.2e-3) / 9));
    CHECK(fact(data, "mass rate").find("1.780 g/s ± ") == 0);
    CHECK_THAT(fact(data, "mass rate", "note"), Catch::Contains("over 10 windows of 0.5 s"));
    CHECK(fact(data, "steady mass rate").find("1.978 g/s ± ") == 0);
    CHECK_THAT(fact(data, "steady mass rate", "note"), Catch::Contains("RSD 11 %, from t = 0.5 s"));

    // A device that doses again and again is told by its doses; one that goes on, by its rate.
    const auto places = [](const Json& run) {
        std::vector<std::string> names;
        for (const Json& f : run["facts"]) names.push_back(f["name"]);
        const auto at = [&](const char* name) { return std::find(names.begin(), names.end(), name) - names.begin(); };
        return std::pair(at("steady mass rate"), at("mass per dose"));
    };
    CHECK(data["rate_leads"] == false);
    CHECK(places(data).first > places(data).second);
    box.write("run/doses.csv", vkdose::test::dosesTable("1,0.1,0.0015,0.0015,9,0.002,0.0016,1\n"));
    const Json once = runJson(folder, {});
    CHECK(once["rate_leads"] == true);
    CHECK(places(once).first < places(once).second);
    // Nothing turned in it.
    CHECK(fact(once, "outlet stopped for more than a turn") == "no such fact");
    CHECK_THAT(fact(once, "first powder"), Catch::Contains("s of dosing until something came"));

    // One plug in all that time is no flow.
    series = vkdose::test::kSeriesHeader;
    for (int i = 1; i <= 100; ++i)
        series += fmt::format("{},rotate,1,0,{},0.01,0,0,0,0,0,0,0,0,0,0,0,0\n", i * 0.05, i > 85 ? 1e-3 : 0);
    box.write("run/timeseries.csv", series);
    CHECK(runJson(folder, {})["rate_leads"] == false);
}

TEST_CASE("the mass of each turn of the drive beside what was left, its steady part marked") {
    const Sandbox box;
    const auto folder = writeRun(box, "cycles");
    CHECK(runJson(folder, {})["cycles"]["mass_kg"].size() == 1);
    CHECK_FALSE(runJson(folder, {})["cycles"]["steady"].is_number());
    // Ten turns of half a second: nothing, then 1 g and a tenth more or less in turn, from 20 g.
    std::string series = vkdose::test::kSeriesHeader;
    double dosed = 0;
    for (int i = 1; i <= 100; ++i) {
        dosed += i <= 10 ? 0 : (i - 1) / 10 % 2 == 0 ? 0.11e-3 : 0.09e-3;
        series += fmt::format("{},rotate,1,{},{},{},0,0,0,0,0,0,0,0,0,0,0,0\n", i * 0.05, -i * 0.2 * std::acos(-1.0),
                              dosed, 0.02 - dosed);
    }
    box.write("run/timeseries.csv", series);
    const Json data = runJson(folder, {}), cycles = data["cycles"];
    CHECK(cycles["is"] == "turn of the drive");
    REQUIRE(cycles["mass_kg"].size() == 10);
    CHECK(cycles["mass_kg"][0] == 0);
    CHECK(cycles["mass_kg"][1].get<double>() == Approx(0.9e-3));
    CHECK(cycles["mass_kg"][2].get<double>() == Approx(1.1e-3));
    CHECK(cycles["left_kg"][1].get<double>() == Approx(20e-3));
    CHECK(cycles["left_kg"][2].get<double>() == Approx(19.1e-3));
    CHECK(cycles["time_s"][1].get<double>() == Approx(0.75));
    CHECK(cycles["steady"] == 1);
    CHECK(cycles["steady_kg"].get<double>() == Approx((5 * 0.9e-3 + 4 * 1.1e-3) / 9));
    CHECK(fact(data, "mass of a turn of the drive").find("0.890 g ± ") == 0);
    CHECK_THAT(fact(data, "mass of a turn of the drive", "note"), Catch::Contains("over 10 cycles"));
    CHECK_THAT(fact(data, "steady mass of a turn of the drive", "note"), Catch::Contains("RSD 11 %, from t = 0.5 s"));
}

TEST_CASE("a long time series is thinned: means of torques, last values of masses") {
    const Sandbox box;
    const auto folder = writeRun(box, "long");
    std::string series = vkdose::test::kSeriesHeader;
    for (int i = 1; i <= 10000; ++i)
        series += fmt::format("{},rotate,1,{},{},{},0,0,0,0,0,0,0,0,{},{},0,0\n", i, i, i, 10000 - i,
                              i % 2 == 0 ? "nan" : "0.5", i % 2 == 0 ? 3 : 1);
    box.write("run/timeseries.csv", series);
    const Json data = runJson(folder, {});
    CHECK(data["series"]["time_s"].size() == 5000);
    CHECK(data["series"]["time_s"][1] == 4);
    CHECK(data["series"]["dosed_mass_kg"][1] == 4);
    CHECK(data["series"]["coil_torque_Nm"][1] == 2);
    CHECK(data["series"]["outlet_velocity_m_s"][1] == 0.5);  // of the one line that has any
    CHECK(data["rotations"] == Json({{0, 10000}}));
}

TEST_CASE("the figures of a run, by hand") {
    const Sandbox box;
    const Json data = runJson(writeRun(box, "why"), {});
    CHECK(fact(data, "complete doses") == "3");
    // 1.5 and 3.5 g are below 80 % of 6 g (4.8 g): the slope of two points, which has no error.
    CHECK(fact(data, "β") == "2.000 g/dose");
    CHECK_THAT(fact(data, "β", "note"), Catch::Contains("2 doses with less than 4.8 g"));
    CHECK(fact(data, "blocked") == "no");
    CHECK(fact(data, "mass per turn of the coil") == "3.5 g");       // 3.5 g in one turn
    CHECK(fact(data, "work of the drive") == "12.57 mJ");            // 2 mN m over 2 pi
    CHECK(fact(data, "outlet velocity while dosing") == "15 mm/s");  // of 12 and 18; that at rest left out
    // Something came out in every line in which the coil turned; the first of them ends 0.2 s after it began to.
    CHECK(fact(data, "longest stop of the outlet while dosing") == "none");
    CHECK(fact(data, "outlet stopped for more than a turn") == "never");
    CHECK_THAT(fact(data, "outlet stopped for more than a turn", "note"), Catch::Contains("0.2 s"));
    CHECK(data["doses"]["longest_stop_s"] == Json({0, 0, 0, 0}));
    CHECK(data["doses"]["arch_m"] == Json({nullptr, nullptr, nullptr, nullptr}));
    CHECK(fact(data, "state") == "still running, or ended without a summary");
    CHECK(fact(data, "arch over the coil, at the end") == "no such fact");
}

TEST_CASE("the end state adds densities and arches, the summary how it ended") {
    const Sandbox box;
    const auto folder = writeRun(box, "why");
    box.write("run/particles.csv",
              "id,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s,wx_rad_s,wy_rad_s,wz_rad_s,radius_m,status\n"
              "0,0,0,0.01,0,0,0,0,0,0,0.001,active\n1,0,0,0.01,0,0,0,0,0,0,0.001,dosed\n");
    const Particles end = endParticles(folder / "particles.csv", Case());
    CHECK(end.status == std::vector<Status>{Status::Active, Status::Dosed});
    CHECK(end.position[0] == Vec3(0, 0, 0.01));
    box.write("run/summary.json", R"({"stop_sentence": "the 3 doses asked for are done", "error": "it broke"})");
    const Json data = runJson(folder, {});
    CHECK(fact(data, "ended") == "the 3 doses asked for are done");
    CHECK(fact(data, "error") == "it broke");
    CHECK_THAT(fact(data, "arch over the coil, at the end"), !Catch::Contains("no such fact"));
    box.write("run/summary.json", R"({"arches": [{"dose": 1, "height_m": 0.0}, {"dose": 2, "height_m": 0.012}]})");
    const Json arched = runJson(folder, {});
    CHECK(fact(arched, "arches over the coil, at the doses' ends") == "1 of 2");
    CHECK(fact(arched, "pull-off over weight, settled") == "no such fact");
    CHECK(fact(arched, "arches over the coil, at the doses' ends", "note") == "the highest 12 mm");
    box.write("run/summary.json", R"({"settled": {"bulk_density_kg_m3": 512.3, "overlap_ratio": {"p10": null},
        "pull_off_over_weight": {"p10": 20.0, "median": 300.0, "p90": 4500.0}}})");
    const Json settled = runJson(folder, {});
    CHECK(fact(settled, "bulk density of the bed, settled") == "512.3 kg/m³");
    CHECK(fact(settled, "pull-off over weight, settled") == "300, 80 % from 20 to 4.5e+03");
    CHECK(fact(settled, "overlap over radius, settled") == "no such fact");
    CHECK(arched["doses"]["arch_m"] == Json({0.0, 0.012, nullptr, nullptr}));
    // An interrupted run that was resumed and goes on: neither its summary nor its end state hold any more.
    box.write("run/summary.json", R"({"stop_sentence": "interrupted", "simulated_time_s": 0.6})");
    CHECK_THAT(fact(runJson(folder, {}), "state"), Catch::Contains("still running"));
    CHECK(fact(runJson(folder, {}), "arch over the coil, at the end") == "no such fact");
    box.write("run/summary.json", R"({"stop_sentence": "interrupted", "simulated_time_s": 0.69999999995})");
    CHECK(fact(runJson(folder, {}), "ended") == "interrupted");
    box.write("run/summary.json", "{");
    CHECK_THROWS_AS(runJson(folder, {}), CaseError);
}

TEST_CASE("a balance's readings, as masses of doses or added up") {
    const Sandbox box;
    const Json single = experimentJson(box.write("b.csv", "dose,mass_g\n1,3\n2,4\n3,5"));
    CHECK(single["cumulative_mass_kg"] == Json({0.003, 0.007, 0.012}));
    const Json sums = experimentJson(box.write("c.csv", "dose,cumulative_g\n1,3\n2,7\n"));
    CHECK(sums["mass_kg"] == Json({0.003, 0.004}));
    CHECK_THROWS_AS(experimentJson(box.write("d.csv", "dose,weight\n1,3\n")), CaseError);
}

TEST_CASE("whatever stands in a case is text on the page, not markup") {
    const Sandbox box;
    const std::string evil = "\"</script><script>alert(1)</script> & <b>bold</b> @@scripts@@\"";
    std::filesystem::create_directories(box / "run");
    const std::string html = page(runJson(writeRun(box, evil), {}));
    CHECK(html.find("<script>alert") == std::string::npos);
    CHECK(html.find("<b>bold") == std::string::npos);
    CHECK(embedded(html)["reason"] == "</script><script>alert(1)</script> & <b>bold</b> @@scripts@@");
    const std::string titled = page({{"name", "<i>&</i>"}});
    CHECK(titled.find("<title>&lt;i&gt;&amp;&lt;/i&gt;</title>") != std::string::npos);
    CHECK_NOTHROW(page({{"name", "\xff not UTF-8"}}));
}

TEST_CASE("the page's policy knows its own scripts and style, and lets nothing else take effect") {
    // The example of FIPS 180-2.
    CHECK(sourceHash("abc") == "'sha256-ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0='");
    const Sandbox box;
    Json data = runJson(writeRun(box, "why"), {});
    for (const bool player : {false, true}) {
        data["player"] = player ? Json::object() : Json(nullptr);
        const std::string html = page(data);
        const std::string mark = "Content-Security-Policy\" content=\"";
        const std::size_t begin = html.find(mark) + mark.size();
        REQUIRE(begin > mark.size());
        const std::string policy = html.substr(begin, html.find('"', begin) - begin);
        CHECK_THAT(policy, Catch::StartsWith("default-src 'none'; ") && !Catch::Contains("unsafe") &&
                               Catch::EndsWith("; base-uri 'none'; form-action 'none'"));
        std::size_t found = 0;
        for (const std::string element : {"script", "style"})
            for (std::size_t at = html.find("<" + element + ">"); at != std::string::npos;
                 at = html.find("<" + element + ">", at + 1)) {
                const std::size_t from = at + element.size() + 2;
                const std::string text = html.substr(from, html.find("</" + element + ">", from) - from);
                CHECK_THAT(policy, Catch::Contains(sourceHash(text)));
                ++found;
            }
        CHECK(found == (player ? 5 : 3));
    }
}

TEST_CASE("the page asks for nothing from elsewhere, and may not") {
    const Sandbox box;
    const std::string html = page(runJson(writeRun(box, "why"), {}));
    CHECK(html.find("default-src 'none'") < html.find("<style>"));
    for (const char* reference : {" src=", " href=", "@import", "url(http", "XMLHttpRequest(\"", "fetch("})
        CHECK(html.find(reference) == std::string::npos);
    CHECK(html.find("@@") == html.rfind("@@") - 0);                           // no mark was left over
    CHECK(html.find("Redistributions of source code") != std::string::npos);  // D3's licence goes along
}

TEST_CASE("what fell out while settling is no work of the coil") {
    const Sandbox box;
    const auto folder = writeRun(box, "why");
    const std::string before = readText(folder / "timeseries.csv");
    const std::string settled = "0.1,settle,0,0,0,";
    REQUIRE(before.find(settled) != std::string::npos);
    std::string spilled = before;
    spilled.replace(spilled.find(settled), settled.size(), "0.1,settle,0,0,0.0005,");
    box.write("run/timeseries.csv", spilled);
    CHECK(fact(runJson(folder, {}), "mass per turn of the coil") == "3 g");  // 3.5 g less 0.5 g, in one turn
}

TEST_CASE("the stop rules of a report are those of the case") {
    const Sandbox box;
    const Json data = runJson(writeRun(box, "why"), {});
    CHECK_THAT(fact(data, "experiment's stop rule", "note"), Catch::Contains("at most 0.02 g"));  // mini's
    CHECK_THAT(fact(data, "blocked", "note"), Catch::Contains("at most 0.02 g"));
}

TEST_CASE("of doses to a mass the closed form is the mean for the turns that they made") {
    const Sandbox box;
    const auto folder = writeRun(box, "why");
    CHECK(fact(runJson(folder, {}), "closed form") == "1.600 g/dose");
    box.write("run/doses.csv", kDosesHeader +
                                   "1,0.1,0.002,0.002,9,0.002,0.009,1,0.002,0.002,0,1,mass,0.4\n"
                                   "2,0.4,0.002,0.004,12,0.002,0.003,1,0.002,0.002,0,0.4,mass,0.7\n");
    const Case c = loadCase(VKDOSE_SOURCE_DIR "/cases/mini.toml", {"dose.mass_g=0.2", "dose.max_rotate_s=2"});
    box.write("run/case.toml", c.resolved);
    const Json data = runJson(folder, {});
    CHECK(fact(data, "closed form") == "6.000 g/dose");
    CHECK_THAT(fact(data, "closed form", "note"), Catch::Contains("for the turns that the doses made"));
}

TEST_CASE("where nothing was dosed there is no RSD") {
    const Sandbox box;
    const auto folder = writeRun(box, "why");
    CHECK_THAT(fact(runJson(folder, {}), "mass per dose", "note"), Catch::StartsWith("RSD "));
    box.write("run/doses.csv", dosesTable("1,0.1,0,0,0,0.002,0.0016,1\n2,0.4,0,0,0,0.002,0.0016,1\n"));
    CHECK(fact(runJson(folder, {}), "mass per dose", "note") == "no RSD: nothing was dosed");
}

TEST_CASE("what another run had dosed is not told as a spill of this one") {
    const Sandbox box;
    const auto folder = writeRun(box, "why");
    const std::string settling =
        R"("settling": {"time_s": 0.3, "speed_m_s": 0, "fall_speed_m_s": 1, "spilled_kg": 0.002, "at_rest": true}})";
    box.write("run/summary.json", "{" + settling);
    CHECK(fact(runJson(folder, {}), "fallen out while settling") == "2.000 g");
    box.write("run/summary.json", R"({"from": "the end of a, at t = 0.3 s", )" + settling);
    CHECK(fact(runJson(folder, {}), "fallen out while settling") == "no such fact");
    CHECK(fact(runJson(folder, {}), "left before this run's first dose") == "2.000 g");
}
