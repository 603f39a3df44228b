#include "host/sim/region_book.h"

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

void RegionBook::look(const Particles& particles) {
    if (empty()) return;
    seen_.resize(particles.size(), 0);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (particles.status[i] == Status::Lost || particles.status[i] == Status::Waiting) continue;
        const Vec3& x = particles.position[i];
        const bool dosed = particles.status[i] == Status::Dosed;
        const std::size_t outlet = dosed ? deletedBy(world_, x) : world_.regions.size();
        for (std::size_t r = 0; r < counts_.size(); ++r) {
            const bool deletes = world_.regions[r].deletes;
            const bool in = dosed && deletes ? r == outlet : !deletes && world_.regions[r].holds(x);
            const std::uint32_t bit = 1U << r;
            if (!in || (seen_[i] & bit) != 0) continue;
            seen_[i] |= bit;
            counts_[r].mass += massOf(world_, particles, i);
            counts_[r].particles += 1;
        }
    }
}

std::vector<RegionCount> RegionBook::sinceDose() const {
    std::vector<RegionCount> since = counts_;
    for (std::size_t r = 0; r < since.size(); ++r) {
        since[r].mass -= before_[r].mass;
        since[r].particles -= before_[r].particles;
    }
    return since;
}

void RegionBook::save(Record& record) const {
    if (empty()) return;
    std::vector<double> masses;
    std::vector<std::uint64_t> numbers(seen_.begin(), seen_.end());
    for (const auto* counts : {&counts_, &before_})
        for (const RegionCount& c : *counts) {
            masses.push_back(c.mass);
            numbers.push_back(c.particles);
        }
    record.put("region_masses", masses);
    record.put("region_counts", numbers);
}

void RegionBook::restore(const Record& record) {
    if (empty()) return;
    const auto& masses = record.get<double>("region_masses", 2 * counts_.size());
    const auto& numbers = record.get<std::uint64_t>("region_counts");
    if (numbers.size() < masses.size()) throw RecordError("region_counts is too short");
    const std::size_t particles = numbers.size() - masses.size();
    seen_.assign(numbers.begin(), numbers.begin() + std::ptrdiff_t(particles));
    for (std::size_t r = 0; r < counts_.size(); ++r) {
        counts_[r] = {masses[r], numbers[particles + r]};
        before_[r] = {masses[counts_.size() + r], numbers[particles + counts_.size() + r]};
    }
}

}  // namespace vkdose
