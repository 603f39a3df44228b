// A turn of an endless screw: how its mass rate follows speed, fill and slope, as P. J. Owen and P. W. Cleary (2009)
// found in a slice that repeats, and what a fuller one conveys beside the theory of A. W. Roberts (1999). Theirs are
// other screws with other powders, so the trends are judged.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "host/analysis/discharge.h"
#include "host/core/line_fit.h"
#include "host/validate/comparisons.h"

namespace vkdose::validate {

namespace {

// As the case has them.
constexpr double kRadius = 15e-3, kShaft = 4e-3, kPitch = 28e-3;  ///< of the screw [m]
constexpr double kFriction = 0.4;                                 ///< of the spheres on its blade
constexpr double kFilled = 0.7;  ///< when the last powder is in and goes with the rest [s]
constexpr double kFrom = 1;      ///< when the powder of a long screw has settled [s]
constexpr double kSlow = 120;    ///< speeds up to it are for the trend of the speed [rpm]
constexpr double kFuller = 11;   ///< one with more is held against the theory of a full one [g]

constexpr double kAllowedBeside = 0.03;  ///< of the rate of a turn that repeats, for that of a long screw

/// The rate at a point of the study.
struct ScrewPoint {
    double fill = 0;   ///< [g]
    double speed = 0;  ///< [rpm], positive
    double slope = 0;  ///< of the screw, upwards [degrees]
    double rate = 0;   ///< along the screw, upwards [g/s]
    double error = 0;  ///< standard error
};

/// What has gone along a screw over time.
std::vector<DischargeSample> conveyed(const Run& run, bool repeats) {
    const std::vector<double> time = run.series("time_s"), mass = run.series(repeats ? "through_z_kg" : "end.mass_kg");
    std::vector<DischargeSample> samples;
    for (std::size_t i = 0; i < time.size(); ++i) samples.push_back({time[i], mass[i]});
    return samples;
}

/// The points, each the mean over its seeds.
std::vector<ScrewPoint> pointsOf(const std::vector<Run>& runs) {
    std::map<std::array<double, 3>, std::vector<const Run*>> at;
    for (const Run& run : runs) {
        const Vec3 gravity = run.vector("gravity");
        at[{std::round(1e4 * run.figure("/ledger/filled_mass_kg")) / 10,
            std::abs(run.value("body.screw.motion.speed_rpm")),
            std::round(std::atan2(-gravity.z, -gravity.y) * 180 / kPi) + 0.0}]
            .push_back(&run);
    }
    std::vector<ScrewPoint> points;
    for (const auto& [key, of] : at) {
        ScrewPoint p{key[0], key[1], key[2]};
        const auto n = static_cast<double>(of.size());
        for (const Run* run : of) {
            constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
            const auto rate = dischargeOf(conveyed(*run, true), kFilled, std::numeric_limits<double>::infinity());
            p.rate += 1e3 * (rate ? rate->rate : kNone) / n;
            p.error = std::hypot(p.error, 1e3 * (rate ? rate->error : kNone) / n);
        }
        points.push_back(p);
    }
    return points;
}

/// Points of one kind, in the order of `of`.
std::vector<ScrewPoint> chosen(std::vector<ScrewPoint> points, bool (*which)(const ScrewPoint&),
                               double ScrewPoint::*of) {
    std::erase_if(points, [&](const ScrewPoint& p) { return !which(p); });
    std::stable_sort(points.begin(), points.end(),
                     [&](const ScrewPoint& a, const ScrewPoint& b) { return a.*of < b.*of; });
    return points;
}

/// The exponent of the speed in the rate of a level screw, from all of its points, and its standard error by their own.
Finding exponentOfSpeed(const std::vector<ScrewPoint>& points) {
    LineFit fit;
    double mean = 0;
    for (const ScrewPoint& p : points) {
        fit.add(std::log(p.speed), std::log(p.rate));
        mean += std::log(p.speed) / static_cast<double>(points.size());
    }
    double spread = 0, noise = 0;
    for (const ScrewPoint& p : points) {
        const double off = std::log(p.speed) - mean;
        spread += off * off;
        noise += std::pow(off * p.error / p.rate, 2);
    }
    Finding finding{"exponent of the speed, level", "-", fit.slope(), std::sqrt(noise) / spread, 0.95, 1.05};
    finding.source = "the rate is in proportion to the speed";
    finding.remark = fmt::format("{} speeds up to {:.0f} rpm", points.size(), kSlow);
    return finding;
}

/// The least step of the rate from a point to the next, which tells whether it only grows, or only falls. NaN if a rate
/// is not known.
Finding leastStep(const std::string& figure, const std::vector<ScrewPoint>& points, bool grows) {
    Finding finding{figure, "g/s"};
    finding.wanted = grows ? Wanted::Positive : Wanted::Negative;
    finding.source = "Owen and Cleary 2009";
    finding.remark = "the sign is judged";
    if (points.size() < 2) notComparable(finding, "fewer than two points");
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double step = points[i].rate - points[i - 1].rate;
        if (i > 1 && (std::isnan(finding.got) || (grows ? step >= finding.got : step <= finding.got))) continue;
        finding.got = step;
        finding.error = std::hypot(points[i].error, points[i - 1].error);
    }
    return finding;
}

/// What a level screw conveys over its pitch in a turn, beside Roberts' theory of a full one: the powder goes with the
/// screw by as much as the friction of its blade makes it, and the casing holds it back. Then it moves at right angles
/// to the blade, less the angle of friction, so that tan(l)/(tan(a) + tan(l)) of the pitch is left, with a the angle of
/// the blade at the mean radius and l = 90 degrees - a - the angle of friction.
Finding efficiency(const ScrewPoint& p) {
    const double radius = (kRadius + kShaft) / 2, blade = std::atan(kPitch / (2 * kPi * radius));
    const double way = std::tan(kPi / 2 - blade - std::atan(kFriction));
    Finding finding{"way along the fuller screw in a turn", "pitches", p.rate / (p.fill * p.speed / 60),
                    p.error / (p.fill * p.speed / 60)};
    finding.low = finding.high = way / (std::tan(blade) + way);
    finding.source = "theory of Roberts 1999";
    notComparable(finding,
                  "the screw is seven tenths full, and the theory is of a full one in which the powder has no weight");
    return finding;
}

Curve curveOf(const std::string& name, const std::vector<ScrewPoint>& points, double ScrewPoint::*over) {
    Curve curve{name, {}, true, true};
    for (const ScrewPoint& p : points) curve.points.push_back({p.*over, p.rate, p.error});
    return curve;
}

}  // namespace

