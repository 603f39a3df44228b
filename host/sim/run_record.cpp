#include "host/sim/run_record.h"

#include <cmath>
#include <utility>

namespace vkdose {

namespace {

/// Rows stored under a name as two arrays, `counts` and `figures`.
template <class R, class... C>
void putRows(Record& record, const std::string& counts, const std::string& figures, const std::tuple<C...>& table,
             const std::vector<R>& rows) {
    StoredRow stored;
    for (const R& row : rows) store(table, row, stored);
    record.put(counts, std::move(stored.counts));
    record.put(figures, std::move(stored.figures));
}

template <class R, class... C>
void getRows(const Record& record, const std::string& counts, const std::string& figures, const std::tuple<C...>& table,
             std::vector<R>& rows) {
    const StoredRow shape = storedShape<R>(table);
    const auto& whole = record.get<std::uint64_t>(counts);
    const std::size_t n = whole.size() / shape.counts.size();
    const std::uint64_t* count = record.get<std::uint64_t>(counts, n * shape.counts.size()).data();
    const double* figure = record.get<double>(figures, n * shape.figures.size()).data();
    rows.assign(n, R{});
    for (R& row : rows) load(table, row, count, figure);
}

/// Sets the columns of one row; the rest of it stays.
template <class R, class... C>
void getRow(const Record& record, const std::string& counts, const std::string& figures, const std::tuple<C...>& table,
            R& row) {
    const StoredRow shape = storedShape<R>(table);
    const std::uint64_t* count = record.get<std::uint64_t>(counts, shape.counts.size()).data();
    const double* figure = record.get<double>(figures, shape.figures.size()).data();
    load(table, row, count, figure);
}

}  // namespace

void put(Record& record, const std::string& name, const Sensors& s) {
    putRows(record, name + "_counts", name + "_figures", kSensorColumns, std::vector<Sensors>{s});
}

void get(const Record& record, const std::string& name, Sensors& s) {
    getRow(record, name + "_counts", name + "_figures", kSensorColumns, s);
}

void put(Record& record, const std::string& name, const std::optional<EnergyLedger>& ledger) {
    StoredRow stored;
    if (ledger) store(kBookColumns, ledger->sum, stored);
    record.put(name, std::move(stored.figures));
}

void get(const Record& record, const std::string& name, std::optional<EnergyLedger>& ledger) {
    ledger.reset();
    if (record.get<double>(name).empty()) return;
    const std::size_t size = storedShape<EnergyBook>(kBookColumns).figures.size();
    const double* figure = record.get<double>(name, size).data();
    const std::uint64_t* none = nullptr;
    load(kBookColumns, ledger.emplace().sum, none, figure);
}

void put(Record& record, const std::string& name, const Sample& s) {
    put(record, name + "_energy", s.energy);
    put(record, name + "_sensors", s.sensors);
    putRows(record, name + "_state", name, kOwnSampleColumns, std::vector<Sample>{s});
    record.put(name + "_bodies", numbersOf(s.bodies));
}

void get(const Record& record, const std::string& name, Sample& s) {
    get(record, name + "_energy", s.energy);
    get(record, name + "_sensors", s.sensors);
    getRow(record, name + "_state", name, kOwnSampleColumns, s);
    s.bodies = samplesOf(record.get<double>(name + "_bodies"));
}

void put(Record& record, const std::string& name, const std::vector<Dose>& doses) {
    putRows(record, name + "_counts", name + "_figures", kDoseColumns, doses);
    std::vector<double> bodies;
    for (const Dose& d : doses) {
        const std::vector<double> own = numbersOf(d.bodies);
        bodies.insert(bodies.end(), own.begin(), own.end());
    }
    if (!bodies.empty()) record.put(name + "_bodies", std::move(bodies));
}

void get(const Record& record, const std::string& name, std::vector<Dose>& doses) {
    getRows(record, name + "_counts", name + "_figures", kDoseColumns, doses);
    // A state of a world without bodies has none.
    if (doses.empty() || !record.arrays().contains(name + "_bodies")) return;
    const std::vector<BodySample> bodies = samplesOf(record.get<double>(name + "_bodies"));
    const std::size_t each = bodies.size() / doses.size();
    if (bodies.size() != each * doses.size()) throw RecordError(name + "_bodies does not fit the doses");
    for (std::size_t d = 0; d < doses.size(); ++d)
        doses[d].bodies.assign(bodies.begin() + std::ptrdiff_t(d * each),
                               bodies.begin() + std::ptrdiff_t((d + 1) * each));
}

void put(Record& record, const std::string& name, const std::vector<GivenOrder>& orders) {
    if (orders.empty()) return;
    std::vector<std::uint64_t> steps;
    std::vector<double> figures;
    for (const GivenOrder& o : orders) {
        steps.push_back(o.step);
        figures.insert(figures.end(), {o.time, o.order.speed.value_or(std::nan(""))});
    }
    record.put(name + "_steps", std::move(steps));
    record.put(name + "_figures", std::move(figures));
}

void get(const Record& record, const std::string& name, std::vector<GivenOrder>& orders) {
    orders.clear();
    if (!record.arrays().contains(name + "_steps")) return;
    const auto& steps = record.get<std::uint64_t>(name + "_steps");
    const auto& figures = record.get<double>(name + "_figures", 2 * steps.size());
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const double speed = figures[2 * i + 1];
        const bool stop = std::isnan(speed);
        orders.push_back({steps[i], figures[2 * i], {stop, stop ? std::nullopt : std::optional(speed)}});
    }
}

}  // namespace vkdose
