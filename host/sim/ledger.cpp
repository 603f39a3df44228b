#include "host/sim/ledger.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/core/error.h"

namespace vkdose {

namespace {

std::string regions(const Sensors& s) {
    const auto entry = [&s](const char* name, Region r) {
        const auto i = static_cast<std::size_t>(r);
        return fmt::format("{} {} ({:.6g} g)", name, s.count[i], s.mass[i] * 1e3);
    };
    return fmt::format("{}, {}, {}, {}", entry("canister", Region::Canister), entry("throat", Region::Throat),
                       entry("dosed", Region::Dosed), entry("lost", Region::Lost));
}

}  // namespace

void Ledger::close(const Sensors& sensors, double time) {
    const auto fail = [&](const std::string& what) {
        throw RunError(fmt::format("mass ledger at t = {:.6g} s: {}; {}; filled {} ({:.6g} g)", time, what,
                                   regions(sensors), count_, mass_ * 1e3));
    };
    const std::uint64_t lost = sensors.count[static_cast<std::size_t>(Region::Lost)];
    if (lost > 0) fail(fmt::format("{} particle{} left the domain", lost, lost == 1 ? "" : "s"));

    const std::uint64_t count = std::accumulate(sensors.count.begin(), sensors.count.end(), std::uint64_t{0});
    if (count != count_) fail(fmt::format("{} particles are accounted for", count));

    const std::uint64_t dosed = sensors.count[static_cast<std::size_t>(Region::Dosed)];
    if (dosed < dosedBefore_) fail(fmt::format("{} particles were dosed already", dosedBefore_));

    // The tests are written so that NaN fails. They ask whether a condition holds, which is false for NaN.
    const bool sane = std::all_of(sensors.mass.begin(), sensors.mass.end(), [](double m) { return m >= 0; });
    if (!sane) fail("a mass is negative or not a number");
    const double mass = std::accumulate(sensors.mass.begin(), sensors.mass.end(), 0.0);
    const double error = mass_ > 0 || mass > 0 ? std::abs(mass - mass_) / mass_ : 0.0;
    if (!(error <= kLedgerTolerance)) fail(fmt::format("the masses differ from the filled one by {:.3g} of it", error));

    worst_ = std::max(worst_, error);
    dosedBefore_ = dosed;
    ++closings_;
}

void Ledger::save(Record& record) const {
    record.putOne("ledger_worst", worst_);
    record.put("ledger_counts", std::vector<std::uint64_t>{closings_, dosedBefore_});
}

void Ledger::restore(const Record& record) {
    worst_ = record.one<double>("ledger_worst");
    const auto& counts = record.get<std::uint64_t>("ledger_counts", 2);
    closings_ = counts[0];
    dosedBefore_ = counts[1];
}

}  // namespace vkdose
