#include "host/sim/run_record.h"

#include <algorithm>
#include <array>
#include <utility>

namespace vkdose {

void put(Record& record, const std::string& name, const Sensors& s) {
    std::vector<std::uint64_t> counts(s.count.begin(), s.count.end());
    counts.push_back(s.rebuilds);
    std::vector<double> figures(s.mass.begin(), s.mass.end());
    figures.insert(figures.end(),
                   {s.kineticEnergy, s.rotationalEnergy, s.coilTorque, s.throatMomentumZ, s.maxOverlapRatio});
    record.put(name + "_counts", std::move(counts));
    record.put(name + "_figures", std::move(figures));
}

void get(const Record& record, const std::string& name, Sensors& s) {
    const auto& counts = record.get<std::uint64_t>(name + "_counts", kRegions + 1);
    std::copy_n(counts.begin(), kRegions, s.count.begin());
    s.rebuilds = counts[kRegions];
    const auto& figures = record.get<double>(name + "_figures", kRegions + 5);
    std::copy_n(figures.begin(), kRegions, s.mass.begin());
    const double* f = &figures[kRegions];
    s.kineticEnergy = f[0];
    s.rotationalEnergy = f[1];
    s.coilTorque = f[2];
    s.throatMomentumZ = f[3];
    s.maxOverlapRatio = f[4];
}

namespace {

constexpr std::array kBookFigures{&EnergyBook::kinetic,        &EnergyBook::rotational,     &EnergyBook::potential,
                                  &EnergyBook::elasticNormal,  &EnergyBook::elasticSliding, &EnergyBook::elasticRolling,
                                  &EnergyBook::elasticTorsion, &EnergyBook::plastic,        &EnergyBook::adhesive,
                                  &EnergyBook::viscous,        &EnergyBook::sliding,        &EnergyBook::rolling,
                                  &EnergyBook::torsion,        &EnergyBook::numerical,      &EnergyBook::coilWork,
                                  &EnergyBook::left,           &EnergyBook::loaded};
constexpr std::array kBookVectors{&EnergyBook::momentum, &EnergyBook::angularMomentum};

}  // namespace

void put(Record& record, const std::string& name, const std::optional<EnergyLedger>& ledger) {
    std::vector<double> figures;
    if (ledger) {
        for (const auto figure : kBookFigures) figures.push_back(ledger->sum.*figure);
        for (const auto vector : kBookVectors)
            for (int d = 0; d < 3; ++d) figures.push_back((ledger->sum.*vector)[d]);
    }
    record.put(name, std::move(figures));
}

void get(const Record& record, const std::string& name, std::optional<EnergyLedger>& ledger) {
    ledger.reset();
    if (record.get<double>(name).empty()) return;
    const auto& figures = record.get<double>(name, kBookFigures.size() + 3 * kBookVectors.size());
    ledger.emplace();
    auto next = figures.begin();
    for (const auto figure : kBookFigures) ledger->sum.*figure = *next++;
    for (const auto vector : kBookVectors)
        for (int d = 0; d < 3; ++d) (ledger->sum.*vector)[d] = *next++;
}

void put(Record& record, const std::string& name, const Sample& s) {
    put(record, name + "_energy", s.energy);
    put(record, name + "_sensors", s.sensors);
    record.put(name + "_state", std::vector<std::uint64_t>{s.step, static_cast<std::uint64_t>(s.phase),
                                                           static_cast<std::uint64_t>(s.dose)});
    record.put(name, std::vector<double>{s.time, s.coilAngle, s.outletVelocity, s.coilTorque, s.coilPower});
}

void get(const Record& record, const std::string& name, Sample& s) {
    get(record, name + "_energy", s.energy);
    get(record, name + "_sensors", s.sensors);
    const auto& state = record.get<std::uint64_t>(name + "_state", 3);
    s.step = state[0];
    s.phase = static_cast<Phase>(state[1]);
    s.dose = static_cast<int>(state[2]);
    const auto& figures = record.get<double>(name, 5);
    s.time = figures[0];
    s.coilAngle = figures[1];
    s.outletVelocity = figures[2];
    s.coilTorque = figures[3];
    s.coilPower = figures[4];
}

void put(Record& record, const std::string& name, const std::vector<Dose>& doses) {
    std::vector<std::uint64_t> counts;
    std::vector<double> figures;
    for (const Dose& d : doses) {
        counts.insert(counts.end(), {static_cast<std::uint64_t>(d.index), d.particles, d.complete ? 1U : 0U});
        figures.insert(figures.end(), {d.startTime, d.mass, d.cumulative, d.coilTorque, d.closedForm});
    }
    record.put(name + "_counts", std::move(counts));
    record.put(name + "_figures", std::move(figures));
}

void get(const Record& record, const std::string& name, std::vector<Dose>& doses) {
    const auto& counts = record.get<std::uint64_t>(name + "_counts");
    const auto& figures = record.get<double>(name + "_figures", counts.size() / 3 * 5);
    doses.clear();
    for (std::size_t i = 0; i < counts.size() / 3; ++i) {
        const std::uint64_t* n = &counts[3 * i];
        const double* f = &figures[5 * i];
        doses.push_back({static_cast<int>(n[0]), f[0], f[1], n[1], f[2], f[3], f[4], n[2] != 0});
    }
}

}  // namespace vkdose
