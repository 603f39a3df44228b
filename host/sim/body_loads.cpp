#include "host/sim/body_loads.h"

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

void BodyLoads::add(const std::vector<BodyLoad>& call, std::uint64_t steps) {
    for (std::size_t b = 0; b < sums_.size(); ++b) {
        sums_[b].force += double(steps) * call.at(b).force;
        sums_[b].torque += double(steps) * call[b].torque;
        sums_[b].power += call[b].work;
        sums_[b].work += call[b].work;
    }
}

std::vector<BodySample> BodyLoads::take(std::uint64_t steps, double timeStep) {
    std::vector<BodySample> samples;
    for (BodySample& sum : sums_) {
        const double n = double(steps);
        samples.push_back({sum.force / n, sum.torque / n, sum.power / (n * timeStep), sum.work});
        sum = {Vec3(0), 0, 0, sum.work};
    }
    return samples;
}

void BodyLoads::save(Record& record) const {
    record.put("bodies", numbersOf(sums_));
}

void BodyLoads::restore(const Record& record) {
    sums_ = samplesOf(record.get<double>("bodies", 6 * sums_.size()));
}

}  // namespace vkdose
