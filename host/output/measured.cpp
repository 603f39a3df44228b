#include "host/output/measured.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "host/analysis/compression.h"
#include "host/analysis/discharge.h"
#include "host/analysis/drum.h"
#include "host/analysis/heap.h"
#include "host/analysis/shear.h"
#include "host/core/csv_table.h"
#include "host/core/key.h"
#include "host/model/powders.h"
#include "host/output/figure_words.h"
#include "host/output/frames.h"
#include "host/sim/density.h"

namespace vkdose {

namespace {

using Figures = std::vector<MeasuredFigure>;

double degrees(double radians) {
    return radians * kDegree.perSI;
}

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The values of a list of figures, in its order.
template <std::size_t n>
Figures named(const Wording (&figures)[n], const double (&values)[n]) {
    Figures all;
    for (std::size_t i = 0; i < n; ++i) all.push_back({figures[i].name, values[i]});
    return all;
}

struct Mean {
    double value = 0;
    double deviation = kNone;  ///< of the sample; NaN of a single value
};

Mean meanOf(const std::vector<double>& values) {
    const double count = static_cast<double>(values.size());
    double mean = values.front();  // of which rounding makes no deviation, if all are equal
    for (const double v : values) mean += (v - values.front()) / count;
    double squares = 0;
    for (const double v : values) squares += (v - mean) * (v - mean);
    return {mean, values.size() > 1 ? std::sqrt(squares / (count - 1)) : kNone};
}

class Measuring {
  public:
    Measuring(const std::filesystem::path& folder, const Case& c, const RunResult& result)
        : c_(c),
          result_(result),
          up_(-glm::normalize(c.world.gravity)),
          frames_(folder),
          series_(Table::salvage(folder / "timeseries.csv")) {}

    MeasureResult of(const ElementTest& m) const {
        MeasureResult r;
        r.name = m.name;
        r.kind = wordsOf(ElementTest::kKinds).at(std::size_t(m.kind));
        r.figures = figuresOf(m, r.why);
        return r;
    }

  private:
    struct State {
        Particles particles;
        double time = 0;
        BodyPoses bodies;
    };

    State stateAt(const std::optional<double>& time) const {
        if (!time || frames_.entries().empty())
            return {result_.particles, result_.last.time,
                    bodyPoses(c_.world, result_.last.time, result_.last.coilAngle, result_.bodiesMoved)};
        const FrameEntry& entry = frames_.entries()[nearestOf(frames_.entries(), *time)];
        const Frame frame = frames_.read(entry);
        return {frame.particles, entry.time, bodyPoses(c_.world, frame.time, frame.coilAngle, frame.bodiesMoved)};
    }

    Figures figuresOf(const ElementTest& m, std::string& why) const {
        switch (m.kind) {
            case ElementTest::Kind::AngleOfRepose:
                return heap(m, why);
            case ElementTest::Kind::DrumAngle:
                return drum(m, why);
            case ElementTest::Kind::Compression:
                return compression(m, why);
            case ElementTest::Kind::Shear:
                return shear(m, why);
            case ElementTest::Kind::BulkDensity:
                return bulk(m, why);
            case ElementTest::Kind::Discharge:
                return discharge(m, why);
            case ElementTest::Kind::Content:
                return content(m, why);
        }
        return {};
    }

    Figures heap(const ElementTest& m, std::string& why) const {
        const State state = stateAt(m.time);
        const Particles powder = upright(state.particles, m.at, up_);
        const auto slope = m.view == ElementTest::View::Side ? heapSlopeFromSide(powder) : heapSlope(powder);
        if (!slope) {
            why = "the powder makes no heap with a flank of three diameters about its axis";
            return {};
        }
        return named(kHeap,
                     {degrees(slope->angle), degrees(slope->error), slope->height, slope->from, slope->to, state.time});
    }

    Figures bulk(const ElementTest& m, std::string& why) const {
        const State state = stateAt(m.time);
        const auto bulk =
            containerDensity(c_.world, upright(state.particles, m.at, up_), m.radius, upright(state.bodies, m.at, up_));
        if (!bulk) {
            why = "a mean diameter away from wall, floor and surface there is room for fewer than a hundred spheres";
            return {};
        }
        return named(kBulk, {bulk->density, bulk->solid / bulk->volume, bulk->volume, state.time});
    }

    /// The frames of the first window.
    std::vector<FrameEntry> framesIn(const ElementTest& m) const {
        std::vector<FrameEntry> found;
        for (const FrameEntry& entry : frames_.entries())
            if (entry.time >= m.windows.at(0).from && entry.time <= m.windows.at(0).to) found.push_back(entry);
        return found;
    }

