// The drum of Dosta and others (2024). Their curves are not public as numbers; other programs that ran the same inputs
// (tools/bench-peers dosta) stand in for them, in dosta-drum-peers.csv beside the study.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "host/core/csv_table.h"
#include "host/core/error.h"
#include "host/output/frames.h"
#include "host/validate/comparisons.h"

namespace vkdose::validate {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The quadrants of the paper: beside the axis where the bed rises and above it, and on the other side and below it.
/// The drum turns clockwise, seen from +z.
enum Counted { M1Rise, M1Fall, M2Rise, M2Fall, kCounted };
constexpr std::array<const char*, kCounted> kColumns{"M1_rise", "M1_fall", "M2_rise", "M2_fall"};
constexpr std::array<const char*, kCounted> kNames{"M1 above on the rising side", "M1 below on the other side",
                                                   "M2 above on the rising side", "M2 below on the other side"};

/// The share of a powder's spheres in a quadrant, over time.
struct Shares {
    std::vector<double> time;
    std::array<std::vector<double>, kCounted> of;

    /// When the share first comes to a level after `from`, upwards or downwards; between the lines, NaN if never.
    double timeOf(Counted what, double level, bool upwards, double from) const {
        const std::vector<double>& share = of[what];
        for (std::size_t i = 1; i < time.size(); ++i) {
            const double before = share[i - 1] - level, now = share[i] - level;
            if (time[i] > from && (upwards ? before < 0 && now >= 0 : before > 0 && now <= 0))
                return time[i - 1] + (time[i] - time[i - 1]) * before / (before - now);
        }
        return kNone;
    }
    /// The largest share after `from`. NaN if the curve ends with it, since it may have gone on to grow.
    double most(Counted what, double from) const {
        double most = kNone;
        for (std::size_t i = 0; i < time.size(); ++i)
            if (time[i] > from) most = std::fmax(most, of[what][i]);
        return time.empty() || of[what].back() == most ? kNone : most;
    }
    double at(Counted what, double when) const {
        for (std::size_t i = 1; i < time.size(); ++i)
            if (time[i] >= when && time[i - 1] <= when)
                return of[what][i - 1] +
                       (of[what][i] - of[what][i - 1]) * (when - time[i - 1]) / (time[i] - time[i - 1]);
        return kNone;
    }
    Curve curve(Counted what, const std::string& name) const {
        Curve curve{name, {}, true, false};
        for (std::size_t i = 0; i < time.size(); ++i) curve.points.push_back({time[i], of[what][i], 0});
        return curve;
    }
};

Shares sharesOf(const Run& run) {
    Shares shares;
    const Frames frames(run.folder);
    for (const FrameEntry& entry : frames.entries()) {
        const Particles p = frames.read(entry).particles;
        std::array<double, kCounted> counts{};
        std::array<double, 2> all{};
        for (std::size_t i = 0; i < p.size(); ++i) {
            const std::size_t powder = p.material[i] == kFirstPowder ? 0 : 1;
            const Vec3& x = p.position[i];
            ++all[powder];
            if (x.x < 0 && x.y > 0) ++counts[2 * powder];
            if (x.x > 0 && x.y < 0) ++counts[2 * powder + 1];
        }
        shares.time.push_back(entry.time);
        for (std::size_t k = 0; k < kCounted; ++k) shares.of[k].push_back(counts[k] / all[k / 2]);
    }
    return shares;
}

/// What other programs found; empty if the file is not there.
std::map<std::string, Shares> peersOf(const std::filesystem::path& file) {
    std::map<std::string, Shares> peers;
    if (!std::filesystem::exists(file)) return peers;
    const Table table = Table::read(file, LastLine::Whole);
    for (std::size_t i = 0; i < table.rows(); ++i) {
        Shares& one = peers[table.text(i, "program")];
        one.time.push_back(table.number(i, "time_s"));
        for (std::size_t k = 0; k < kCounted; ++k) one.of[k].push_back(table.number(i, kColumns[k]));
    }
    return peers;
}

struct Mean {
    double value = kNone, error = 0;  ///< standard error; 0 of a single one
};
Mean meanOf(const std::vector<double>& values) {
    if (values.empty()) return {};
    const double count = static_cast<double>(values.size());
    double sum = 0, squares = 0;
    for (const double v : values) sum += v;
    for (const double v : values) squares += (v - sum / count) * (v - sum / count);
    return {sum / count, count > 1 ? std::sqrt(squares / (count - 1) / count) : 0};
}

/// The mean of the fillings, with its standard error, at the times of the first.
Curve meanCurve(const std::vector<Shares>& fillings, Counted what) {
    Curve curve{"vkdose", {}, true, false};
    for (const double time : fillings.front().time) {
        std::vector<double> shares;
        for (const Shares& one : fillings) shares.push_back(one.at(what, time));
        const Mean mean = meanOf(shares);
        curve.points.push_back({time, mean.value, mean.error});
    }
    return curve;
}

/// A figure of the curves, and by how much fillings and programs may differ in it.
struct Figure {
    std::string name, unit;
    double (*of)(const Shares&);
    double spread;  ///< of three fillings at reduced size, about: so far beyond the other programs it may be
};

/// M1 begins below on the falling side, goes round with the bed and comes back.
double goneHalf(const Shares& s) {
    return s.timeOf(M1Fall, 0.5, false, 0);
}
double backQuarter(const Shares& s) {
    return s.timeOf(M1Fall, 0.25, true, goneHalf(s));
}

const std::vector<Figure>& figures() {
    static const std::vector<Figure> kAll{
        {"half of M1 has left the quadrant below", "s", goneHalf, 0.02},
        {"a quarter of M1 is back below", "s", backQuarter, 0.08},
        {"of M1 below 0.3 s after that", "-", [](const Shares& s) { return s.at(M1Fall, backQuarter(s) + 0.3); }, 0.05},
        {"most of M1 above", "-", [](const Shares& s) { return s.most(M1Rise, goneHalf(s)); }, 0.04},
        {"most of M2 below", "-", [](const Shares& s) { return s.most(M2Fall, goneHalf(s)); }, 0.03},
        {"most of M2 above", "-", [](const Shares& s) { return s.most(M2Rise, goneHalf(s)); }, 0.02},
    };
    return kAll;
}

}  // namespace

