// The pages in a browser: they draw what they should, and without errors. Skipped, and said so, where there is none.
#include <iterator>
#include <regex>
#include <set>
#include <sstream>

#include "host/report/study_report.h"
#include "tests/report/browser.h"
#include "tests/report/folders.h"

using namespace vkdose;
using namespace vkdose::report;
using namespace vkdose::test;

namespace {

/// Widths of the charts, each once.
std::set<std::string> widths(const std::string& text) {
    const std::string mark = "viewBox=\"0 0 ";
    std::set<std::string> found;
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1)) {
        const std::size_t begin = at + mark.size();
        found.insert(text.substr(begin, text.find(' ', begin) - begin));
    }
    found.erase("22");  // the legends' swatches
    return found;
}

}  // namespace

TEST_CASE("a browser draws the page of a run") {
    if (browserMissing()) return;
    const Sandbox box;
    const auto balance = box.write("balance.csv", "dose,mass_g\n1,1.4\n2,1.9\n");
    const std::string dom = drawn(
        box, runJson(writeRun(box, "\"<img src=x onerror='document.documentElement.dataset.state=1'>\""), balance));
    CHECK(dom.find("data-state=\"ready\"") != std::string::npos);
    const std::string shown = dom.substr(dom.find("<main>"), dom.find("<footer>") - dom.find("<main>"));
    CHECK(count(dom, "<figure>") == 6);
    CHECK(count(dom, "class=\"band\"") == 6);  // torque, power, velocity: two rotations each
    CHECK(count(shown, "<circle") == 14);      // two charts: a legend and 3 doses, a legend and 2 of the balance
    CHECK(widths(shown).size() == 1);          // two columns, and the first charts were redrawn for them
    CHECK(dom.find("&lt;img src=x onerror=") != std::string::npos);  // as text
    CHECK(dom.find("<td class=\"number\">1.750</td>") != std::string::npos);
    CHECK(shown.find("NaN") == std::string::npos);  // none among the coordinates
}

TEST_CASE("a browser draws a table of the loads of each body in each dose") {
    if (browserMissing()) return;
    const Sandbox box;
    const auto folder = writeRun(box, "why");
    CHECK(drawn(box, runJson(folder, {})).find("<h3>Loads of") == std::string::npos);
    std::string header = kDosesHeader;
    header.pop_back();
    for (const char* load : {"force_x_N", "force_y_N", "force_z_N", "torque_Nm", "power_W", "work_J"})
        header += std::string(",screw-1.") + load;
    box.write(
        "run/doses.csv",
        header + "\n1,0.1,0.0015,0.0015,9,0.002,0.0016,1,0,nan,nan,nan,none,nan,0.25,0.5,0.75,0.00125,0.0625,0.1275\n");
    const std::string dom = drawn(box, runJson(folder, {}));
    const std::size_t at = dom.find("<h3>Loads of screw-1</h3>");
    REQUIRE(at != std::string::npos);
    const std::string table = dom.substr(at, dom.find("</table>", at) - at);
    for (const char* figure : {"0.25", "0.5", "0.75", "1.25", "62.5", "127.5"})
        CHECK(table.find(std::string("<td class=\"number\">") + figure + "</td>") != std::string::npos);
}

TEST_CASE("a browser draws the line of the closed form for a single dose too") {
    if (browserMissing()) return;
    const Sandbox box;
    const auto folder = writeRun(box, "why");
    box.write("run/doses.csv", dosesTable("1,0.1,0.0015,0.0015,9,0.002,0.0016,1\n"));
    const std::string dom = drawn(box, runJson(folder, {}));
    for (const char* title : {"<h3>Mass per dose", "<h3>Cumulative dosed mass"}) {
        CAPTURE(title);
        const std::size_t at = dom.find(title);
        REQUIRE(at != std::string::npos);
        const std::string figure = dom.substr(at, dom.find("</figure>", at) - at);
        CHECK(std::regex_search(figure, std::regex("<path d=\"M[^\"]*L[^\"]*\" stroke-dasharray=\"6 4\"")));
    }
}