    /// The powder of a frame, as it stands in the drum.
    Particles inDrumOf(const ElementTest& m, const FrameEntry& entry) const {
        const RigidBody& body = c_.world.bodies.at(m.bodies.at(0));
        const auto& turn = std::get<geometry::Turn>(body.course.motion);
        // By the drive a body turns as the coil conveys, which may be either way about its axis.
        const bool back = body.clock == Clock::Drive ? turn.rate * senseOfDrive() < 0 : turn.rate < 0;
        return inDrum(frames_.read(entry).particles, turn.through, back ? -turn.axis : turn.axis, up_);
    }

    static std::string whyNoFront(const ElementTest& m, const DrumFront& front, double diameter) {
        const double window = m.halfWidth * 1e3;
        if (front.photographs() == 0) return "no frame is in its time";
        if (2 * m.halfWidth <= DrumFront::kLeastDiameters * diameter)
            return fmt::format("a window from {:.4g} to {:.4g} mm is no wider than {:.0f} mean diameters, of {:.4g} mm",
                               -window, window, DrumFront::kLeastDiameters, diameter * 1e3);
        return fmt::format("the bed does not reach from {:.4g} to {:.4g} mm: {} of {} columns of pixels show none",
                           -window, window, front.emptyColumns(), front.columns());
    }

    Figures drumFront(const ElementTest& m, std::string& why) const {
        const std::vector<FrameEntry> entries = framesIn(m);
        const double diameter = 2 * meanActiveRadius(result_.particles);
        DrumFront front(m.halfWidth, diameter, static_cast<int>(entries.size()));
        for (const FrameEntry& entry : entries) front.add(inDrumOf(m, entry));
        const auto seen = front.angle();
        if (!seen) {
            why = whyNoFront(m, front, diameter);
            return {};
        }
        return named(kDrumFront, {degrees(seen->angle), degrees(seen->error), static_cast<double>(entries.size())});
    }

    Figures drum(const ElementTest& m, std::string& why) const {
        if (m.view == ElementTest::View::Front) return drumFront(m, why);
        std::vector<double> angles;
        for (const FrameEntry& entry : framesIn(m))
            if (const auto angle = drumAngle(inDrumOf(m, entry))) angles.push_back(degrees(*angle));
        if (angles.empty()) {
            why = "no frame in its time shows a bed ten diameters wide with a free surface";
            return {};
        }
        const Mean mean = meanOf(angles);
        return named(kDrum, {mean.value, mean.deviation, static_cast<double>(angles.size())});
    }

    Figures discharge(const ElementTest& m, std::string& why) const {
        const std::string column = c_.world.regions.at(m.region).name + ".mass_kg";
        std::vector<DischargeSample> samples;
        for (std::size_t i = 0; i < series_.rows(); ++i)
            samples.push_back({series_.number(i, "time_s"), series_.number(i, column)});
        const auto d = dischargeOf(samples, m.windows.at(0).from, m.windows.at(0).to);
        if (!d) {
            why = "in its time nothing runs out, or the time series has fewer than eight lines";
            return {};
        }
        const std::vector<double>& radii = result_.particles.radius;
        const double grain = 2 * std::accumulate(radii.begin(), radii.end(), 0.0) / static_cast<double>(radii.size());
        const double gravity = glm::length(c_.world.gravity);
        Figures figures =
            named(kDischarge, {d->rate, d->error, beverlooConstant(d->rate, bulkDensity(), gravity, m.hole, grain)});
        if (!(m.hole > 0)) figures.pop_back();  // the constant is that of a round hole
        return figures;
    }

    Figures content(const ElementTest& m, std::string& why) const {
        const std::string column = c_.world.regions.at(m.region).name + ".content_kg";
        std::vector<double> masses;
        for (std::size_t i = 0; i < series_.rows(); ++i) {
            const double time = series_.number(i, "time_s");
            if (time >= m.windows.at(0).from && time <= m.windows.at(0).to) masses.push_back(series_.number(i, column));
        }
        if (masses.empty()) {
            why = "no line of the time series is in its time";
            return {};
        }
        const Mean mean = meanOf(masses);
        return named(kContent, {mean.value, mean.deviation, static_cast<double>(masses.size())});
    }

    /// That of the settled bed if the case has it measured.
    double bulkDensity() const {
        if (c_.bulkDensityMeasured && result_.settled && result_.settling)
            if (const auto bulk =
                    settledDensity(c_, *result_.settling, result_.settled->particles, result_.settled->bodies))
                return bulk->density;
        return c_.bulkDensity;
    }

    double senseOfDrive() const {
        const std::size_t rows = series_.rows();
        return rows > 0 && series_.number(rows - 1, "coil_angle_rad") < 0 ? -1 : 1;
    }

    double load(std::size_t row, std::size_t body, const char* column) const {
        return series_.number(row, c_.world.bodies.at(body).name + "." + column);
    }

    Vec3 force(std::size_t row, std::size_t body) const {
        return {load(row, body, "force_x_N"), load(row, body, "force_y_N"), load(row, body, "force_z_N")};
    }

