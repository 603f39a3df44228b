#include "host/sim/powder_book.h"

#include <limits>

namespace vkdose {

PowderBook::PowderBook(const World& world) : world_(world), powderOf_(world.materials.size(), -1) {
    const std::vector<int> powders = powdersOf(world);
    if (powders.size() < 2) return;
    for (std::size_t k = 0; k < powders.size(); ++k) powderOf_[std::size_t(powders[k])] = int(k);
    places_.resize(powders.size());
    before_ = places_;
}

void PowderBook::look(const Particles& particles) {
    if (empty()) return;
    places_.assign(places_.size(), {});
    for (std::size_t i = 0; i < particles.size(); ++i) {
        PowderPlaces& of = places_[std::size_t(powderOf_[particles.material[i]])];
        const double mass = massOf(world_, particles, i);
        if (particles.status[i] == Status::Dosed) {
            of.dosed += mass;
            of.dosedCount += 1;
        } else if (particles.status[i] == Status::Active && particles.position[i].z > world_.throatZ) {
            of.throat += mass;
            of.throatCount += 1;
        } else if (particles.status[i] == Status::Active) {
            of.canister += mass;
            of.canisterCount += 1;
        }
    }
}

std::vector<PowderDose> PowderBook::sinceDose() const {
    std::vector<PowderDose> doses;
    double all = 0;
    for (std::size_t k = 0; k < places_.size(); ++k) {
        doses.push_back({places_[k].dosed - before_[k].dosed, places_[k].dosedCount - before_[k].dosedCount});
        all += doses.back().mass;
    }
    for (PowderDose& d : doses) d.share = all > 0 ? d.mass / all : std::numeric_limits<double>::quiet_NaN();
    return doses;
}

void PowderBook::save(Record& record) const {
    if (empty()) return;
    StoredRow row;
    for (const auto* places : {&places_, &before_})
        for (const PowderPlaces& p : *places) store(kPowderColumns, p, row);
    record.put("powder_masses", row.figures);
    record.put("powder_counts", row.counts);
}

void PowderBook::restore(const Record& record) {
    if (empty()) return;
    const StoredRow shape = storedShape<PowderPlaces>(kPowderColumns);
    const std::size_t rows = 2 * places_.size();
    const double* figures = record.get<double>("powder_masses", rows * shape.figures.size()).data();
    const std::uint64_t* counts = record.get<std::uint64_t>("powder_counts", rows * shape.counts.size()).data();
    for (auto* places : {&places_, &before_})
        for (PowderPlaces& p : *places) load(kPowderColumns, p, counts, figures);
}

}  // namespace vkdose