TEST_CASE("a browser draws the closed form's cumulative mass as a sum, though the drive was ordered about in a dose") {
    if (browserMissing()) return;
    const Sandbox box;
    const auto folder = writeRun(box, "why");
    box.write("run/doses.csv", dosesTable("1,0.1,0.0015,0.0015,9,0.002,0.0004,1\n2,0.3,0.0015,0.003,9,0.002,0.0012,1\n"
                                          "3,0.5,0.0015,0.0045,9,0.002,0.0004,1\n"));
    const std::string dom = drawn(box, runJson(folder, {}));
    const std::size_t at = dom.find("<h3>Cumulative dosed mass");
    REQUIRE(at != std::string::npos);
    const std::string figure = dom.substr(at, dom.find("</figure>", at) - at);
    std::smatch path;
    REQUIRE(std::regex_search(figure, path, std::regex("<path d=\"M([^\"]*)\" stroke-dasharray=\"6 4\"")));
    std::vector<double> heights;  // downwards
    const std::string points = path[1];
    const std::regex point("([-0-9.e]+),([-0-9.e]+)");
    for (std::sregex_iterator p(points.begin(), points.end(), point), end; p != end; ++p)
        heights.push_back(std::stod((*p)[2]));
    REQUIRE(heights.size() == 5);
    CHECK(std::is_sorted(heights.rbegin(), heights.rend()));
    // Doses 2 and 3 are 1.2 g and 0.4 g.
    CHECK(std::abs((heights[1] - heights[2]) / (heights[2] - heights[3]) - 3) < 0.02);
}

TEST_CASE("a browser runs the page's own scripts and styles, and none that got into it") {
    if (browserMissing()) return;
    const Sandbox box;
    std::string html = page(runJson(writeRun(box, "why"), {}));
    const std::string evil = "document.documentElement.dataset.evil = 1";
    html.insert(html.rfind("</body>"), "<script>" + evil + "</script><img style='color: red' src='data:,' onerror='" +
                                           evil + "'><style>main { display: none }</style><base href='https://a.b/'>");
    const std::string dom = opened(box, html);
    CHECK(dom.find("data-state=\"ready\"") != std::string::npos);
    CHECK(dom.find("data-evil") == std::string::npos);
    const std::size_t at = dom.find("data-refused=\"");
    REQUIRE(at != std::string::npos);
    std::istringstream list(dom.substr(at + 14, dom.find('"', at + 14) - at - 14));
    const std::set<std::string> refused{std::istream_iterator<std::string>(list), {}};
    CHECK(refused == std::set<std::string>{"base-uri", "img-src", "script-src-attr", "script-src-elem",
                                           "style-src-attr", "style-src-elem"});
}

TEST_CASE("a browser draws the page of a run without doses") {
    if (browserMissing()) return;
    const Sandbox box;
    const auto folder = writeRun(box, "why");
    box.write("run/doses.csv", kDosesHeader);
    box.write("run/timeseries.csv", kSeriesHeader);
    CHECK(drawn(box, runJson(folder, {})).find("data-state=\"ready\"") != std::string::npos);

    // While it settles nothing is in the throat: no velocity, and no empty chart for it.
    const std::string rest = ",settle,0,0,0,0.006,0,0,0,36,0,0,0,0,nan,0,0,0.01\n";
    box.write("run/timeseries.csv", kSeriesHeader + ("0.1" + rest) + "0.2" + rest);
    // Nothing has turned either: what is left is where the powder is.
    CHECK(count(drawn(box, runJson(folder, {})), "<figure>") == 1);
}

