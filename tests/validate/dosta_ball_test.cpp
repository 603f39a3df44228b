// The penetrating ball, from runs that are made up so that the answer is known.

#include <fmt/format.h>

#include <cmath>

#include "host/validate/comparisons.h"
#include "tests/support/catch.h"
#include "tests/support/folder.h"

using namespace vkdose;
using namespace vkdose::validate;

namespace {

/// A ball that is let go at 1 m/s, meets the bed at 0.1 s and comes to rest `depth` [m] deep as exp(-t/10 ms).
std::string fallRows(const std::string& before, double depth, double shift, int last = 110) {
    std::string rows;
    for (int i = 0; i <= last; ++i) {
        const double t = 0.002 * i, since = t - 0.1;
        const double y = since < 0 ? 0.05 - 1.0 * since : 0.05 - depth * (1 - std::exp(-since / 0.01));
        const double v = t < 0.01 ? 0 : since < 0 ? -1 : since == 0 ? -1.01 : -depth / 0.01 * std::exp(-since / 0.01);
        rows += fmt::format("{}{:.6f},{:.9f},{:.9f}\n", before, t + shift, y, std::max(v, -1.01));
    }
    return rows;
}

}  // namespace

TEST_CASE("a ball in a bed is judged by the programs that ran the same inputs, and by none without them") {
    const test::Folder folder;
    Run run;
    run.folder = folder.path();
    run.summary["inputs"]["particles"] = 5000;
    folder.write("timeseries.csv", "time_s,ball.y_m,ball.velocity_y_m_s\n" + fallRows("", 0.01, 0));
    const double depth = 10 * (1 - std::exp(-12.0));  // at the end of the table
    const Evaluation alone = dostaBall({run}, folder.path());
    REQUIRE(alone.findings.size() == 2);
    CHECK(alone.findings[0].got == Approx(depth).epsilon(1e-6));
    CHECK(alone.findings[1].got == Approx(-10 * std::log(1 - 0.9 * depth / 10)).epsilon(0.01));
    for (const Finding& f : alone.findings) CHECK(f.verdict() == Verdict::NotComparable);

    const auto peers = [&](double theirs) {
        folder.write("dosta-ball-peers.csv", "program,speed_m_per_s,spheres,time_s,y_m,velocity_y_m_s\n" +
                                                 fallRows("A,1,5000,", theirs, 0.3) + fallRows("B,2,5000,", 1, 0) +
                                                 fallRows("B,1,2500,", 1, 0));
        return dostaBall({run}, folder.path());
    };
    const Evaluation beside = peers(0.0104);
    for (const Finding& f : beside.findings) CHECK(f.verdict() == Verdict::Agrees);
    CHECK(beside.charts.at(0).curves.size() == 2);
    CHECK(beside.charts[0].curves[0].points.at(0)[0] == 0);
    CHECK(peers(0.012).findings[0].verdict() == Verdict::Differs);
}

TEST_CASE("a ball that still sinks when its curve ends has no largest depth") {
    const test::Folder folder;
    Run run;
    run.folder = folder.path();
    run.summary["inputs"]["particles"] = 5000;
    folder.write("timeseries.csv", "time_s,ball.y_m,ball.velocity_y_m_s\n" + fallRows("", 0.01, 0, 60));
    for (const Finding& f : dostaBall({run}, folder.path()).findings) CHECK(std::isnan(f.got));
}
