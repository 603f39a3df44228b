#include "host/sim/region_book.h"

#include <algorithm>
#include <limits>

#include "host/model/case.h"

namespace vkdose {

namespace {

/// The region that deleted a dosed particle: the one in which it is deepest. A device tests in single precision, so the
/// particle may stand a little before the plane.
std::size_t deletedBy(const World& world, const Vec3& x) {
    std::size_t found = world.regions.size();
    double deepest = -std::numeric_limits<double>::infinity();
    for (std::size_t r = 0; r < world.regions.size(); ++r) {
        const double depth = world.regions[r].depth(x);
        if (!world.regions[r].deletes || depth <= deepest) continue;
        deepest = depth;
        found = r;
    }
    return found;
}

}  // namespace

RegionBook::RegionBook(const World& world)
    : world_(world), starts_(bodyPoses(world, 0, 0)), samples_(world.regions.size()), before_(world.regions.size()) {}

void RegionBook::look(const Particles& particles, const BodyPoses& poses) {
    if (empty()) return;
    seen_.resize(particles.size(), 0);
    for (RegionSample& sample : samples_) sample.content = {};
    const auto holds = [&](const CountRegion& region, const Vec3& x) {
        return region.holds(region.body ? starts_[*region.body].toWorld(poses.at(*region.body).toBody(x)) : x);
    };
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (particles.status[i] == Status::Lost || particles.status[i] == Status::Waiting) continue;
        const Vec3& x = particles.position[i];
        const bool dosed = particles.status[i] == Status::Dosed;
        const std::size_t outlet = dosed ? deletedBy(world_, x) : world_.regions.size();
        for (std::size_t r = 0; r < samples_.size(); ++r) {
            const CountRegion& region = world_.regions[r];
            const bool in = dosed && region.deletes ? r == outlet : !region.deletes && holds(region, x);
            if (!in) continue;
            const double mass = massOf(world_, particles, i);
            const auto add = [mass](RegionCount& count) {
                count.mass += mass;
                count.particles += 1;
            };
            // A particle that another region took lies still and is in no vessel any more.
            if (!dosed || region.deletes) add(samples_[r].content);
            const std::uint32_t bit = 1U << r;
            if ((seen_[i] & bit) != 0) continue;
            seen_[i] |= bit;
            add(samples_[r].came);
        }
    }
    for (RegionSample& sample : samples_) sample.most = std::max(sample.most, sample.content.mass);
}

void RegionBook::openDose() {
    for (std::size_t r = 0; r < samples_.size(); ++r) before_[r] = samples_[r].came;
}

std::vector<RegionCount> RegionBook::sinceDose() const {
    std::vector<RegionCount> since;
    for (std::size_t r = 0; r < samples_.size(); ++r) {
        const RegionCount& came = samples_[r].came;
        since.push_back({came.mass - before_[r].mass, came.particles - before_[r].particles});
    }
    return since;
}

void RegionBook::save(Record& record) const {
    if (empty()) return;
    std::vector<double> masses;
    std::vector<std::uint64_t> numbers;
    const auto put = [&](const RegionCount& count) {
        masses.push_back(count.mass);
        numbers.push_back(count.particles);
    };
    for (std::size_t r = 0; r < samples_.size(); ++r) {
        put(samples_[r].came);
        put(samples_[r].content);
        put(before_[r]);
    }
    std::vector<double> most;
    for (const RegionSample& sample : samples_) most.push_back(sample.most);
    record.put("region_most", std::move(most));
    record.put("region_masses", masses);
    record.put("region_counts", numbers);
    record.put("region_seen", std::vector<std::uint64_t>(seen_.begin(), seen_.end()));
}

void RegionBook::restore(const Record& record) {
    if (empty()) return;
    const auto& masses = record.get<double>("region_masses", 3 * samples_.size());
    const auto& numbers = record.get<std::uint64_t>("region_counts", 3 * samples_.size());
    std::size_t next = 0;
    const auto take = [&] {
        const RegionCount count{masses[next], numbers[next]};
        ++next;
        return count;
    };
    for (std::size_t r = 0; r < samples_.size(); ++r) {
        samples_[r].came = take();
        samples_[r].content = take();
        before_[r] = take();
    }
    const auto& most = record.get<double>("region_most", samples_.size());
    for (std::size_t r = 0; r < samples_.size(); ++r) samples_[r].most = most[r];
    const auto& seen = record.get<std::uint64_t>("region_seen");
    seen_.assign(seen.begin(), seen.end());
}

}  // namespace vkdose
