#include "host/sim/field_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace vkdose {

namespace {

void add(FieldPoints& sum, const FieldPoints& points) {
    if (sum.empty()) {
        sum = points;
        return;
    }
    for (std::size_t n = 0; n < sum.size(); ++n) {
        auto numbers = sum[n].numbers();
        const auto more = points[n].numbers();
        for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] += more[k];
        sum[n] = FieldPoint::of(numbers.data());
    }
}

/// The grid of a height profile, resolved along y instead of z: how high the bed stands.
FieldRequest heightRequest(const FieldRequest& profile) {
    FieldRequest r = profile;
    const double cell = profile.reach() / 6;  // fine beside the kernel
    r.grid.cells = {1, std::uint32_t(std::ceil((r.grid.high.y - r.grid.low.y) / cell)), 1};
    r.contactStress = false;
    return r;
}

std::vector<double> heightsOf(const FieldPoints& points, const std::vector<double>& density, double height) {
    std::vector<double> heights;
    for (std::size_t n = 0; n < points.size(); ++n)
        heights.push_back(density[n] > 0 ? points[n].density / density[n] * height
                                         : std::numeric_limits<double>::quiet_NaN());
    return heights;
}

}  // namespace

double surfaceHeight(const FieldGrid& grid, const FieldPoints& points) {
    double most = 0;
    for (const FieldPoint& p : points) most = std::max(most, p.density);
    if (most == 0) return 0;
    std::size_t k = points.size();
    while (points[k - 1].density < most / 2) --k;                      // ends, because the largest is among them
    const double cell = grid.cell().y, at = (double(k) - 0.5) * cell;  // of the highest point above the half
    if (k == points.size()) return at;
    const double below = points[k - 1].density, above = points[k].density;
    return at + cell * (below - most / 2) / (below - above);
}

FieldWatch::FieldWatch(const Case& c, const Timeline& timeline)
    : sensors_(c.fields), timeline_(timeline), sensorInterval_(c.sensorInterval), states_(c.fields.size()) {}

/// Steps between two that are kept: whole sensor intervals.
std::uint64_t FieldWatch::every(const FieldSensor& sensor) const {
    return timeline_.sensorSteps() * std::uint64_t(std::max(1.0, std::round(sensor.interval / sensorInterval_)));
}

FieldPoints FieldWatch::mean(State& state) {
    for (FieldPoint& p : state.sum) {
        auto numbers = p.numbers();
        for (double& x : numbers) x /= double(state.summed);
        p = FieldPoint::of(numbers.data());
    }
    state.summed = 0;
    return std::exchange(state.sum, {});
}

void FieldWatch::begin(const FieldSensor& sensor, State& state, const FieldPoints& now, Backend& backend) {
    for (const FieldPoint& p : now) state.initialDensity.push_back(p.density);
    state.initialHeight = sensor.initialHeight;
    if (state.initialHeight > 0) return;
    const FieldRequest request = heightRequest(sensor.request);
    state.initialHeight = surfaceHeight(request.grid, backend.fields(request));
}

bool FieldWatch::isProfile(const FieldSensor& sensor) {
    return sensor.preset == FieldSensor::Preset::HeightProfile;
}

FieldSample FieldWatch::sampleOf(std::size_t field, FieldPoints points, std::uint64_t step, Phase phase, int dose) {
    State& state = states_[field];
    FieldSample s{field, int(state.kept++), step, timeline_.time(step), phase, dose, std::move(points), {}};
    if (isProfile(sensors_[field])) s.heights = heightsOf(s.points, state.initialDensity, state.initialHeight);
    return s;
}

std::vector<FieldSample> FieldWatch::open(Backend& backend, std::uint64_t step) {
    std::vector<FieldSample> kept;
    if (step < timeline_.settleSteps()) return kept;
    for (std::size_t k = 0; k < sensors_.size(); ++k) {
        if (!isProfile(sensors_[k])) continue;
        FieldPoints points = backend.fields(sensors_[k].request);
        begin(sensors_[k], states_[k], points, backend);
        kept.push_back(sampleOf(k, std::move(points), step, Phase::Settle, 0));
    }
    return kept;
}

std::vector<FieldSample> FieldWatch::look(Backend& backend, std::uint64_t step, Phase phase, int dose) {
    std::vector<FieldSample> kept;
    for (std::size_t k = 0; k < sensors_.size(); ++k) {
        const FieldSensor& sensor = sensors_[k];
        State& state = states_[k];
        const bool profile = isProfile(sensor);
        const bool begins = profile && state.initialDensity.empty();
        if (profile && step < timeline_.settleSteps()) continue;
        const bool due = begins || step % every(sensor) == 0;
        if (!due && !(sensor.average && step % timeline_.sensorSteps() == 0)) continue;
        FieldPoints points = backend.fields(sensor.request);
        if (begins) {
            begin(sensor, state, points, backend);
        } else if (sensor.average) {
            add(state.sum, points);
            ++state.summed;
            if (!due) continue;
            points = mean(state);
        }
        kept.push_back(sampleOf(k, std::move(points), step, phase, dose));
    }
    return kept;
}

void FieldWatch::save(Record& record) const {
    for (std::size_t k = 0; k < states_.size(); ++k) {
        const State& s = states_[k];
        std::vector<double> sum;
        for (const FieldPoint& p : s.sum) {
            const auto numbers = p.numbers();
            sum.insert(sum.end(), numbers.begin(), numbers.end());
        }
        record.put(fmt::format("field_{}_sum", k), std::move(sum));
        record.put(fmt::format("field_{}_counts", k), std::vector<std::uint64_t>{s.summed, s.kept});
        record.put(fmt::format("field_{}_density", k), s.initialDensity);
        record.putOne(fmt::format("field_{}_height", k), s.initialHeight);
    }
}

void FieldWatch::restore(const Record& record) {
    for (std::size_t k = 0; k < states_.size(); ++k) {
        State& s = states_[k];
        const std::size_t points = sensors_[k].request.grid.points();
        const auto& counts = record.get<std::uint64_t>(fmt::format("field_{}_counts", k), 2);
        s.summed = counts[0];
        s.kept = counts[1];
        const auto& sum =
            record.get<double>(fmt::format("field_{}_sum", k), s.summed > 0 ? points * FieldPoint::kNumbers : 0);
        s.sum.clear();
        for (std::size_t n = 0; n < sum.size(); n += FieldPoint::kNumbers) s.sum.push_back(FieldPoint::of(&sum[n]));
        s.initialDensity = record.get<double>(fmt::format("field_{}_density", k));
        if (!s.initialDensity.empty() && s.initialDensity.size() != points)
            throw RecordError(fmt::format("field_{}_density does not fit its grid", k));
        s.initialHeight = record.one<double>(fmt::format("field_{}_height", k));
    }
}

}  // namespace vkdose