Evaluation dostaDrum(const std::vector<Run>& runs, const std::filesystem::path& studies) {
    Evaluation result;
    if (runs.empty()) return result;
    const auto peers = peersOf(studies / "dosta-drum-peers.csv");
    std::vector<Shares> fillings;
    for (const Run& run : runs) fillings.push_back(sharesOf(run));
    for (const Figure& figure : figures()) {
        std::vector<double> ours;
        for (const Shares& one : fillings) ours.push_back(figure.of(one));
        const Mean mean = meanOf(ours);
        Finding finding{figure.name, figure.unit, mean.value, mean.error};
        const auto [least, most] = std::minmax_element(ours.begin(), ours.end());
        finding.source = "Dosta and others 2024";
        const std::string filled =
            ours.size() == 1 ? "one filling here"
                             : fmt::format("{} fillings here between {:.3g} and {:.3g}", ours.size(), *least, *most);
        finding.remark = fmt::format(
            "{}; {:.2g} beyond the other programs are allowed; "
            "three fillings of 1824 spheres differ by about as much, or less",
            filled, figure.spread);
        std::map<std::string, double> others;
        for (const auto& [program, theirs] : peers) others[program] = figure.of(theirs);
        holdAgainst(finding, others, 0, figure.spread);
        result.findings.push_back(finding);
    }
    for (std::size_t k = 0; k < kCounted; ++k) {
        const auto what = static_cast<Counted>(k);
        Chart chart{kNames[k], "", "time [s]", "share of its spheres", {meanCurve(fillings, what)}};
        for (const auto& [program, theirs] : peers) chart.curves.push_back(theirs.curve(what, program));
        result.charts.push_back(chart);
    }
    return result;
}

}  // namespace vkdose::validate