TEST_CASE("a browser draws the page of a study") {
    if (browserMissing()) return;
    const Sandbox box;
    const auto table =
        box.write("expected.toml",
                  "[[expected]]\nid = \"S3\"\nwhat = \"falls\"\nsection = \"calibration\"\nkind = \"falls\"\n"
                  "quantity = \"beta_kg_per_dose\"\nalong = \"contact.kc_over_k\"\n");
    const std::string dom = drawn(box, studyJson(writeSweep(box), table));
    CHECK(dom.find("data-state=\"ready\"") != std::string::npos);
    CHECK(count(dom, "<figure>") == 7);  // beta by two axes, map, two of doses, emptying, RSD
    CHECK(count(dom, "class=\"cell\"") == 4);
    CHECK(count(dom, "class=\"contour\"") == 1);
    CHECK(dom.find("class=\"verdict holds\">trend holds") != std::string::npos);
    CHECK(dom.find("1 failed: particle 3 at (0, 0, 1) \"left\" the domain") != std::string::npos);
    CHECK(dom.find(">4.900</td>") != std::string::npos);
}

TEST_CASE("doses of a milligram keep their digits in the table of points") {
    if (browserMissing()) return;
    const Sandbox box;
    std::filesystem::create_directories(box / "sweep");
    box.write("sweep/members.csv",
              "member,seed,coil.turns,status,error,beta_kg_per_dose,beta_standard_error_kg_per_dose\n"
              "0,1,2,ok,,1.2345e-7,2.5e-9\n1,1,6,ok,,0.007,0.0001\n");
    const std::string dom = drawn(box, studyJson(box / "sweep", {}));
    for (const char* cell : {">0.000123</td>", ">0.0000025</td>", ">7.000</td>", ">0.100</td>"})
        CHECK(dom.find(cell) != std::string::npos);
}

TEST_CASE("keys that move together are drawn along the first of them, where its numbers tell the points apart") {
    if (browserMissing()) return;
    const Sandbox box;
    std::filesystem::create_directories(box / "sweep");
    box.write(
        "sweep/study.toml",
        "name = \"pairs\"\n[[axis]]\nkeys = [\"dose.rotate_s\", \"stop.max_doses\"]\nvalues = [[4, 2], [1, 8]]\n");
    const std::string head = "member,seed,dose.rotate_s,stop.max_doses,status,error,beta_kg_per_dose\n";
    box.write("sweep/members.csv", head + "0,1,4,2,ok,,0.008\n1,1,1,8,ok,,0.002\n");
    box.write("sweep/doses.csv",
              dosesTable("0,1,4,2,1,2,0.007,0.007,300,0.01,0.0084,1\n", "member,seed,dose.rotate_s,stop.max_doses,"));
    std::string dom = drawn(box, studyJson(box / "sweep", {}));
    CHECK(dom.find("<h3>β against dose.rotate_s</h3>") != std::string::npos);
    for (const char* text : {"2 at 1", "8 at 4", ">dose.rotate_s 4<"}) CHECK(dom.find(text) != std::string::npos);
    box.write("sweep/members.csv", head + "0,1,4,2,ok,,0.008\n1,1,4,8,ok,,0.002\n");
    dom = drawn(box, studyJson(box / "sweep", {}));
    CHECK(dom.find("<h3>β against dose.rotate_s, stop.max_doses</h3>") != std::string::npos);
}

TEST_CASE("where the doses of a point have no slope, its mean dose stands in the chart of beta") {
    if (browserMissing()) return;
    const Sandbox box;
    std::filesystem::create_directories(box / "sweep");
    const std::string head = "member,seed,coil.turns,status,error,mean_dose_kg,beta_kg_per_dose\n";
    const std::string legend = "mean dose, where there is no slope";
    box.write("sweep/members.csv", head + "0,1,2,ok,,0.012,\n1,1,6,ok,,0.006,0.007\n2,1,8,ok,,0.004,0.005\n");
    std::string dom = drawn(box, studyJson(box / "sweep", {}));
    CHECK(count(dom, "</svg>" + legend) == 1);
    CHECK(count(dom, "<title>" + legend) == 1);
    CHECK(dom.find("<title>" + legend + ": 12 at 2<") != std::string::npos);
    box.write("sweep/members.csv", head + "1,1,6,ok,,0.006,0.007\n2,1,8,ok,,0.004,0.005\n");
    dom = drawn(box, studyJson(box / "sweep", {}));
    CHECK(dom.find("β against coil.turns") != std::string::npos);
    CHECK(dom.find("</svg>" + legend) == std::string::npos);
}

