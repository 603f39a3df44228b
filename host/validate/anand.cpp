// The rectangular hopper of Anand and others (2008): mass that has left over time. Their curve was read from their
// figure by the authors of Lethe, who publish its points (examples/dem/3d-rectangular-hopper); anand-curve.csv has
// these.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/csv_table.h"
#include "host/validate/comparisons.h"

namespace vkdose::validate {

namespace {

/// Mass that has left the hopper, over the time since it was opened.
struct Discharge {
    std::vector<double> time;  ///< [s]
    std::vector<double> mass;  ///< [g]

    /// When this mass is out, straight in between [s]; NaN if it never is.
    double timeOf(double out) const {
        const auto found = std::lower_bound(mass.begin(), mass.end(), out);
        if (found == mass.begin() || found == mass.end()) return std::nan("");
        const auto i = std::size_t(found - mass.begin());
        return time[i - 1] + (time[i] - time[i - 1]) * (out - mass[i - 1]) / (mass[i] - mass[i - 1]);
    }
    /// Between a fifth and three fifths of the powder [g/s].
    double rate() const {
        constexpr double kFrom = 20, kTo = 60;  // [g]
        return (kTo - kFrom) / (timeOf(kTo) - timeOf(kFrom));
    }
    Curve curve(const std::string& name, bool line) const {
        Curve curve{name, {}, line, !line};
        for (std::size_t i = 0; i < time.size(); ++i) curve.points.push_back({time[i], mass[i], 0});
        return curve;
    }
};

/// The gate opens then [s], as the case has it.
constexpr double kOpened = 1.0;
constexpr double kAllowed = 0.05;  // of a rate, beyond those of others
/// Of the same slice in Lethe, as its manual tells [g/s].
constexpr double kLethe = 91.73;

Discharge published(const std::filesystem::path& file) {
    const Table table = Table::read(file, LastLine::Whole);
    Discharge d;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        d.time.push_back(table.number(i, "time_s"));
        d.mass.push_back(table.number(i, "mass_g"));
    }
    return d;
}

Discharge ofRun(const Run& run) {
    const std::vector<double> time = run.series("time_s"), out = run.series("pan.mass_kg");
    Discharge d;
    for (std::size_t i = 0; i < time.size(); ++i) {
        if (time[i] < kOpened) continue;
        d.time.push_back(time[i] - kOpened);
        d.mass.push_back(1e3 * out[i]);
    }
    return d;
}

/// Beside one published value alone, which has no error.
Finding besideCurve(Finding finding, double expected) {
    finding.low = finding.high = expected;
    finding.source = "Anand and others 2008, read from their figure";
    notComparable(
        finding, "the slice of Lethe is faster than the published one, too; an input that is not published may differ");
    return finding;
}

}  // namespace

Evaluation anand(const std::vector<Run>& runs, const std::filesystem::path& studies) {
    const std::filesystem::path folder = studies.filename() == "full" ? studies.parent_path() : studies;
    const Discharge theirs = published(folder / "anand-curve.csv");
    Evaluation result;
    Chart chart{"Mass that has left the hopper", "", "time since it was opened [s]", "mass [g]", {}};
    std::vector<double> rates;
    std::vector<Discharge> ours;
    for (const Run& run : runs) {
        ours.push_back(ofRun(run));
        rates.push_back(ours.back().rate());
        chart.curves.push_back(ours.back().curve(fmt::format("vkdose, filling {}", ours.size()), true));
    }
    chart.curves.push_back(theirs.curve("published", false));
    Finding rate = meanOf("rate between 20 and 60 g", "g/s", rates);
    rate.remark = fmt::format("{:.0f} % beyond the two are allowed", 100 * kAllowed);
    holdAgainst(rate, {{"Anand and others 2008", theirs.rate()}, {"Lethe", kLethe}}, kAllowed, 0);
    result.findings.push_back(rate);
    for (const double out : {20.0, 40.0, 60.0, 80.0}) {
        std::vector<double> times;
        times.reserve(ours.size());
        for (const Discharge& d : ours) times.push_back(d.timeOf(out));
        result.findings.push_back(
            besideCurve(meanOf(fmt::format("time until {:.0f} g are out", out), "s", times), theirs.timeOf(out)));
    }
    result.charts.push_back(chart);
    return result;
}

}  // namespace vkdose::validate
