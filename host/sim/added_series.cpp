#include "host/sim/added_series.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/grams.h"

namespace vkdose {

std::string AddedSeries::name() const {
    return single() ? first.name : fmt::format("{} to {}", first.name, last.name);
}

std::string AddedSeries::when() const {
    return single() ? fmt::format("at t = {:.6g} s", first.time)
                    : fmt::format("from t = {:.6g} s to {:.6g} s", first.time, last.time);
}

std::string AddedSeries::text() const {
    return fmt::format("{} g in {} spheres, {}", grams(mass), particles, when());
}

std::size_t refillsOfTable(const std::vector<Refill>& refills, std::size_t table) {
    return std::size_t(
        std::count_if(refills.begin(), refills.end(), [&](const Refill& r) { return r.table == table; }));
}

std::vector<AddedSeries> seriesOf(const std::vector<AddedPowder>& added) {
    std::vector<AddedSeries> list;
    for (const AddedPowder& p : added) {
        const auto same = [&](const AddedSeries& s) { return s.first.table == p.table; };
        auto series = p.ofTable > kToldRefills ? std::find_if(list.begin(), list.end(), same) : list.end();
        if (series == list.end()) series = list.insert(list.end(), {p, p, 0, 0});
        series->last = p;
        series->particles += p.particles;
        series->mass += p.mass;
    }
    return list;
}

}  // namespace vkdose