    Figures compression(const ElementTest& m, std::string& why) const {
        const RigidBody& piston = c_.world.bodies.at(m.bodies.at(0));
        const Vec3 start = piston.pose(0, 0).origin;
        std::vector<PistonSample> samples;
        double mass = 0;
        for (std::size_t i = 0; i < series_.rows(); ++i) {
            const double way = glm::dot(originOf(i, piston) - start, m.axis);
            samples.push_back({m.height + way, glm::dot(force(i, m.bodies[0]), m.axis)});
            mass = series_.number(i, "canister_mass_kg") + series_.number(i, "throat_mass_kg");
        }
        const auto c = compressionOf(samples, mass, m.area);
        if (!c) {
            why = "the powder never pressed against the piston";
            return {};
        }
        return named(kCompression, {c->maxStress, c->looseDensity, c->loadedDensity, c->releasedDensity, c->recovery,
                                    c->work, c->returned, c->work / mass});
    }

    /// Where the frame of a body is that moves by time or freely.
    Vec3 originOf(std::size_t i, const RigidBody& body) const {
        if (!body.movesFreely()) return body.pose(series_.number(i, "time_s"), 0).origin;
        const auto along = [&](const char* axis) { return series_.number(i, fmt::format("{}.{}_m", body.name, axis)); };
        return {along("x"), along("y"), along("z")};
    }

    Figures shear(const ElementTest& m, std::string& why) const {
        const RigidBody& lid = c_.world.bodies.at(m.bodies.at(0));
        std::vector<LidSample> samples;
        for (std::size_t i = 0; i < series_.rows(); ++i) {
            LidSample s{series_.number(i, "time_s"), 0, 0};
            for (const std::size_t body : m.bodies) {
                s.force += glm::dot(force(i, body), lid.axis());
                s.torque += load(i, body, "torque_Nm");
            }
            samples.push_back(s);
        }
        makePressurePositive(samples);
        const auto pointsOf = [&](const std::vector<ElementTest::Window>& windows) {
            std::vector<ShearPoint> points;
            for (const ElementTest::Window& w : windows)
                if (const auto p = shearPoint(samples, w.from, w.to, m.innerRadius, m.radius)) points.push_back(*p);
            return points;
        };
        std::vector<ShearPoint> points = pointsOf(m.windows);
        const std::vector<ShearPoint> preShears = pointsOf(m.preShears);
        std::vector<ShearStage> stages;
        for (std::size_t i = 0; i < std::min(points.size(), preShears.size()); ++i)
            stages.push_back({preShears[i], points[i]});
        if (!stages.empty()) points = prorated(stages);
        const auto locus = yieldLocus(points);
        const bool cut = points.size() < m.windows.size() || preShears.size() < m.preShears.size();
        if (!locus || cut) {
            why = cut ? "the run has no line of the time series in one of its times"
                      : "all its points have the same normal stress";
            return {};
        }
        Figures figures = named(kShear, {degrees(locus->friction), locus->cohesion, degrees(locus->effective)});
        if (!stages.empty()) {
            const ShearPoint steady = meanPreShear(stages);
            const Flowability f = flowability(*locus, steady).value_or(Flowability{kNone, kNone, kNone});
            for (const MeasuredFigure& figure :
                 named(kPreShear, {steady.normal, steady.shear, f.consolidation, f.strength, f.ffc}))
                figures.push_back(figure);
        }
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double values[std::size(kShearPoint)] = {points[i].normal, points[i].shear, points[i].shearDeviation};
            for (std::size_t k = 0; k < std::size(kShearPoint); ++k)
                figures.push_back({fmt::format(fmt::runtime(kShearPoint[k]), i + 1), values[k]});
        }
        return figures;
    }

    const Case& c_;
    const RunResult& result_;
    Vec3 up_;
    Frames frames_;
    Table series_;
};

}  // namespace

std::vector<MeasureResult> measuresOf(const std::filesystem::path& folder, const Case& c, const RunResult& result) {
    std::vector<MeasureResult> results;
    if (c.measures.empty()) return results;
    const Measuring measuring(folder, c, result);
    for (const ElementTest& m : c.measures) results.push_back(measuring.of(m));
    return results;
}

std::string measureText(const std::vector<MeasureResult>& results) {
    std::string text;
    for (const MeasureResult& r : results) {
        text += fmt::format("measure  {}: ", r.name);
        if (!r.why.empty()) text += "none; " + r.why;
        for (std::size_t i = 0; i < r.figures.size(); ++i) {
            const FigureText figure = figureText(r.figures[i].name, r.figures[i].value);
            text += fmt::format("{}{} {}", i > 0 ? ", " : "", figure.words, figure.value);
        }
        text += "\n";
    }
    return text;
}

}  // namespace vkdose
