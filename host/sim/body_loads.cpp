#include "host/sim/body_loads.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vkdose {

std::vector<double> numbersOf(const std::vector<BodySample>& samples) {
    std::vector<double> numbers;
    for (const BodySample& s : samples)
        numbers.insert(numbers.end(), {s.force.x, s.force.y, s.force.z, s.torque, s.power, s.work});
    return numbers;
}

std::vector<BodySample> samplesOf(const std::vector<double>& numbers) {
    std::vector<BodySample> samples;
    for (std::size_t at = 0; at + 6 <= numbers.size(); at += 6) {
        const double* n = &numbers[at];
        samples.push_back({Vec3(n[0], n[1], n[2]), n[3], n[4], n[5]});
    }
    return samples;
}

void BodyLoads::add(const std::vector<BodyLoad>& call, std::uint64_t steps, bool rotates) {
    for (std::size_t b = 0; b < sums_.size(); ++b) {
        const Vec3 force = double(steps) * call.at(b).force;
        const double torque = double(steps) * call[b].torque, work = call[b].work;
        sums_[b].force += force;
        sums_[b].torque += torque;
        sums_[b].power += work;
        sums_[b].work += work;
        if (!rotates) continue;
        turned_[b].force += force;
        turned_[b].torque += torque;
        turned_[b].power += work;
    }
    if (rotates) turnedSteps_ += steps;
}

std::vector<BodySample> BodyLoads::take(std::uint64_t steps, double timeStep) {
    std::vector<BodySample> samples;
    const double n = double(steps);
    for (std::size_t b = 0; b < sums_.size(); ++b) {
        BodySample& sum = sums_[b];
        const BodySample& s =
            samples.emplace_back(BodySample{sum.force / n, sum.torque / n, sum.power / (n * timeStep), sum.work});
        sum = {Vec3(0), 0, 0, sum.work};
        BodyPeaks& peaks = peaks_[b];
        peaks.force = std::max(peaks.force, glm::length(s.force));
        peaks.torque = std::max(peaks.torque, std::abs(s.torque));
        peaks.power = std::max(peaks.power, std::abs(s.power));
    }
    return samples;
}

void BodyLoads::openDose() {
    turnedSteps_ = 0;
    for (std::size_t b = 0; b < sums_.size(); ++b) turned_[b] = {Vec3(0), 0, 0, sums_[b].work};
}

std::vector<BodySample> BodyLoads::sinceDose(double timeStep) const {
    std::vector<BodySample> samples;
    const double n = std::max(double(turnedSteps_), 1.0);
    for (std::size_t b = 0; b < sums_.size(); ++b) {
        const BodySample& sum = turned_[b];
        samples.push_back({sum.force / n, sum.torque / n, sum.power / (n * timeStep), sums_[b].work - sum.work});
    }
    return samples;
}

void BodyLoads::save(Record& record) const {
    record.put("bodies", numbersOf(sums_));
    if (sums_.empty()) return;
    record.put("bodies_in_dose", numbersOf(turned_));
    record.putOne("bodies_dose_steps", turnedSteps_);
    std::vector<double> peaks;
    for (const BodyPeaks& p : peaks_) peaks.insert(peaks.end(), {p.force, p.torque, p.power});
    record.put("bodies_peaks", std::move(peaks));
}

void BodyLoads::restore(const Record& record) {
    const std::size_t n = sums_.size();
    sums_ = samplesOf(record.get<double>("bodies", 6 * n));
    openDose();
    peaks_.assign(n, {});
    if (n == 0) return;
    turned_ = samplesOf(record.get<double>("bodies_in_dose", 6 * n));
    turnedSteps_ = record.one<std::uint64_t>("bodies_dose_steps");
    const auto& peaks = record.get<double>("bodies_peaks", 3 * n);
    for (std::size_t b = 0; b < n; ++b) peaks_[b] = {peaks[3 * b], peaks[3 * b + 1], peaks[3 * b + 2]};
}

void BodyLoads::takeOver(const Record& record) {
    restore(record);
    peaks_.assign(sums_.size(), {});
}

}  // namespace vkdose
