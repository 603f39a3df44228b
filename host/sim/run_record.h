#pragma once
// Sensors, samples and doses as arrays of a record, so that a run can be stored and go on bit for bit.

#include <string>
#include <vector>

#include "host/core/record.h"
#include "host/sim/runner.h"

namespace vkdose {

void put(Record& record, const std::string& name, const Sensors& sensors);
void get(const Record& record, const std::string& name, Sensors& sensors);

/// An energy ledger, if the run keeps one.
void put(Record& record, const std::string& name, const std::optional<EnergyLedger>& ledger);
void get(const Record& record, const std::string& name, std::optional<EnergyLedger>& ledger);

void put(Record& record, const std::string& name, const Sample& sample);
void get(const Record& record, const std::string& name, Sample& sample);

void put(Record& record, const std::string& name, const std::vector<Dose>& doses);
void get(const Record& record, const std::string& name, std::vector<Dose>& doses);

/// Nothing is put where there are no orders.
void put(Record& record, const std::string& name, const std::vector<GivenOrder>& orders);
void get(const Record& record, const std::string& name, std::vector<GivenOrder>& orders);

}  // namespace vkdose
