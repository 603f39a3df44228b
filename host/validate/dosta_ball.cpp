// The penetrating ball of Dosta and others (2024). Their curves are not public as numbers; other programs that ran the
// same inputs (tools/bench-peers dosta-ball) stand in for them, in dosta-ball-peers.csv beside the study.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "host/core/csv_table.h"
#include "host/validate/comparisons.h"

namespace vkdose::validate {

namespace {

/// The height of the ball over time, and its speed upwards.
struct Fall {
    std::vector<double> time, height, speed;

    /// When it meets the bed: it is fastest downwards.
    std::size_t meets() const { return std::size_t(std::min_element(speed.begin(), speed.end()) - speed.begin()); }
    double depth(std::size_t i) const { return height[meets()] - height[i]; }
    /// The largest depth of the first part of the curve, up to this share of its time since it met the bed.
    double depthWithin(double share) const {
        const double end = time[meets()] + share * (time.back() - time[meets()]);
        double most = 0;
        for (std::size_t i = meets(); i < time.size() && time[i] <= end; ++i) most = std::max(most, depth(i));
        return most;
    }
    /// NaN if it still sinks when the curve ends: by a hundredth in the last tenth of the time.
    double largestDepth() const {
        if (time.empty() || depthWithin(1) > 1.01 * depthWithin(0.9)) return std::numeric_limits<double>::quiet_NaN();
        return depthWithin(1);
    }
    /// How long it takes to this share of its largest depth; NaN if it has none, or meets no bed.
    double timeTo(double share) const {
        const double depth = share * largestDepth();
        for (std::size_t i = time.empty() ? 0 : meets() + 1; i < time.size(); ++i) {
            const double before = this->depth(i - 1), now = this->depth(i);
            if (now >= depth && now > before)
                return time[i - 1] - time[meets()] + (time[i] - time[i - 1]) * (depth - before) / (now - before);
        }
        return std::numeric_limits<double>::quiet_NaN();
    }
    Curve curve(const std::string& name) const {
        Curve curve{name, {}, true, false};
        for (std::size_t i = time.empty() ? 0 : meets(); i < time.size(); ++i)
            curve.points.push_back({1e3 * (time[i] - time[meets()]), 1e3 * depth(i), 0});
        return curve;
    }
};

struct Setup {
    std::string speed;  ///< at which the ball is let go, to two digits [m/s]
    int spheres = 0;

    bool operator<(const Setup& other) const { return std::tie(speed, spheres) < std::tie(other.speed, other.spheres); }
    std::string name() const { return fmt::format("{} m/s, {} spheres", speed, spheres); }
};

std::string twoDigits(double x) {
    return fmt::format("{:.2g}", x);
}

/// What may be beyond the other programs, of a figure.
constexpr double kSpread = 0.05;

/// What other programs found, by setup and by program; empty if the file is not there.
std::map<Setup, std::map<std::string, Fall>> peersOf(const std::filesystem::path& file) {
    std::map<Setup, std::map<std::string, Fall>> peers;
    if (!std::filesystem::exists(file)) return peers;
    const Table table = Table::read(file, LastLine::Whole);
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const Setup setup{twoDigits(table.number(i, "speed_m_per_s")), int(table.number(i, "spheres"))};
        Fall& one = peers[setup][table.text(i, "program")];
        one.time.push_back(table.number(i, "time_s"));
        one.height.push_back(table.number(i, "y_m"));
        one.speed.push_back(table.number(i, "velocity_y_m_s"));
    }
    return peers;
}

Setup setupOf(const Run& run, const Fall& fall) {
    const auto moves = std::find_if(fall.speed.begin(), fall.speed.end(), [](double v) { return v != 0; });
    return {moves == fall.speed.end() ? "no" : twoDigits(-*moves), int(run.figure("/inputs/particles"))};
}

/// A figure of one setup beside that of the other programs.
Finding judged(const std::string& what, const char* unit, double scale, const Fall& ours,
               const std::map<std::string, Fall>* others, double (*figure)(const Fall&)) {
    Finding finding{what, unit, scale * figure(ours)};
    finding.source = "Dosta and others 2024";
    finding.remark =
        "5 % beyond the other programs are allowed; three fillings of 5000 spheres in vkdose differ by 5 %";
    std::map<std::string, double> values;
    if (others != nullptr)
        for (const auto& [program, theirs] : *others) values[program] = scale * figure(theirs);
    holdAgainst(finding, values, kSpread, 0);
    return finding;
}

}  // namespace

Evaluation dostaBall(const std::vector<Run>& runs, const std::filesystem::path& studies) {
    const auto peers = peersOf(studies / "dosta-ball-peers.csv");
    Evaluation result;
    for (const Run& run : runs) {
        const Fall ours{run.series("time_s"), run.series("ball.y_m"), run.series("ball.velocity_y_m_s")};
        const Setup setup = setupOf(run, ours);
        const auto found = peers.find(setup);
        const auto* others = found == peers.end() ? nullptr : &found->second;
        result.findings.push_back(judged("largest depth, " + setup.name(), "mm", 1e3, ours, others,
                                         [](const Fall& f) { return f.largestDepth(); }));
        result.findings.push_back(judged("to 90 % of it, " + setup.name(), "ms", 1e3, ours, others,
                                         [](const Fall& f) { return f.timeTo(0.9); }));
        Chart chart{"Depth of the ball, " + setup.name(), "", "time [ms]", "depth [mm]", {ours.curve("vkdose")}};
        if (others != nullptr)
            for (const auto& [program, theirs] : *others) chart.curves.push_back(theirs.curve(program));
        result.charts.push_back(chart);
    }
    return result;
}

}  // namespace vkdose::validate