TEST_CASE("a browser draws the page of a validation") {
    if (browserMissing()) return;
    const Sandbox box;
    const Json finding{
        {"figure", "C"},        {"expected", "0.55 to 0.65"}, {"got", 0.7},     {"error", 0.02}, {"unit", "-"},
        {"verdict", "differs"}, {"source", "a <b>book</b>"},  {"remark", "fit"}};
    const Json chart{{"title", "Rate over hole"},
                     {"note", ""},
                     {"x", "D"},
                     {"y", "W"},
                     {"curves",
                      {{{"name", "vkdose"}, {"line", false}, {"dots", true}, {"points", {{1, 2, 0.1}, {2, 3, 0.1}}}},
                       {{"name", "fit"}, {"line", true}, {"dots", false}, {"points", {{1, 2, 0}, {2, 3, 0}}}}}}};
    const Json made{{"name", "beverloo"}, {"what", "rate"},        {"source", ""},     {"cost", "4 runs"},
                    {"missing", ""},      {"findings", {finding}}, {"charts", {chart}}};
    const Json missing{{"name", "drum"},
                       {"what", "mixing"},
                       {"source", ""},
                       {"cost", ""},
                       {"missing", "no second powder"},
                       {"findings", Json::array()},
                       {"charts", Json::array()}};
    const std::string dom = drawn(
        box, {{"kind", "validation"}, {"name", "Validation"}, {"reason", "all"}, {"comparisons", {made, missing}}});
    CHECK(dom.find("data-state=\"ready\"") != std::string::npos);
    CHECK(count(dom, "<figure>") == 1);
    CHECK(dom.find("0.7 ± 0.02") != std::string::npos);
    CHECK(dom.find("a &lt;b&gt;book") != std::string::npos);
    CHECK(dom.find("Not made: no second powder") != std::string::npos);
}

