// A layer of frictional spheres that a belt shears steadily under a load: shear stress over pressure and the share of
// the volume that spheres fill, over the inertial number I = shear rate * diameter * sqrt(density / pressure).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "host/analysis/steady.h"
#include "host/core/csv_table.h"
#include "host/core/line_fit.h"
#include "host/validate/comparisons.h"

namespace vkdose::validate {

namespace {

// As the case has them.
constexpr double kMeanDiameter = 1e-3;        ///< mean [m]
constexpr double kSphereDensity = 2500;       ///< of the spheres [kg/m3]
constexpr double kLow = 6e-3, kHigh = 14e-3;  ///< the middle of the layer, far from belt and lid [m]

constexpr double kAllowedRatio = 0.05;     ///< of a ratio of stresses
constexpr double kSlowInertial = 0.02;     ///< below it the ratio is that of slow flow, nearly
constexpr double kSlowRatio = 0.382;       ///< published for spheres of this friction, 0.5
constexpr double kAllowedFraction = 0.01;  ///< of a share of the volume

/// The flow at one speed of the belt.
struct Flow {
    double inertial = 0;
    double ratio = 0, ratioError = 0;  ///< shear stress over pressure
    double fraction = 0;               ///< of the volume
};

/// Of the middle of the layer, over the second half of the run.
Flow flowOf(const Run& run) {
    const Table profile = Table::read(run.folder / "fields" / "profile.csv", LastLine::Whole);
    const std::size_t rows = profile.rows();
    const double half = rows == 0 ? 0 : profile.number(rows - 1, "time_s") / 2;
    LineFit velocity;
    double shear = 0, pressure = 0, fraction = 0, points = 0;
    std::map<double, std::pair<double, double>> at;  ///< sums of shear stress and pressure at a time
    for (std::size_t i = 0; i < rows; ++i) {
        const double y = profile.number(i, "y_m"), time = profile.number(i, "time_s");
        if (time <= half || y < kLow || y > kHigh) continue;
        const auto stress = [&](const char* kind, const char* part) {
            return profile.number(i, fmt::format("{}_stress_{}_Pa", kind, part));
        };
        const double s = -(stress("contact", "xy") + stress("contact", "yx")) / 2 - stress("kinetic", "xy");
        double p = 0;
        for (const char* part : {"xx", "yy", "zz"}) p += (stress("contact", part) + stress("kinetic", part)) / 3;
        velocity.add(y, profile.number(i, "velocity_x_m_s"));
        fraction += profile.number(i, "volume_fraction");
        shear += s;
        pressure += p;
        at[time].first += s;
        at[time].second += p;
        points += 1;
    }
    std::vector<double> ratios;
    for (const auto& [time, sums] : at) ratios.push_back(sums.first / sums.second);
    return {std::abs(velocity.slope()) * kMeanDiameter * std::sqrt(kSphereDensity * points / pressure),
            std::abs(shear / pressure), seriesFigures(ratios).error, fraction / points};
}

/// What another program found, by its inertial numbers.
struct Peer {
    std::vector<double> inertial, ratio, fraction;

    /// Between two of them, straight over the logarithm of I; NaN beyond the first and the last.
    double at(const std::vector<double>& values, double i) const {
        const auto above = std::lower_bound(inertial.begin(), inertial.end(), i);
        if (above == inertial.begin() || above == inertial.end()) return std::numeric_limits<double>::quiet_NaN();
        const auto k = std::size_t(above - inertial.begin());
        const double way = std::log(i / inertial[k - 1]) / std::log(inertial[k] / inertial[k - 1]);
        return values[k - 1] + way * (values[k] - values[k - 1]);
    }
};

/// The rows of a program have growing inertial numbers.
std::map<std::string, Peer> programsIn(const std::filesystem::path& file) {
    std::map<std::string, Peer> peers;
    if (!std::filesystem::exists(file)) return peers;
    const Table table = Table::read(file, LastLine::Whole);
    for (std::size_t i = 0; i < table.rows(); ++i) {
        Peer& one = peers[table.text(i, "program")];
        one.inertial.push_back(table.number(i, "inertial_number"));
        one.ratio.push_back(table.number(i, "stress_ratio"));
        one.fraction.push_back(table.number(i, "volume_fraction"));
    }
    return peers;
}

/// The law that fits flows of glass beads: mu_s + (mu_2 - mu_s) / (I_0/I + 1).
double beads(double inertial) {
    return 0.38 + (0.64 - 0.38) / (0.279 / inertial + 1);
}

}  // namespace

Evaluation planeShear(const std::vector<Run>& runs, const std::filesystem::path& studies) {
    const std::map<std::string, Peer> peers = programsIn(studies / "plane-shear-peers.csv");
    Evaluation result;
    Chart ratios{
        "Shear stress over pressure", "Bars: standard error.", "inertial number", "shear stress / pressure", {}};
    Chart fractions{"Share of the volume", "", "inertial number", "volume fraction", {}};
    Curve ours{"vkdose", {}, false, true}, filled = ours, law{"glass beads, Jop and others 2006", {}, true, false};
    for (const Run& run : runs) {
        const Flow flow = flowOf(run);
        std::map<std::string, double> theirRatio, theirFraction;
        for (const auto& [program, peer] : peers) {
            theirRatio[program] = peer.at(peer.ratio, flow.inertial);
            theirFraction[program] = peer.at(peer.fraction, flow.inertial);
        }
        Finding ratio{fmt::format("stress ratio at I = {:.2g}", flow.inertial), "-", flow.ratio, flow.ratioError};
        ratio.remark = fmt::format("{:.0f} % beyond are allowed", 100 * kAllowedRatio);
        Finding beside = ratio, slow = ratio;
        holdAgainst(ratio, theirRatio, kAllowedRatio, 0);
        Finding fraction{fmt::format("volume fraction at I = {:.2g}", flow.inertial), "-", flow.fraction};
        fraction.remark = fmt::format("{:.0f} % beyond is allowed", 100 * kAllowedFraction);
        holdAgainst(fraction, theirFraction, kAllowedFraction, 0);
        beside.figure += ", as of beads";
        holdAgainst(beside, {{"P. Jop, Y. Forterre, O. Pouliquen 2006", beads(flow.inertial)}}, kAllowedRatio, 0);
        result.findings.insert(result.findings.end(), {ratio, beside, fraction});
        if (flow.inertial < kSlowInertial) {
            slow.figure = "stress ratio of slow flow";
            holdAgainst(slow, {{"S. Chialvo, J. Sun, S. Sundaresan 2012", kSlowRatio}}, kAllowedRatio, 0);
            result.findings.push_back(slow);
        }
        ours.points.push_back({flow.inertial, flow.ratio, flow.ratioError});
        law.points.push_back({flow.inertial, beads(flow.inertial), 0});
        filled.points.push_back({flow.inertial, flow.fraction, 0});
    }
    ratios.curves = {ours, law};
    fractions.curves = {filled};
    for (const auto& [program, peer] : peers) {
        Curve stress{program, {}, true, true}, volume = stress;
        for (std::size_t i = 0; i < peer.inertial.size(); ++i) {
            stress.points.push_back({peer.inertial[i], peer.ratio[i], 0});
            volume.points.push_back({peer.inertial[i], peer.fraction[i], 0});
        }
        ratios.curves.push_back(stress);
        fractions.curves.push_back(volume);
    }
    result.charts = {ratios, fractions};
    return result;
}

}  // namespace vkdose::validate
