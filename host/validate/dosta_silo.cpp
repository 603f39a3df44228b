// The silo of Dosta and others (2024). Their curves are not public as numbers; other programs that ran the same inputs
// (tools/bench-peers dosta) stand in for them, in dosta-silo-peers.csv beside the study.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>
#include <map>

#include "host/core/csv_table.h"
#include "host/validate/comparisons.h"

namespace vkdose::validate {

namespace {

/// Share of the spheres that is left, over time.
struct Emptying {
    std::vector<double> time, left;

    /// When no more than this share is left, between the lines; NaN if it never comes to that.
    double timeOf(double share) const {
        for (std::size_t i = 1; i < time.size(); ++i)
            if (left[i] <= share && left[i - 1] > share)
                return time[i - 1] + (time[i] - time[i - 1]) * (left[i - 1] - share) / (left[i - 1] - left[i]);
        return std::numeric_limits<double>::quiet_NaN();
    }
    Curve curve(const std::string& name) const {
        Curve curve{name, {}, true, false};
        for (std::size_t i = 0; i < time.size(); ++i) curve.points.push_back({time[i], left[i], 0});
        return curve;
    }
};

struct Setup {
    std::string material;
    double hole;  ///< diameter [mm]

    auto operator<=>(const Setup&) const = default;
    std::string name() const { return fmt::format("{}, hole of {:.0f} mm", material, hole); }
};

constexpr double kSpread = 0.05;

/// The figure is the time from one share left to another. The first is not 1, so that the way in which the gate opens
/// does not count. A silo that does not come to the last one is timed to the one before: at full size a hole of 40 mm
/// lets only a third of the spheres through in 5 s.
constexpr double kFirst = 0.9, kHigh = 0.7, kLow = 0.4;

/// What other programs found, by setup and by program; empty if the file is not there.
std::map<Setup, std::map<std::string, Emptying>> peersOf(const std::filesystem::path& file) {
    std::map<Setup, std::map<std::string, Emptying>> peers;
    if (!std::filesystem::exists(file)) return peers;
    const Table table = Table::read(file, LastLine::Whole);
    for (std::size_t i = 0; i < table.rows(); ++i) {
        Emptying& one = peers[{table.text(i, "material"), table.number(i, "hole_mm")}][table.text(i, "program")];
        one.time.push_back(table.number(i, "time_s"));
        one.left.push_back(table.number(i, "left"));
    }
    return peers;
}

Emptying emptyingOf(const Run& run) {
    Emptying found{run.series("time_s"), run.series("pan.mass_kg")};
    const double filled = run.figure("/inputs/filled_mass_kg");
    for (double& left : found.left) left = std::max(0.0, 1 - left / filled);  // rounding may leave less than nothing
    return found;
}

}  // namespace

Evaluation dostaSilo(const std::vector<Run>& runs, const std::filesystem::path& studies) {
    const auto peers = peersOf(studies / "dosta-silo-peers.csv");
    Evaluation result;
    for (const Run& run : runs) {
        const Setup setup{run.value("particles.density") > 2250 ? "M1" : "M2", 2 * run.value("body.cone.radius_mm")};
        const Emptying ours = emptyingOf(run);
        Chart chart{"Spheres left, " + setup.name(), "", "time [s]", "share of all", {ours.curve("vkdose")}};
        const double last = std::isfinite(ours.timeOf(kLow)) ? kLow : kHigh;
        const auto middle = [&](const Emptying& e) { return e.timeOf(last) - e.timeOf(kFirst); };
        Finding finding{fmt::format("from {:.0f} to {:.0f} % left, {}", 100 * kFirst, 100 * last, setup.name()), "s",
                        middle(ours)};
        finding.source = "Dosta and others 2024";
        finding.remark =
            "5 % beyond the other programs are allowed; three fillings of 2005 spheres in vkdose differ by 4 %";
        std::map<std::string, double> others;
        if (const auto found = peers.find(setup); found != peers.end())
            for (const auto& [program, theirs] : found->second) {
                others[program] = middle(theirs);
                chart.curves.push_back(theirs.curve(program));
            }
        holdAgainst(finding, others, kSpread, 0);
        result.findings.push_back(finding);
        result.charts.push_back(chart);
    }
    return result;
}

}  // namespace vkdose::validate