TEST_CASE("a browser shows of a calibration its targets, and what each of them tells of each parameter") {
    if (browserMissing()) return;
    const Sandbox box;
    const auto folder = writeSweep(box);
    writeSearch(box);
    const std::string dom = drawn(box, studyJson(folder, {}));
    CHECK(dom.find("data-state=\"ready\"") != std::string::npos);
    const auto mainOf = [](const std::string& page) {
        return page.substr(page.find("<main>"), page.find("<footer>") - page.find("<main>"));
    };
    const std::string shown = mainOf(dom);
    CHECK(shown.find("met after 2 points") != std::string::npos);
    CHECK(shown.find("<td>heap.angle_deg</td><td>heap.toml</td><td class=\"number\">24 ± 0.5</td>"
                     "<td class=\"number\">24.25 ± 0.2</td><td class=\"number\">1</td>") != std::string::npos);
    CHECK(shown.find("<td class=\"number\">3 ± 0.05 g</td>") != std::string::npos);
    CHECK(shown.find("<td>contact.friction 0.2, contact.kc_over_k 0.5</td><td>heap.angle_deg</td>"
                     "<td class=\"number\">24 ± 0.5</td><td class=\"number\">20.4 ± 0.2</td><td>missed</td>") !=
          std::string::npos);
    CHECK(shown.find("<td class=\"number\">3.02 ± 0.03 g</td><td>met</td>") != std::string::npos);
    CHECK(shown.find("<td class=\"number\">-36</td><td class=\"number\">+8</td>"
                     "<td>mostly by heap.angle_deg</td>") != std::string::npos);
    CHECK(shown.find("<td class=\"number\">0.3125</td><td class=\"number\">0.25 to 0.375</td>") != std::string::npos);
    CHECK(shown.find("<td>heap.angle_deg</td><td class=\"number\">0.75</td><td class=\"number\">1.3</td>"
                     "<td class=\"number\">1.5</td><td class=\"number\">0.88</td><td></td>") != std::string::npos);
    CHECK(shown.find("surer than it may be") != std::string::npos);
    CHECK(shown.find("β is 3.5 ± 0.13 for 3 ± 0.05 g") != std::string::npos);
    CHECK(shown.find("<h3>contact.kc_over_k over contact.friction</h3>") != std::string::npos);
    CHECK(shown.find("values that fit: 0.75 at 0.3<") != std::string::npos);
    CHECK(shown.find("compensate") == std::string::npos);
    CHECK(shown.find("the targets do not constrain it within its bounds") != std::string::npos);
    CHECK(shown.find("<h3>heap.angle_deg against contact.friction</h3>") != std::string::npos);
    CHECK(shown.find("<h3>β against contact.kc_over_k</h3>") != std::string::npos);
    CHECK(shown.find("NaN") == std::string::npos);

    // Two that compensate have no interval of their own to be taken at its word.
    const Sandbox other;
    const auto both = writeSweep(other);
    writeSearch(other, true);
    const std::string ridge = mainOf(drawn(other, studyJson(both, {})));
    CHECK(ridge.find("<td>only together with contact.kc_over_k</td>") != std::string::npos);
    CHECK(ridge.find("contact.friction and contact.kc_over_k compensate (correlation -0.94)") != std::string::npos);
    CHECK(ridge.find("mostly by") == std::string::npos);

    // Of a grid there is the interpolation, and what the runs with new seeds made of it.
    CalibrationFinding grid = *readFinding(folder);
    grid.points.clear();
    grid.parameters.clear();
    grid.fit.reset();
    for (CalibrationFinding::Target& t : grid.targets) t.leaveOneOut = {};
    grid.confirmations.erase(grid.confirmations.begin() + 1);
    grid.met = false;
    writeFinding(folder, grid);
    const std::string missed = drawn(box, studyJson(folder, {}));
    CHECK(missed.find("data-state=\"ready\"") != std::string::npos);
    CHECK(missed.find("NOT met") != std::string::npos);
    CHECK(missed.find("interpolated at the chosen point") != std::string::npos);
    CHECK(mainOf(missed).find("NaN") == std::string::npos);  // the page's own code has the word

    forgetFinding(folder);
    const std::string going = drawn(box, studyJson(folder, {}));
    CHECK(going.find("The search has not ended") != std::string::npos);
    CHECK(going.find("<h3>β against contact.kc_over_k</h3>") == std::string::npos);  // its points lie on no lines
}

TEST_CASE("where points differ in the coil's turns a dose, a browser draws what is out over the turns") {
    if (browserMissing()) return;
    const Sandbox box;
    Json data = studyJson(writeSweep(box), {});
    for (Json& p : data["points"]) p["turns_per_dose"] = 3;
    const std::string title = "<h3>Dosed mass over turns of the coil";
    CHECK(drawn(box, data).find(title) == std::string::npos);
    data["points"][0]["dose_mass_kg"] = Json::parse("[[0.002, null, 1], [0.002, null, 1]]");
    data["points"][0]["cumulative_mass_kg"] = Json({0.002, 0.004});
    data["points"][0]["turns_per_dose"] = 1.5;
    data["points"][1]["dose_mass_kg"] = Json::parse("[[0.004, null, 1]]");
    data["points"][1]["cumulative_mass_kg"] = Json({0.004});
    const std::string dom = drawn(box, data);
    const std::size_t at = dom.find(title);
    REQUIRE(at != std::string::npos);
    const std::string figure = dom.substr(at, dom.find("</figure>", at) - at);
    // Two doses of 2 g in a turn and a half each, and one of 4 g in three: the same place.
    for (const char* tip : {"4 at 3", "2 at 1.5", "0 at 0"}) CHECK(figure.find(tip) != std::string::npos);
    CHECK(count(figure, "4 at 3") == 2);
}