Evaluation screw(const std::vector<Run>& runs, const std::filesystem::path&) {
    const std::vector<ScrewPoint> points = pointsOf(runs);
    Evaluation result;
    const auto slow = chosen(
        points, [](const ScrewPoint& p) { return p.speed <= kSlow && p.fill < kFuller; }, &ScrewPoint::speed);
    result.findings.push_back(exponentOfSpeed(slow));
    result.charts.push_back({"Mass rate of a level screw",
                             "Bars: standard error.",
                             "speed [rpm]",
                             "rate [g/s]",
                             {curveOf("vkdose", slow, &ScrewPoint::speed)}});

    const auto fast = chosen(
        points, [](const ScrewPoint& p) { return p.speed > kSlow; }, &ScrewPoint::slope);
    std::map<double, std::vector<ScrewPoint>> byFill, bySlope;
    for (const ScrewPoint& p : fast) {
        byFill[p.fill].push_back(p);
        bySlope[p.slope].push_back(p);
    }
    Chart slopes{"Mass rate over slope", "Bars: standard error.", "slope [degrees]", "rate [g/s]", {}};
    for (const auto& [fill, of] : byFill) {
        result.findings.push_back(leastStep(fmt::format("least step over slope, {:.0f} g in a turn", fill), of, false));
        slopes.curves.push_back(curveOf(fmt::format("{:.0f} g in a turn", fill), of, &ScrewPoint::slope));
    }
    for (const auto& [slope, of] : bySlope)
        result.findings.push_back(leastStep(fmt::format("least step over fill, slope of {:.0f} degrees", slope),
                                            chosen(
                                                of, [](const ScrewPoint&) { return true; }, &ScrewPoint::fill),
                                            true));
    result.charts.push_back(slopes);
    for (const ScrewPoint& p : points)
        if (p.fill >= kFuller && p.speed <= kSlow) result.findings.push_back(efficiency(p));
    return result;
}

Evaluation longScrew(const std::vector<Run>& runs, const std::filesystem::path&) {
    Evaluation result;
    Chart chart{"Mass along the screw", "", "time [s]", "mass [g]", {}};
    std::vector<double> ofTurn, ofLong;
    double error = 0;
    for (const Run& run : runs) {
        const bool repeats = run.at.at("domain.periodic") == "z";
        const std::vector<DischargeSample> samples = conveyed(run, repeats);
        Curve curve{repeats ? "a turn that repeats" : "five turns with an end", {}, true, false};
        for (const DischargeSample& s : samples) curve.points.push_back({s.time, 1e3 * s.mass, 0});
        chart.curves.push_back(curve);
        const auto rate = dischargeOf(samples, kFrom, std::numeric_limits<double>::infinity());
        if (!rate) continue;
        (repeats ? ofTurn : ofLong).push_back(1e3 * rate->rate);
        if (!repeats) error = 1e3 * rate->error;
    }
    Finding finding = meanOf("rate of five turns with an end", "g/s", ofLong);
    if (ofLong.size() == 1) finding.error = error;
    finding.remark = fmt::format("from {:.0f} s on; {:.0f} % beyond are allowed", kFrom, 100 * kAllowedBeside);
    holdAgainst(finding, {{"a turn that repeats", meanOf("", "", ofTurn).got}}, kAllowedBeside, 0);
    result.findings = {finding};
    result.charts = {chart};
    return result;
}

}  // namespace vkdose::validate
